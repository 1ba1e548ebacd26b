"""The calls of docs/from_elsewhere.md beside those of the programs they replace, with the numbers compared.

Behind a switch: GONIO_PEERS=1 tools/wheel.sh
"""

import os

import numpy as np
import pytest

import gonio

pytestmark = pytest.mark.skipif("GONIO_PEERS" not in os.environ, reason="GONIO_PEERS is not set")

X, M = 12.3, 1.5 + 0.02j
THETA = np.linspace(0, 180, 37)
MU = np.cos(np.radians(THETA))


def test_miepython_efficiencies():
    miepython = pytest.importorskip("miepython")
    # miepython: m = n - ik; qext, qsca, qback, g
    qext, qsca, qback, g = miepython.efficiencies_mx(M.conjugate(), X)
    q = gonio.mie.efficiencies(X, M)
    assert (q.q_ext, q.q_sca, q.q_back, q.asymmetry) == pytest.approx((qext, qsca, qback, g), rel=1e-9)


def test_miepython_amplitudes():
    miepython = pytest.importorskip("miepython")
    # with m = n - ik the amplitudes are conjugated; "wiscombe" is the plain amplitude, "bohren" twice that
    s1, s2 = miepython.S1_S2(M.conjugate(), X, MU, norm="wiscombe")
    ours = gonio.mie.amplitudes(X, M, theta_deg=THETA)
    for theirs, own in zip((s1, s2), ours, strict=True):
        assert np.allclose(np.conj(theirs), own, atol=1e-9 * abs(own).max())


def test_scatrs():
    scatrs = pytest.importorskip("scatrs.mie")
    # m = n + ik as here; the angle as its cosine
    theirs, ours = scatrs.efficiencies(X, M), gonio.mie.efficiencies(X, M)
    known = theirs.q_ext, theirs.q_sca, theirs.q_abs, theirs.q_back, theirs.g
    assert tuple(ours) == pytest.approx(tuple(map(float, known)), rel=1e-9)
    amplitudes = scatrs.amplitudes(X, M, MU)
    for theirs, own in zip((amplitudes.s1, amplitudes.s2), gonio.mie.amplitudes(X, M, theta_deg=THETA), strict=True):
        assert np.allclose(theirs, own, atol=1e-10 * abs(own).max())


def test_pymiescatt():
    # it asks SciPy for a name that current versions have not
    integrate = pytest.importorskip("scipy.integrate")
    for old, new in (("trapz", "trapezoid"), ("simps", "simpson"), ("cumtrapz", "cumulative_trapezoid")):
        if not hasattr(integrate, old):
            setattr(integrate, old, getattr(integrate, new))
    PyMieScatt = pytest.importorskip("PyMieScatt", exc_type=ImportError)

    # wavelength and diameter in nm, m = n + ik
    nm, diameter = 532.0, 900.0
    qext, qsca, qabs, g, _, qback, _ = PyMieScatt.MieQ(M, nm, diameter)
    q = gonio.mie.efficiencies(np.pi * diameter / nm, M)
    assert (q.q_ext, q.q_sca, q.q_abs, q.asymmetry) == pytest.approx((qext, qsca, qabs, g), rel=1e-4)
    assert q.q_back == pytest.approx(qback, rel=1e-3)


def test_pytmatrix():
    tmatrix = pytest.importorskip("pytmatrix.tmatrix", exc_type=ImportError)
    # lengths in any one unit; axis_ratio is horizontal over rotational: the inverse of ours
    scatterer = tmatrix.Scatterer(radius=1.0, wavelength=2.0, m=1.5 + 0.01j, axis_ratio=1 / 0.8)
    scatterer.set_geometry((90.0, 90.0, 0.0, 180.0, 0.0, 0.0))
    s = scatterer.get_S()
    drop = gonio.Spheroid(radius_um=1.0, axis_ratio=0.8, medium=1.5 + 0.01j)
    seen = gonio.scatter(drop, wavelength_nm=2000, theta_deg=180.0, method="tmatrix", tolerance=1e-4)
    k = 2 * np.pi / 2.0
    ours = abs(seen.s2.item()), abs(seen.s1.item())
    assert sorted(ours) == pytest.approx(sorted((abs(s[0, 0]) * k, abs(s[1, 1]) * k)), rel=2e-3)
