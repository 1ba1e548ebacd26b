"""What type checkers are shown: calls as users write them."""

from typing import Any, assert_type

import numpy as np
import xarray as xr
from numpy.typing import NDArray

import gonio

one = gonio.mie.amplitudes(1.0, 1.33 + 0.01j, theta_deg=30.0)
assert_type(one, tuple[complex, complex])
s1, s2 = gonio.mie.amplitudes(np.linspace(1, 2, 5), 1.33, theta_deg=[0.0, 10.0])
assert_type(s1, NDArray[np.complex128])
q = gonio.mie.efficiencies([1.0, 2.0], 1.33)
assert_type(q, gonio.mie.Efficiencies)
assert_type(gonio.mie.legendre(1.0, 1.5), NDArray[np.float64])
bow, _ = gonio.debye.amplitudes(100.0, 1.33, theta_deg=np.linspace(130, 150, 5), order=[2, "diffraction"])
assert_type(bow, NDArray[np.complex128])

drop = gonio.Sphere(radius_um=10, medium="water")
table = gonio.table(drop, light={"wavelengths_nm": [550]}, table={"theta_deg": [0, 90, 180]})
assert_type(table, xr.Dataset)
assert_type(gonio.scatter(drop, wavelength_nm=550, theta_deg=[10, 20]), xr.Dataset)
assert_type(gonio.lee(radius_mm=[0.01], theta_deg=[138, 140], fineness=0.3), xr.Dataset)
assert_type(gonio.batch(drop, {"particle.radius_um": [1, 2]}, light={"wavelengths_nm": [550]}), xr.Dataset)
assert_type(gonio.material("N-BK7").name, str)
assert_type(gonio.media(), dict[str, str])
assert_type(gonio.radar(band="X", diameter_mm=[1, 2]), xr.Dataset)
t = gonio.tmatrix.TMatrix(2.0, 1.33 + 0.01j, axis_ratio=0.8)
assert_type(t.amplitudes(theta_deg=[0, 90]).s1, NDArray[np.complex128])
assert_type(t.efficiencies(), gonio.mie.Efficiencies)
assert_type(t.random().scattering_matrix(theta_deg=0), NDArray[np.float64])
plate = gonio.HexagonalColumn(radius_um=20, axis_ratio=0.2, medium="ice", orientation={"kind": "random", "count": 64})
assert_type(plate.axis_ratio, float | None)
assert_type(gonio.mixture([(0.5, plate), (0.5, gonio.Octahedron(radius_um=20, medium="ice"))])["particles"], Any)
