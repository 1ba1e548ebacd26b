"""libRadtran's layout and the OpenEXR map, read by other programs' readers; numbers by other codes.

The phase matrix is compared with miepython (Scott Prahl), the map with colours added up here from the
table and the CIE's functions.
"""

import csv
import sys

import miepython
import netCDF4
import numpy as np
import OpenEXR

layout, table_path, map_path, radius_deg, data = sys.argv[1:]


def columns(path):
    with open(path) as file:
        rows = [row for row in csv.reader(line for line in file if not line.startswith("#"))]
    numbers = []
    for row in rows:
        try:
            numbers.append([float(value) for value in row])
        except ValueError:
            pass  # the header
    return np.array(numbers).T


def libradtran():
    file = netCDF4.Dataset(layout)
    assert file["phase"].dimensions == ("nlam", "nreff", "nphamat", "nthetamax")
    radius = float(file["reff"][0])
    for line in range(file.dimensions["nlam"].size):
        index = complex(file["refre"][line], -file["refim"][line])
        x = 2 * np.pi * radius / float(file["wavelen"][line])
        q_ext, q_sca, _, g = miepython.efficiencies_mx(index, x)
        density = 1000 * float(file["rho"][line, 0])
        assert abs(density - 998.207) < 0.01  # liquid water at 20 degrees (IAPWS-95)
        ext = 0.75 * q_ext / (radius * 1e-6 * density)
        theta = np.array(file["theta"][line, 0, 0], dtype=float)
        mu = np.cos(np.radians(theta))
        p11, p12 = (np.array(file["phase"][line, 0, element], dtype=float) for element in (0, 1))
        s1, s2 = miepython.S1_S2(index, x, mu, norm="wiscombe")
        i1, i2 = abs(s1) ** 2, abs(s2) ** 2
        scale = 4 / (x**2 * q_sca)
        away = theta > 1  # the forward peak is compared by its moments
        error = np.max(abs(p11[away] / (scale * (i1 + i2)[away] / 2) - 1))
        sign = np.max(abs(-p12 / p11 - (i1 - i2) / (i1 + i2))[away])
        moments = np.array(file["pmom"][line, 0, 0], dtype=float)
        print(f"libRadtran, {file['wavelen'][line]} um: ext {file['ext'][line, 0] / ext - 1:+.1e}, "
              f"gg {file['gg'][line, 0] - g:+.1e}, moment 1 {moments[1] / 3 - g:+.1e}, "
              f"trapezoid {-np.trapezoid(p11, mu) - 2:+.1e}, "
              f"ssa {file['ssa'][line, 0]:.6f}, P11 {error:.1e}, polarisation {sign:.1e} (differences)")
        assert abs(file["ext"][line, 0] / ext - 1) < 1e-6 and abs(file["gg"][line, 0] - g) < 1e-4
        assert abs(moments[1] / 3 - g) < 1e-3 and error < 1e-3 and sign < 2e-4
        assert abs(-np.trapezoid(p11, mu) - 2) < 1e-2 and 0.999 < file["ssa"][line, 0] <= 1


def antisolar_map():
    pixels = OpenEXR.File(map_path).channels()["RGB"].pixels
    size = pixels.shape[0]
    table = netCDF4.Dataset(table_path)
    nm = table["wavelength_nm"][:].filled()
    phase = table["phase_function"][:].filled().astype(float)[:, :, 0]
    observer = columns(f"{data}/color/cie1931_2deg_1nm.csv")
    sun = columns(f"{data}/color/astm_g173_03_280_1100nm.csv")
    grid = np.arange(nm[0], nm[-1] + 0.5)
    light = np.interp(grid, sun[0], sun[1])
    bar = [np.interp(grid, observer[0], observer[i]) for i in (1, 2, 3)]
    to_srgb = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]])
    worst = 0.0
    middle = size // 2
    for degrees in np.arange(2, float(radius_deg) - 1, 3.7):
        column = int(round(middle - 0.5 + degrees / float(radius_deg) * size / 2))
        angle = abs(column - (size - 1) / 2) / (size / 2) * float(radius_deg)
        # Half a pixel above the middle row.
        angle = np.hypot(angle, 0.5 / (size / 2) * float(radius_deg))
        at = [np.interp(180 - angle, table["theta"][:], row) for row in phase]
        spectrum = np.interp(grid, nm, at) * light
        xyz = np.array([np.sum(spectrum * b) for b in bar]) / np.sum(light * bar[1])
        expected, found = to_srgb @ xyz, pixels[middle - 1, column]
        worst = max(worst, np.max(abs(found - expected)) / np.max(abs(expected)))
    print(f"OpenEXR map {pixels.shape}: colours within {worst:.1e} of those added up here")
    assert worst < 0.02 and np.all(np.isfinite(pixels))


libradtran()
antisolar_map()
