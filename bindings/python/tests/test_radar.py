"""Radar and T-matrices beside independent values and beside the program."""

import csv
import itertools
import json

import numpy as np
import pytest

import gonio
from conftest import ROOT


def reference():
    """Rows of an independent T-matrix of raindrops: radius, x, n, k, elevation, azimuth, angle, amplitudes."""
    with open(ROOT / "tests/data/tmatrix_raindrop.csv", encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))[1:]
    return [tuple(map(float, row)) for row in rows]


def test_raindrops_of_an_independent_t_matrix():
    curves = 0
    for (radius, x, n, k), body in itertools.groupby(reference(), key=lambda row: row[:4]):
        t = gonio.tmatrix.TMatrix(x, complex(n, k), shape="raindrop", diameter_mm=2 * radius, tolerance=1e-6)
        assert t.error < 1e-6
        for (elevation, azimuth), curve in itertools.groupby(body, key=lambda row: row[4:6]):
            rows = np.array(list(curve))
            known = rows[:, 7::2] + 1j * rows[:, 8::2]
            found = t.amplitudes(theta_deg=rows[:, 6], azimuth_deg=azimuth, elevation_deg=elevation)
            wrong = np.linalg.norm(np.stack(found, axis=-1) - known) / np.linalg.norm(known)
            assert wrong < 1e-6, (radius, x, elevation, azimuth)
            curves += 1
    assert curves > 36


def test_a_sphere_is_lorenz_mie():
    x, m, theta = 12.0, 1.4 + 0.02j, np.linspace(0, 180, 19)
    t = gonio.tmatrix.TMatrix(x, m, shape="sphere", tolerance=1e-6)
    s1, s2 = gonio.mie.amplitudes(x, m, theta_deg=theta)
    found = t.amplitudes(theta_deg=theta, azimuth_deg=40.0, elevation_deg=10.0)
    assert np.allclose(found.s1, s1, atol=1e-10 * abs(s1[0])) and np.allclose(found.s2, s2, atol=1e-10 * abs(s1[0]))
    mean = t.random(tolerance=1e-8)
    q = gonio.mie.efficiencies(x, m)
    assert tuple(mean.efficiencies) == pytest.approx(tuple(q), rel=1e-7)
    assert mean.coefficients[0, 0] == pytest.approx(1) and mean.coefficients[1, 0] == pytest.approx(3 * q.asymmetry)
    matrix = mean.scattering_matrix(theta_deg=theta)
    scale = 4 / (q.q_sca * x**2)
    assert np.allclose(matrix[:, 0, 0], scale * (abs(s1) ** 2 + abs(s2) ** 2) / 2, rtol=1e-6)
    assert np.allclose(matrix[:, 2, 3], scale * (s2 * s1.conj()).imag, atol=1e-8 * matrix[0, 0, 0])


def test_the_two_millimetre_drop_at_x_band():
    pytest.importorskip("xarray")
    seen = gonio.radar(frequency_ghz=10, temperature_c=20, diameter_mm=4).squeeze()
    assert float(seen.z_dr) == pytest.approx(2.60, abs=5e-3)
    assert float(seen.k_dp) == pytest.approx(0.127, abs=5e-4)
    assert float(seen.rho_hv) == pytest.approx(1) and float(seen.ldr) == -np.inf
    assert seen.z_dr.attrs["units"] == "dB" and seen.attrs["shape"] == "raindrop"


def test_the_published_example_of_pytmatrix():
    """Its test of radar quantities: C band, 10 °C, spheroids after Thurai et al., canting of 20°."""
    pytest.importorskip("xarray")
    seen = gonio.radar(
        wavelength_mm=53.5, index=8.601 + 1.687j, shape="spheroid", normalised_gamma=(1000, 2, 4), to_diameter_mm=6,
        from_diameter_mm=0, canting_deg=20, tolerance=1e-4,
    ).squeeze()
    known = {"z_h": 6383.73378973, "z_v": 5066.721040036321, "rho_hv": 0.996030804609838, "k_dp": 0.19334678024367824,
             "a_h": 0.018923976733777458}
    for name, value in known.items():
        assert float(seen[name]) == pytest.approx(value, rel=3e-4), name
    assert 10 ** (0.1 * float(seen.ldr)) == pytest.approx(0.0021960626647629547, rel=2e-3)
    assert "temperature_c" not in seen.coords


def test_it_is_what_the_program_says(program, tmp_path):
    pytest.importorskip("xarray")
    program("radar", "--band", "S,Ka", "--temperature-c", "0,20", "--diameter-mm", "1,3", "--canting-deg", "7",
            "--elevation-deg", "20", "--json", "-o", tmp_path / "seen.json")
    rows = json.loads((tmp_path / "seen.json").read_text())["rows"]
    seen = gonio.radar(band=["S", "Ka"], temperature_c=[0, 20], diameter_mm=[1, 3], canting_deg=7, elevation_deg=20)
    assert seen.z_dr.shape == (2, 2, 2) and list(seen.band.values) == ["S", "Ka"]
    names = {"z_h": "z_h_mm6_m3", "z_dr": "z_dr_db", "rho_hv": "rho_hv", "k_dp": "k_dp_deg_km", "a_dp": "a_dp_db_km"}
    for name, column in names.items():
        assert seen[name].values.ravel().tolist() == [row[column] for row in rows], name
    assert seen.frequency_ghz.values.tolist() == [2.8, 35.5]


