#!/usr/bin/env python3
"""Multiple-precision Lorenz-Mie and Debye references for tests/data/*_large.json.

A literal transcription of Bohren & Huffman 1983 (eq. 4.88, 4.74) in MPFR arithmetic (gmpy2), with
nothing in common with the Rust code: psi, chi by plain recurrences with digits to spare, pi and
tau by eq. 4.47 in cos(theta).

    pip install gmpy2; python3 tools/mie_reference.py > tests/data/mie_large.json
"""
import json
import math
import sys

import gmpy2
from gmpy2 import mpc, mpfr

gmpy2.get_context().precision = 400

CASES = [(10000.0, 1.333, 0.0), (10000.0, 1.333, 1e-5), (50000.0, 1.333, 0.0), (0.0001, 1.333, 0.0),
         (0.0001, 1.5, 1e-9), (0.01, 1.333, 0.0)]
THETA = [0, 0.01, 0.1, 1, 10, 45, 60, 89.9, 90, 120, 128, 129, 130, 137, 138, 139, 140, 142, 145, 170, 179, 179.9, 180]


def upward(z, top):
    """psi_0..top and chi_0..top upward; harmless at this precision (it loses < 60 digits)."""
    psi = [gmpy2.sin(z)]
    chi = [gmpy2.cos(z)]
    psi.append(psi[0] / z - chi[0])
    chi.append(chi[0] / z + psi[0])
    for n in range(1, top):
        f = (2 * n + 1) / z
        psi.append(f * psi[n] - psi[n - 1])
        chi.append(f * chi[n] - chi[n - 1])
    return psi, chi


def log_derivative(z, top):
    start = int(max(top, abs(complex(z))) + 40 * abs(complex(z)) ** (1 / 3) + 120)
    d = [None] * (top + 1)
    value = 0 * z
    for n in range(start, 0, -1):
        if n <= top:
            d[n] = value
        value = n / z - 1 / (value + n / z)
    return d


def case(x, n_index, k_index):
    x = mpfr(x)
    m = mpc(mpfr(n_index), mpfr(k_index)) if k_index else mpfr(n_index)
    top = int(float(x) + 9 * float(x) ** (1 / 3) + 10)
    psi, chi = upward(x, top)
    d = log_derivative(m * x, top)
    a, b = [0], [0]
    for n in range(1, top + 1):
        xi, xi_before = mpc(psi[n], -chi[n]), mpc(psi[n - 1], -chi[n - 1])
        for out, h in ((a, d[n] / m), (b, m * d[n])):
            f = h + n / x
            out.append((f * psi[n] - psi[n - 1]) / (f * xi - xi_before))
    theta = [t for t in THETA]
    s1s, s2s = [], []
    for t in theta:
        # the angle is the double nearest to t degrees in radians, exactly as a caller passes it
        mu = gmpy2.cos(mpfr(math.radians(t)))
        pi_before, pi = mpfr(0), mpfr(1)
        s1, s2 = mpc(0), mpc(0)
        for n in range(1, top + 1):
            tau = n * mu * pi - (n + 1) * pi_before
            w = mpfr(2 * n + 1) / (n * (n + 1))
            s1 += w * (a[n] * pi + b[n] * tau)
            s2 += w * (a[n] * tau + b[n] * pi)
            pi_before, pi = pi, ((2 * n + 1) * mu * pi - (n + 1) * pi_before) / n
        s1s.append(s1)
        s2s.append(s2)
    qsca = 2 / x**2 * sum((2 * n + 1) * (gmpy2.norm(a[n]) + gmpy2.norm(b[n])) for n in range(1, top + 1))
    qext = 2 / x**2 * sum((2 * n + 1) * (a[n] + b[n]).real for n in range(1, top + 1))
    back = sum((2 * n + 1) * (-1) ** n * (a[n] - b[n]) for n in range(1, top + 1))
    g = sum(
        mpfr(2 * n + 1) / (n * (n + 1)) * (a[n] * b[n].conjugate()).real
        + (mpfr(n * (n + 2)) / (n + 1) * (a[n] * a[n + 1].conjugate() + b[n] * b[n + 1].conjugate()).real if n < top else 0)
        for n in range(1, top + 1)
    ) * 4 / x**2 / qsca
    return {
        "x": float(x), "m_re": n_index, "m_im": k_index, "theta_deg": theta,
        "qext": float(qext), "qsca": float(qsca), "qabs": float(qext - qsca) if k_index else 0.0,
        "qback": float(gmpy2.norm(back) / x**2), "g": float(g),
        "s1_re": [float(s.real) for s in s1s], "s1_im": [float(s.imag) for s in s1s],
        "s2_re": [float(s.real) for s in s2s], "s2_im": [float(s.imag) for s in s2s],
    }


json.dump({"generator": "tools/mie_reference.py, gmpy2 " + gmpy2.version() + ", 400 bits",
           "cases": [case(*c) for c in CASES]}, sys.stdout, indent=0)
