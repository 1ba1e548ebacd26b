#!/usr/bin/env python3
"""Columns of a Lee diagram against miepython, colour by colour (CIEDE2000).

    gonio lee --radius-mm 0.012:0.03:3 --theta 130:148:0.5 --data lee.h5
    python tools/lee_against_miepython.py lee.h5

Everything but the index of water (`gonio material water`) is done again from its definition: the
scattering by miepython (PyPI, MIT), wavelengths even in the wavenumber, the sun's disc as a direct
sum of chords on a grid ten times finer than its radius, CIE 1931 under D65 from data/color/.
Needs numpy, h5py, miepython; set MIEPYTHON_USE_JIT=1 with numba for speed.
"""
import json
import pathlib
import subprocess
import sys

import h5py
import miepython
import numpy as np

COLOR = pathlib.Path(__file__).parent.parent / "data" / "color"
SUN = np.radians(0.2665)
COUNT = 1500


def table(name):
    rows = []
    for line in (COLOR / name).read_text().splitlines():
        try:
            rows.append([float(v) for v in line.split(",")])
        except ValueError:
            continue
    return np.array(rows)


def lab(xyz, white):
    t = xyz / white
    f = np.where(t > (24 / 116) ** 3, np.cbrt(t), 841 / 108 * t + 16 / 116)
    return np.stack([116 * f[:, 1] - 16, 500 * (f[:, 0] - f[:, 1]), 200 * (f[:, 1] - f[:, 2])], 1)


def ciede2000(p, q):
    """Sharma, Wu & Dalal 2005, eqs. 1 to 22."""
    c7 = lambda c: np.sqrt(c**7 / (c**7 + 25.0**7))
    g = 0.5 * (1 - c7(0.5 * (np.hypot(p[:, 1], p[:, 2]) + np.hypot(q[:, 1], q[:, 2]))))
    (l1, a1, b1), (l2, a2, b2) = p.T, q.T
    a1, a2 = a1 * (1 + g), a2 * (1 + g)
    c1, c2 = np.hypot(a1, b1), np.hypot(a2, b2)
    h1, h2 = np.degrees(np.arctan2(b1, a1)) % 360, np.degrees(np.arctan2(b2, a2)) % 360
    dh = (h2 - h1 + 180) % 360 - 180
    hm = (h1 + 0.5 * dh) % 360
    lm, cm = (l1 + l2) / 2, (c1 + c2) / 2
    cos = lambda d: np.cos(np.radians(d))
    t = 1 - 0.17 * cos(hm - 30) + 0.24 * cos(2 * hm) + 0.32 * cos(3 * hm + 6) - 0.2 * cos(4 * hm - 63)
    sl = 1 + 0.015 * (lm - 50) ** 2 / np.sqrt(20 + (lm - 50) ** 2)
    sc, sh = 1 + 0.045 * cm, 1 + 0.015 * cm * t
    rt = -2 * c7(cm) * np.sin(np.radians(60 * np.exp(-(((hm - 275) / 25) ** 2))))
    dl, dc = (l2 - l1) / sl, (c2 - c1) / sc
    dhh = 2 * np.sqrt(c1 * c2) * np.sin(np.radians(dh / 2)) / sh
    return np.sqrt(np.maximum(dl**2 + dc**2 + dhh**2 + rt * dc * dhh, 0))


def water(wavelengths):
    coarse = np.linspace(379, 736, 120)
    asked = ",".join(f"{w:.3f}" for w in coarse)
    command = ["gonio", "material", "water", "--wavelength-nm", asked, "--json"]
    n = json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)
    return np.interp(wavelengths * 1e9, coarse, n["n"])


def column(radius, theta):
    """XYZ of total light at `theta` (radians)."""
    observer, lamp = table("cie1931_2deg_1nm.csv"), table("cie_illuminant_D65.csv")
    limb = table("solar_limb_darkening_neckel_labs_1994.csv")
    low, high = 2 * np.pi / 735e-9, 2 * np.pi / 380e-9
    k = low + (np.arange(COUNT) + 0.5) / COUNT * (high - low)
    wavelengths = 2 * np.pi / k
    nm = wavelengths * 1e9
    power = np.interp(nm, lamp[:, 0], lamp[:, 1])
    weights = np.stack([np.interp(nm, observer[:, 0], observer[:, c]) for c in (1, 2, 3)], 1)
    weights *= (power / k**2)[:, None]
    weights /= weights[:, 1].sum()
    fine = np.arange(theta[0] - SUN, theta[-1] + SUN, SUN / 10)
    offset = (fine[None, :] - theta[:, None]) / SUN
    half = np.sqrt(np.maximum(1 - offset**2, 0))
    # Powers of the heliocentric cosine, summed along each chord by midpoints.
    y = (np.arange(200) + 0.5) / 200
    mu = half[..., None] * np.sqrt(1 - y**2)
    chords = [half * (mu**p).mean(-1) for p in range(6)]
    xyz = np.zeros((len(theta), 3))
    for i, index in enumerate(water(wavelengths)):
        x = k[i] * radius
        s1, s2 = miepython.S1_S2(complex(index, 0), x, np.cos(fine), norm="wiscombe")
        value = 0.5 * (abs(s1) ** 2 + abs(s2) ** 2) / (k[i] ** 2 * np.pi * radius**2)
        darkening = [np.interp(nm[i], limb[:, 0], limb[:, 1 + p]) for p in range(6)]
        kernel = sum(a * c for a, c in zip(darkening, chords))
        xyz += np.outer(kernel @ value / kernel.sum(1), weights[i])
    white = np.stack([np.interp(lamp[:, 0], observer[:, 0], observer[:, c]) for c in (1, 2, 3)], 1)
    white = (white * lamp[:, 1:2]).sum(0)
    return xyz, white / white[1]


def main():
    with h5py.File(sys.argv[1]) as file:
        radii, theta = file["radius_mm"][:], np.radians(file["theta"][:])
        total = file["xyz_parallel"][:] + file["xyz_perpendicular"][:]
    print("radius (mm) | ΔE median | ΔE max | largest relative difference of Y")
    for radius, mine in zip(radii, total):
        theirs, white = column(radius * 1e-3, theta)
        scale = 0.8 / theirs[:, 1].max()
        delta = ciede2000(lab(mine * scale, white), lab(theirs * scale, white))
        off = abs(mine[:, 1] / theirs[:, 1] - 1).max()
        print(f"{radius:.4f} | {np.median(delta):.2f} | {delta.max():.2f} | {off:.4f}", flush=True)


main()
