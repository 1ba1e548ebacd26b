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
    k = 2 * np.pi / 2.0
    t = gonio.tmatrix.TMatrix(k, 1.5 + 0.01j, axis_ratio=0.8, tolerance=1e-4)
    seen = t.amplitudes(theta_deg=180.0, azimuth_deg=90.0)
    # vertical, horizontal
    assert (abs(seen.s1), abs(seen.s2)) == pytest.approx((abs(s[0, 0]) * k, abs(s[1, 1]) * k), rel=2e-3)


def test_pytmatrix_radar():
    tmatrix = pytest.importorskip("pytmatrix.tmatrix", exc_type=ImportError)
    from pytmatrix import radar, tmatrix_aux

    index, ratio = 8.0 + 2.0j, 0.7
    scatterer = tmatrix.Scatterer(radius=2.0, wavelength=30.0, m=index, axis_ratio=1 / ratio)
    scatterer.set_geometry(tmatrix_aux.geom_horiz_back)
    z, z_dr = radar.refl(scatterer), 10 * np.log10(radar.Zdr(scatterer))
    scatterer.set_geometry(tmatrix_aux.geom_horiz_forw)
    k_dp, a_h = radar.Kdp(scatterer), radar.Ai(scatterer)
    seen = gonio.radar(
        wavelength_mm=30.0, diameter_mm=4.0, index=index, shape="spheroid", axis_ratio=ratio, tolerance=1e-4
    ).squeeze()
    assert float(seen.z_h) == pytest.approx(z, rel=2e-3)
    assert float(seen.z_dr) == pytest.approx(z_dr, abs=5e-3)
    assert (float(seen.k_dp), float(seen.a_h)) == pytest.approx((k_dp, a_h), rel=2e-3)


def test_pytmatrix_spectrum():
    tmatrix = pytest.importorskip("pytmatrix.tmatrix", exc_type=ImportError)
    from pytmatrix import orientation, psd, radar, tmatrix_aux

    index = 8.601 + 1.687j
    scatterer = tmatrix.Scatterer(wavelength=53.5, m=index)
    scatterer.psd_integrator = psd.PSDIntegrator()
    scatterer.psd_integrator.axis_ratio_func = lambda d: 1 / tmatrix_aux.dsr_thurai_2007(d)
    scatterer.psd_integrator.D_max = 6.0
    scatterer.psd_integrator.num_points = 128
    scatterer.psd_integrator.geometries = (tmatrix_aux.geom_horiz_back, tmatrix_aux.geom_horiz_forw)
    scatterer.or_pdf = orientation.gaussian_pdf(20.0)
    scatterer.orient = orientation.orient_averaged_fixed
    scatterer.psd_integrator.init_scatter_table(scatterer)
    scatterer.psd = psd.GammaPSD(D0=2.0, Nw=1e3, mu=4)
    z, z_dr, rho = radar.refl(scatterer), 10 * np.log10(radar.Zdr(scatterer)), radar.rho_hv(scatterer)
    scatterer.set_geometry(tmatrix_aux.geom_horiz_forw)
    k_dp = radar.Kdp(scatterer)
    seen = gonio.radar(
        wavelength_mm=53.5, index=index, normalised_gamma=(1e3, 2.0, 4), shape="spheroid", canting_deg=20,
        from_diameter_mm=0, to_diameter_mm=6,
    ).squeeze()
    assert (float(seen.z_h), float(seen.k_dp)) == pytest.approx((z, k_dp), rel=2e-3)
    assert float(seen.z_dr) == pytest.approx(z_dr, abs=5e-3) and float(seen.rho_hv) == pytest.approx(rho, abs=5e-4)
