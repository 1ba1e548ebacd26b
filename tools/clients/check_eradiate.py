"""Eradiate's own schema accepts the files, and particle layers are built from them.

A spheroid's six elements are compared, in the order in which Eradiate counts them, with our own CSV.
"""

import csv
import sys

import numpy as np
import xarray as xr

import eradiate

eradiate.set_mode("mono")
from eradiate.radprops import ParticleProperties  # noqa: E402

# Places of the elements in Eradiate's kernel parameters and in its converter from libRadtran.
PLACES = {"11": 0, "12": 1, "33": 2, "34": 3, "22": 4, "44": 5}


def load(path, wavelength):
    data = xr.load_dataset(path)
    mu, p11 = data["mu"].values, data["phase"].sel(phamat="11").values
    integral = np.trapezoid(p11, mu, axis=1)
    print("integral over mu:", integral, "asymmetry:", 0.5 * np.trapezoid(p11 * mu, mu, axis=1))
    assert np.allclose(integral, 2.0, atol=1e-6) and np.all(np.diff(mu, axis=1) > 0)
    properties = ParticleProperties.convert(data) if hasattr(ParticleProperties, "convert") \
        else ParticleProperties(data)
    layer = eradiate.scenes.atmosphere.ParticleLayer(
        bottom=0.0, top=2000.0, tau_ref=0.2, particle_properties=properties,
        w_ref=float(data["w"][wavelength]),
    )
    print("particle layer:", type(layer).__name__, "optical thickness 0.2,",
          properties.particle_shape, "with", data.sizes["phamat"], "elements")
    return data, properties


_, sphere = load(sys.argv[1], 1)
assert sphere.particle_shape == "spherical"
data, spheroid = load(sys.argv[2], 0)
assert spheroid.particle_shape == "spheroidal"
with open(sys.argv[3]) as file:
    rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
p11 = np.array([float(row["p11_per_sr"]) for row in rows])[::-1]
for name, place in PLACES.items():
    ours = np.array([float(row[f"p{name}_per_sr"]) for row in rows])[::-1]
    assert str(data["phamat"].values[place]) == name
    theirs = np.squeeze(spheroid.phase.transpose("phamat", "w", "iangle").values[place])
    scale = np.squeeze(spheroid.phase.transpose("phamat", "w", "iangle").values[0]) / p11
    worst = np.max(abs(theirs / scale - ours) / p11)
    print(f"element {name} at place {place}: {worst:.1e} of P11 from the CSV")
    assert worst < 1e-5