def test_counted_drops_are_summed_and_threads_change_nothing():
    pytest.importorskip("xarray")
    diameters, numbers = [0.5, 1.0, 2.0, 3.0], [300.0, 100.0, 20.0, 2.0]
    together = gonio.radar(band="X", diameter_mm=diameters, number_per_m3=numbers)
    alone = gonio.radar(band="X", diameter_mm=diameters).squeeze()
    assert together.z_h.item() == pytest.approx(float((alone.z_h * numbers).sum()), rel=1e-12)
    assert "diameter_mm" not in together.dims
    one = gonio.radar(band="X", marshall_palmer_mm_h=5, shape="spheroid", threads=1)
    assert one.identical(gonio.radar(band="X", marshall_palmer_mm_h=5, shape="spheroid", threads=3))


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"diameter_mm": 1}, "nothing given: one of band, frequency_ghz, wavelength_mm"),
        ({"band": "X"}, "one of diameter_mm, marshall_palmer_mm_h"),
        ({"band": "X", "frequency_ghz": 9, "diameter_mm": 1}, "band and frequency_ghz given"),
        ({"band": "Q", "diameter_mm": 1}, "band = Q: S, C, X, Ku, Ka, W"),
        ({"band": "X", "diameter_mm": 20}, "drop model"),
        ({"band": "X", "diameter_mm": -1}, "diameter_mm = -1"),
        ({"band": "X", "diameter_mm": [[1]]}, "a number or a list"),
        ({"band": "X", "diameter_mm": "many"}, "diameter_mm = 'many'"),
        ({"band": "X", "diameter_mm": [1, 2], "number_per_m3": [1]}, "1 values for 2"),
        ({"band": "X", "marshall_palmer_mm_h": -1}, "marshall_palmer_mm_h = -1: 1e-3 to 1000"),
        ({"band": "X", "marshall_palmer_mm_h": 1, "number_per_m3": 2}, "own numbers of drops"),
        ({"band": "X", "diameter_mm": 1, "from_diameter_mm": 1}, "accepted with a spectrum"),
        ({"band": "X", "marshall_palmer_mm_h": 1, "from_diameter_mm": 7, "to_diameter_mm": 6}, "two ascending"),
        ({"band": "X", "exponential": (8000, -1)}, "exponential = -1: numbers above 0"),
        ({"band": "X", "diameter_mm": 1, "temperature_c": 90}, "temperature_c = 90"),
        ({"band": "X", "diameter_mm": 1, "water": "heavy"}, "liebe-1991 and turner-2016"),
        ({"band": "X", "diameter_mm": 1, "index": 1}, "scatters nothing"),
        ({"band": "X", "diameter_mm": 1, "index": 2 - 1j}, "k ≥ 0"),
        ({"band": "X", "diameter_mm": 1, "shape": "cube"}, "raindrop, spheroid and sphere"),
        ({"band": "X", "diameter_mm": 1, "axis_ratio": 0.9}, 'only shape = "spheroid"'),
        ({"band": "X", "diameter_mm": 1, "shape": "spheroid", "axis_ratio": "flat"}, "thurai-2007"),
        ({"band": "X", "diameter_mm": 1, "canting_deg": 91}, "canting_deg = 91: 0 to 90"),
        ({"frequency_ghz": float("nan"), "diameter_mm": 1}, "frequency_ghz = NaN"),
    ],
)
def test_words(keys, words):
    pytest.importorskip("xarray")
    with pytest.raises(ValueError, match=words):
        gonio.radar(**keys)


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda t: t(5.0, 1.33), ValueError, "axis_ratio = None"),
        (lambda t: t(5.0, 1.33, axis_ratio=20), ValueError, "axis"),
        (lambda t: t(-5.0, 1.33, axis_ratio=0.8), ValueError, "size parameter = -5"),
        (lambda t: t(5.0, 1.33 - 1j, axis_ratio=0.8), ValueError, "k ≥ 0"),
        (lambda t: t(5.0, 1.33, axis_ratio=0.8, tolerance=2), ValueError, "tolerance = 2: 1e-8 to 0.5"),
        (lambda t: t(5.0, 1.33, shape="raindrop"), ValueError, "diameter_mm = None"),
        (lambda t: t(5000.0, 1.33, axis_ratio=0.8), ValueError, "degrees"),
        (lambda t: t(100.0, 1.33, axis_ratio=0.2), RuntimeError, "does not converge"),
        (lambda t: t(5.0, 1.33, axis_ratio=0.8).amplitudes(theta_deg=200), ValueError, "theta_deg = 200"),
        (
            lambda t: t(5.0, 1.33, axis_ratio=0.8).amplitudes(theta_deg=[1, 2], azimuth_deg=[1, 2, 3]),
            ValueError,
            "theta_deg and azimuth_deg do not broadcast",
        ),
        (lambda t: t(5.0, 1.33, axis_ratio=0.8).efficiencies(elevation_deg=100), ValueError, "elevation_deg = 100"),
    ],
)
def test_words_of_t_matrices(call, error, words):
    with pytest.raises(error, match=words):
        call(gonio.tmatrix.TMatrix)
