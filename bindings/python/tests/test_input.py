"""What is wrong is said: field, value, what is accepted."""

import numpy as np
import pytest

import gonio


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda: gonio.mie.amplitudes(-1.0, 1.33, theta_deg=0.0), ValueError, "size parameter = -1: accepted"),
        (lambda: gonio.mie.amplitudes([1.0, np.nan], 1.33, theta_deg=0.0), ValueError, "size parameter = NaN"),
        (lambda: gonio.mie.amplitudes("a", 1.33, theta_deg=0.0), ValueError, "x = 'a'.*accepted"),
        (lambda: gonio.mie.amplitudes([1j], 1.33, theta_deg=0.0), ValueError, "x = .*accepted"),
        (lambda: gonio.mie.amplitudes(1.0, 1.3 - 1j, theta_deg=0.0), ValueError, "relative index.*k ≥ 0"),
        (lambda: gonio.mie.amplitudes(1.0, 1.3, theta_deg=190), ValueError, "theta_deg = 190.*0 to 180"),
        (lambda: gonio.mie.amplitudes(1.0, 1.3, theta_deg=[0, np.inf]), ValueError, "theta_deg = inf"),
        (lambda: gonio.mie.amplitudes([1, 2, 3], [1.3, 1.4], theta_deg=0), ValueError, r"\[3\] and \[2\]"),
        (lambda: gonio.mie.amplitudes(1.0, 1.3, 30), TypeError, "positional"),
        (lambda: gonio.mie.amplitudes(1.0, 1.3, theta_deg=[0.0], threads=0), ValueError, "threads = 0.*1 to 1024"),
        (lambda: gonio.mie.amplitudes(1e9, 1.3, theta_deg=0.0), ValueError, "at most 20000000"),
        (
            lambda: gonio.mie.amplitudes(np.ones(10**6), 1.3, theta_deg=np.zeros(10**7)),
            MemoryError,
            "fewer angles",
        ),
        (lambda: gonio.mie.legendre(1.0, 1.3, count=0), ValueError, "count = 0"),
        (lambda: gonio.debye.amplitudes(1.0, 1.3, theta_deg=0, order=-1), ValueError, "order = -1"),
        (lambda: gonio.debye.amplitudes(1.0, 1.3, theta_deg=0, order="two"), ValueError, "order = 'two'"),
        (lambda: gonio.debye.amplitudes(1.0, 1.3, theta_deg=0, order=[]), ValueError, r"order = \[\]"),
        (lambda: gonio.Sphere(radius_um=-1), ValueError, "particle.radius_um = -1"),
        (lambda: gonio.Sphere(), ValueError, "particle.radius_mm is missing"),
        (lambda: gonio.Sphere(5), TypeError, "positional"),
        (lambda: gonio.Sphere(radius_um=float("nan")), ValueError, "finite numbers"),
        (lambda: gonio.Particle(radius_um=1), TypeError, "Sphere, Spheroid"),
        (lambda: gonio.Sphere(radius_um=1, medium="watr"), ValueError, "did you mean"),
        (lambda: gonio.Spheroid(radius_um=1), ValueError, "axis_ratio"),
        (lambda: gonio.Crystal(radius_um=1), TypeError, "Crystal is what"),
        (lambda: gonio.Octahedron("random"), TypeError, "positional"),
        (lambda: gonio.HexagonalColumn(radius_um=20, axis_ratio=100, medium="ice"), ValueError, "0.02 to 50"),
        (lambda: gonio.plan(gonio.HexagonalColumn(radius_um=0.5, axis_ratio=1)), ValueError, "size parameter"),
        (lambda: gonio.Cuboid(radius_um=20, axis_ratio=1, orientation="upwards"), ValueError, "upright"),
        (lambda: gonio.Mesh(file="none.obj", radius_um=20), ValueError, "none.obj: No such file"),
        (lambda: gonio.Mesh(radius_um=20), ValueError, "particle.file is missing"),
        (lambda: gonio.Harmonics(radius_um=20, coefficients=[]), ValueError, "1 to 32 numbers"),
        (lambda: gonio.Superellipsoid(radius_um=20, axis_ratio=1, exponent=9), ValueError, "2 to 4"),
        (lambda: gonio.mixture([(0.2, gonio.Sphere(radius_um=1))]), ValueError, "add up to"),
        (lambda: gonio.mixture([(1, gonio.Sphere(radius_um=1))], by="count"), ValueError, "by = 'count'"),
        (lambda: gonio.mixture([gonio.Sphere(radius_um=1)]), TypeError, "pairs of a share and a particle"),
        (lambda: gonio.material("watr"), ValueError, 'did you mean "water"'),
        (lambda: gonio.material("N-BK7").index(50.0), ValueError, "300"),
        (lambda: gonio.material({"sellmeier": 1}), ValueError, "sellmeier"),
        (lambda: gonio.plan({"particle": {"shape": "sphere", "radius": 1}}), ValueError, "did you mean `radius_um`"),
        (lambda: gonio.plan("nofile.toml"), ValueError, "nofile.toml: cannot read"),
        (lambda: gonio.plan("[particle]\nshape='sphere'\nradius_um=-2"), ValueError, "line 3: particle.radius_um"),
        (lambda: gonio.plan(3), TypeError, "scene = 3"),
    ],
)
def test_words(call, error, words):
    with pytest.raises(error, match=words):
        call()


def test_huge_tables_are_refused_at_once():
    pytest.importorskip("xarray")
    sphere = gonio.Sphere(radius_um=1)
    with pytest.raises(ValueError, match="theta_deg"):
        gonio.table(sphere, table={"theta_deg": {"from": 0, "to": 180, "count": 10**9}})
    many = {"from": 0, "to": 180, "count": 10**6}
    with pytest.raises(MemoryError, match="fewer angles or wavelengths"):
        wavelengths = {"from": 400, "to": 700, "count": 10**5}
        gonio.table(sphere, light={"wavelengths_nm": wavelengths}, table={"theta_deg": many})


def test_environment(monkeypatch):
    monkeypatch.setenv("GONIO_THREADS", "3")
    assert gonio._gonio.threads() == 3
    assert gonio._gonio.threads(2) == 2
    monkeypatch.setenv("GONIO_THREADS", "many")
    with pytest.raises(ValueError, match="GONIO_THREADS = many"):
        gonio._gonio.threads()


def test_scatter_refuses_many_sizes():
    pytest.importorskip("xarray")
    many = gonio.Sphere(
        size_distribution={"kind": "gamma", "effective_radius_um": 10, "effective_variance": 0.1}
    )
    with pytest.raises(ValueError, match="make a table of many"):
        gonio.scatter(many, wavelength_nm=550, theta_deg=[0])
    with pytest.raises(ValueError, match="wavelength_nm"):
        gonio.scatter(gonio.Sphere(radius_um=1), wavelength_nm=-5, theta_deg=[0])
