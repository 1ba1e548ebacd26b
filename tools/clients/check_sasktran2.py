"""Load both databases, check the Rayleigh coefficients, compute limb and sky radiances."""

import sys

import numpy as np
import sasktran2 as sk
import xarray as xr

rayleigh = xr.open_dataset(sys.argv[1])
b1 = float(rayleigh["lm_b1"].isel(radius_um=0, wavelength_nm=0, legendre=2))
a1 = rayleigh["lm_a1"].isel(radius_um=0, wavelength_nm=0).values
print(f"Rayleigh: a1 = {a1[:4]}, b1[2] = {b1:.6f} (expected {np.sqrt(1.5):.6f})")
assert abs(b1 - np.sqrt(1.5)) < 2e-3 and abs(a1[2] - 0.5) < 2e-3


def radiance(optical, nm, radius, number_density):
    config = sk.Config()
    config.num_stokes = 3
    config.multiple_scatter_source = sk.MultipleScatterSource.NoSource
    geometry = sk.Geometry1D(
        0.6, 0.0, 6372000, np.arange(0.0, 20001.0, 1000.0),
        sk.InterpolationMethod.LinearInterpolation, sk.GeometryType.Spherical,
    )
    viewing = sk.ViewingGeometry()
    for angle in (60.0, 120.0):
        viewing.add_ray(sk.GroundViewingSolar(0.6, np.radians(angle), 0.8, 200000.0))
    atmosphere = sk.Atmosphere(geometry, config, wavelengths_nm=np.array([nm]), calculate_derivatives=False)
    profile = np.full(len(geometry.altitudes()), number_density)
    atmosphere["drops"] = sk.constituent.NumberDensityScatterer(
        optical, geometry.altitudes(), profile, radius_um=np.full_like(profile, radius)
    )
    engine = sk.Engine(config, geometry, viewing)
    return engine.calculate_radiance(atmosphere)["radiance"].values


path = sys.argv[2]
drop = xr.open_dataset(path)
print("drop: peak_share", drop["peak_share"].values.ravel(), "xs", drop["xs_total"].values.ravel())
nm = float(drop["wavelength_nm"][1])
radius = float(drop["radius_um"][0])
optical = sk.database.OpticalDatabaseGenericScatterer(path)
result = radiance(optical, nm, radius, 1e-2 / float(drop["xs_total"][0, 1]) * 1e-3)
print("radiance (I, Q, U) per line of sight:", np.squeeze(result))
assert np.all(np.isfinite(result)) and np.all(result[..., 0] > 0)
