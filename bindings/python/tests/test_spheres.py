"""Amplitudes and efficiencies against independent values, shapes, threads and speed."""

import csv
import json
import threading
import time

import numpy as np
import pytest

import gonio
from conftest import ROOT


def test_efficiencies_of_wiscombe():
    # Wiscombe's MIEV0 test cases (NCAR/TN-140+STR), printed to six decimals
    with open(ROOT / "tests/data/mie_wiscombe_efficiencies.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    rows = [row for row in rows if row["perfect_conductor"] != "1" and float(row["m_n"]) > 0]
    assert len(rows) > 10
    for row in rows:
        found = gonio.mie.efficiencies(float(row["x"]), complex(float(row["m_n"]), float(row["m_k"])))
        assert found.q_ext == pytest.approx(float(row["qext"]), abs=1e-6), row
        assert found.asymmetry == pytest.approx(float(row["g"]), abs=1e-6), row


def test_amplitudes_of_high_precision():
    with open(ROOT / "tests/data/mie_high_precision.json", encoding="utf-8") as file:
        cases = json.load(file)["cases"]
    for case in cases:
        index = complex(case["m_re"], case["m_im"])
        s1, s2 = gonio.mie.amplitudes(case["x"], index, theta_deg=case["theta_deg"])
        for found, name in ((s1, "s1"), (s2, "s2")):
            known = np.array(case[f"{name}_re"]) + 1j * np.array(case[f"{name}_im"])
            assert np.allclose(found, known, rtol=0, atol=2e-11 * abs(known).max()), case["x"]


def test_optical_theorem_and_sum_of_orders():
    x, m = np.array([0.5, 20.0, 300.0]), 1.33 + 1e-3j
    s1, _ = gonio.mie.amplitudes(x, m, theta_deg=0.0)
    assert np.allclose(4 / x**2 * s1.real, gonio.mie.efficiencies(x, m).q_ext, rtol=1e-12)
    theta = np.linspace(0, 180, 19)
    whole = gonio.mie.amplitudes(50.0, m, theta_deg=theta)
    terms = gonio.debye.amplitudes(50.0, m, theta_deg=theta, order="all")
    orders = gonio.debye.amplitudes(50.0, m, theta_deg=theta, order=[*range(200), "diffraction"])
    for a, b, c in zip(whole, terms, orders, strict=True):
        assert np.allclose(a, b, atol=1e-10 * abs(a).max())
        assert np.allclose(a, c, atol=1e-6 * abs(a).max())


def test_broadcasting():
    x, m = np.linspace(1, 2, 6).reshape(3, 2), [1.3, 1.5]
    s1, s2 = gonio.mie.amplitudes(x, m, theta_deg=[[10, 20, 30]])
    assert s1.shape == s2.shape == (3, 2, 1, 3)
    alone = gonio.mie.amplitudes(float(x[2, 1]), 1.5, theta_deg=20.0)
    assert (s1[2, 1, 0, 1], s2[2, 1, 0, 1]) == pytest.approx(alone, rel=1e-13)
    assert all(isinstance(value, complex) for value in alone)
    assert gonio.mie.efficiencies(x, 1.3).q_ext.shape == (3, 2)
    assert gonio.mie.amplitudes([], 1.3, theta_deg=[0.0])[0].shape == (0, 1)
    assert gonio.debye.amplitudes(x, 1.3, theta_deg=5.0, order=2)[0].shape == (3, 2)
    # strided and other kinds of numbers
    assert gonio.mie.efficiencies(np.arange(1, 7)[::2], np.float32(1.5)).q_sca.shape == (3,)


def test_legendre():
    x = np.array([0.1, 10.0])
    chi = gonio.mie.legendre(x, 1.5)
    assert np.allclose(chi[:, 0], 1, atol=1e-12)
    assert np.allclose(chi[:, 1], gonio.mie.efficiencies(x, 1.5).asymmetry, atol=1e-12)
    few = gonio.mie.legendre(x, 1.5, count=5)
    assert np.allclose(few, chi[:, :5], atol=1e-12)
    # the sum is the phase function again
    theta = np.linspace(0, 180, 7)
    s1, s2 = gonio.mie.amplitudes(10.0, 1.5, theta_deg=theta)
    q = gonio.mie.efficiencies(10.0, 1.5).q_sca
    phase = 2 * (abs(s1) ** 2 + abs(s2) ** 2) / (10.0**2 * q)
    factors = (2 * np.arange(chi.shape[1]) + 1) * chi[1]
    assert np.allclose(np.polynomial.legendre.legval(np.cos(np.radians(theta)), factors), phase, rtol=1e-9)


def test_threads_do_not_change_the_result():
    x = np.linspace(100, 400, 200)
    theta = np.linspace(0, 180, 181)
    one = gonio.mie.amplitudes(x, 1.33, theta_deg=theta, threads=1)
    many = gonio.mie.amplitudes(x, 1.33, theta_deg=theta, threads=3)
    assert np.array_equal(one[0], many[0]) and np.array_equal(one[1], many[1])


def test_the_lock_is_released():
    """Python goes on while a long call runs."""
    x = np.linspace(2000, 3000, 400)
    ran = threading.Thread(target=lambda: gonio.mie.amplitudes(x, 1.33, theta_deg=np.linspace(0, 180, 721)))
    ran.start()
    steps = 0
    while ran.is_alive():
        time.sleep(0.001)
        steps += 1
    assert steps > 20


def test_a_call_of_numbers_is_short():
    calls = 2000
    best = min(_seconds(calls) for _ in range(5)) / calls
    # 3 µs on an idle machine; processor time, so that others on it do not count
    assert best < 15e-6, best


def _seconds(calls):
    start = time.process_time()
    for _ in range(calls):
        gonio.mie.amplitudes(1.0, 1.33, theta_deg=30.0)
    return time.process_time() - start


def test_import_needs_no_numpy():
    import subprocess
    import sys

    code = "import gonio, sys; assert not {'numpy', 'xarray', 'matplotlib', 'tqdm'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)
