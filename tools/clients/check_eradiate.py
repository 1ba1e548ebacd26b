"""Eradiate's own schema accepts the file, and a particle layer is built from it."""

import sys

import numpy as np
import xarray as xr

path = sys.argv[1]
data = xr.load_dataset(path)
mu, p11 = data["mu"].values, data["phase"].sel(phamat="11").values
integral = np.trapezoid(p11, mu, axis=1)
print("integral over mu:", integral, "asymmetry:", 0.5 * np.trapezoid(p11 * mu, mu, axis=1))
assert np.allclose(integral, 2.0, atol=1e-6) and np.all(np.diff(mu, axis=1) > 0)

import eradiate

eradiate.set_mode("mono")
from eradiate.radprops import ParticleProperties  # noqa: E402

properties = ParticleProperties.convert(data) if hasattr(ParticleProperties, "convert") \
    else ParticleProperties(data)
layer = eradiate.scenes.atmospheres.ParticleLayer(
    bottom=0.0, top=2000.0, tau_ref=0.2, particle_properties=properties,
    w_ref=float(data["w"][1]),
)
print("particle layer:", type(layer).__name__, "optical thickness 0.2")
