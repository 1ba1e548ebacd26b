"""Load both databases, check the Rayleigh coefficients, compute limb and sky radiances."""

import sys

import numpy as np
import sasktran2 as sk
import xarray as xr

rayleigh = xr.open_dataset(sys.argv[1])
b1 = float(rayleigh["lm_b1"].isel(wavelength_nm=0, legendre=2))
a1 = rayleigh["lm_a1"].isel(wavelength_nm=0).values
print(f"Rayleigh: a1 = {a1[:4]}, b1[2] = {b1:.6f} (expected {np.sqrt(1.5):.6f})")
assert abs(b1 - np.sqrt(1.5)) < 2e-3 and abs(a1[2] - 0.5) < 2e-3


def radiance(nm, moments, constituent):
    """Stokes vectors of two lines of sight that differ in azimuth alone, single scattering."""
    config = sk.Config()
    config.num_stokes = 3
    config.num_singlescatter_moments = moments  # the default, 16, would blur the bow
    config.multiple_scatter_source = sk.MultipleScatterSource.NoSource
    geometry = sk.Geometry1D(
        0.6, 0.0, 6372000, np.arange(0.0, 20001.0, 1000.0),
        sk.InterpolationMethod.LinearInterpolation, sk.GeometryType.Spherical,
    )
    viewing = sk.ViewingGeometry()
    for azimuth in AZIMUTHS:
        viewing.add_ray(sk.GroundViewingSolar(0.6, np.radians(azimuth), 0.8, 200000.0))
    atmosphere = sk.Atmosphere(geometry, config, wavelengths_nm=np.array([nm]), calculate_derivatives=False)
    sk.climatology.us76.add_us76_standard_atmosphere(atmosphere)
    atmosphere["particles"] = constituent(geometry.altitudes())
    engine = sk.Engine(config, geometry, viewing)
    stokes = np.squeeze(engine.calculate_radiance(atmosphere)["radiance"].values)
    assert np.all(np.isfinite(stokes)) and np.all(stokes[:, 0] > 0)
    return stokes


def particles(path, density):
    optical = sk.optical.database.OpticalDatabaseGenericScatterer(path)
    return lambda altitudes: sk.constituent.NumberDensityScatterer(
        optical, altitudes, np.full(len(altitudes), density)
    )


AZIMUTHS = (60.0, 120.0)

# The sign of polarisation: air by sasktran2 itself. Air is a little depolarising, spheres are not.
path = sys.argv[1]
ours = radiance(float(rayleigh["wavelength_nm"][0]), 16,
                particles(path, 1e-6 / float(rayleigh["xs_total"][0])))
air = radiance(550.0, 16, lambda _: sk.constituent.Rayleigh())
for name, stokes in (("our Rayleigh sphere", ours), ("sasktran2's air", air)):
    print(f"{name}: Q/I, U/I per line of sight", np.round(stokes[:, 1:] / stokes[:, :1], 4).tolist())
assert np.max(abs(ours[:, 1:] / ours[:, :1] - air[:, 1:] / air[:, :1])) < 0.05

# The ratio of radiances of a thin layer is that of the phase function at their scattering angles, and
# their polarisation that of the table.
path = sys.argv[2]
drop = xr.open_dataset(path).isel(wavelength_nm=1)
table = xr.open_dataset(sys.argv[3], engine="netcdf4").isel(wavelength_nm=1, phi=0)
print(f"drop: peak_share {float(drop['peak_share']):.4f}, xs {float(drop['xs_total']):.4e} m2")
stokes = radiance(float(drop["wavelength_nm"]), 800, particles(path, 1e-5 / float(drop["xs_total"])))
up, down = np.sqrt(1 - 0.6**2), np.sqrt(1 - 0.8**2)
mu = -0.6 * 0.8 + up * down * np.cos(np.radians(AZIMUTHS))
theta = np.degrees(np.arccos(mu))
phase = np.polynomial.legendre.legval(mu, drop["lm_a1"].values)
element = {name: np.interp(theta, table["theta"], table["mueller"].sel(mueller_element=name))
           for name in ("11", "12")}
found = stokes[0, 0] / stokes[1, 0]
degree = np.hypot(stokes[:, 1], stokes[:, 2]) / stokes[:, 0]
expected = abs(element["12"] / element["11"])
print(f"scattering angles {np.round(theta, 2).tolist()}: ratio of radiances {found:.5f}, of phase functions "
      f"{phase[0] / phase[1]:.5f} (moments), {element['11'][0] / element['11'][1]:.5f} (table)")
print(f"degree of polarisation {np.round(degree, 4).tolist()}, by the table {np.round(expected, 4).tolist()}")
assert abs(found / (phase[0] / phase[1]) - 1) < 2e-3
assert abs(found / (element["11"][0] / element["11"][1]) - 1) < 1e-2
assert np.max(abs(degree - expected)) < 0.02
