#!/usr/bin/env python3
"""Time and error of layered spheres and radial profiles beside scattnlay (PyPI), in the same run.

    python3 -m venv venv && venv/bin/pip install scattnlay numpy
    venv/bin/python tools/layered_against_scattnlay.py target/release/gonio

CPU seconds of one call each (gonio: its own `seconds`, wall, the best of ten; one thread). Errors of profiles are those
of S1 and S2 over 0 to 180 degrees, relative L2, against gonio with itself converged (1e-11).
"""

import json
import subprocess
import sys
import time

import numpy as np
from scattnlay import scattnlay

GONIO = sys.argv[1] if len(sys.argv) > 1 else "target/release/gonio"
THETA = np.linspace(0, 180, 361)


def gonio(x, medium, tolerance="0.01", threads="1", repeat=10):
    """Best of some: seconds, S1, S2, q_ext."""
    best = None
    for _ in range(repeat):
        command = [GONIO, "scatter", "--method", "mie", "--size-parameter", repr(float(x)), "--theta",
                   "0:180:0.5", "--medium", medium, "--json", "--threads", threads,
                   "--tolerance", tolerance]
        answer = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
        if best is None or answer["seconds"] < best["seconds"]:
            best = answer
    pairs = lambda key: np.array(best[key]) @ np.array([1, 1j])
    return best["seconds"], pairs("s1"), pairs("s2"), best["q_ext"]


def nlay(x, m):
    start = time.process_time()
    answer = scattnlay(np.array(x), np.array(m), np.radians(THETA))
    return time.process_time() - start, answer[8], answer[9], answer[1]


def l2(s, reference):
    difference = sum(np.sum(abs(a - b) ** 2) for a, b in zip(s, reference))
    return (difference / sum(np.sum(abs(b) ** 2) for b in reference)) ** 0.5


for x in (100.0, 1000.0):
    layers = "{ layers = [ { radius_fraction = 0.8, medium = 1.333 }, { medium = 1.47 } ] }"
    own, s1, s2, q = gonio(x, layers)
    other, t1, t2, p = nlay([0.8 * x, x], [1.333 + 0j, 1.47 + 0j])
    print(f"two layers, x = {x:g}, 361 angles: gonio {own * 1e3:.3f} ms, scattnlay {other * 1e3:.1f} ms, "
          f"ratio {other / own:.0f}; difference {l2((s1, s2), (t1, t2)):.1e}, Q {q - p:.1e}")

x, lens = 100.0, '{ profile = "luneburg", c = 2.0 }'
_, s1, s2, q = gonio(x, lens, "1e-4")
for tolerance in ("0.9", "0.01"):
    own, t1, t2, p = gonio(x, lens, tolerance)
    print(f"Luneburg c = 2, x = {x:g}, 361 angles, tolerance {tolerance}: gonio {own * 1e3:.2f} ms, error "
          f"{l2((t1, t2), (s1, s2)):.1e}")
    if tolerance == "0.9":
        fast = own
for count in (500, 2000, 8000):
    edges = np.arange(1, count + 1) / count
    other, t1, t2, p = nlay(x * edges, np.sqrt(2 - (edges - 0.5 / count) ** 2) + 0j)
    print(f"  scattnlay, {count} layers: {other * 1e3:.0f} ms, error {l2((t1, t2), (s1, s2)):.1e}, "
          f"ratio {other / fast:.0f}")

# Forty random spheres of one to four layers, half of the layers absorbing: amplitudes and extinction.
rng, worst = np.random.default_rng(5), 0.0
for _ in range(40):
    x, count = 10 ** rng.uniform(-0.5, 2), rng.integers(1, 5)
    radii = np.append(np.sort(rng.uniform(0.1, 0.98, count - 1)), 1.0)
    n = rng.uniform(0.8, 2.2, count)
    k = np.where(rng.random(count) < 0.5, 0, 10 ** rng.uniform(-4, 0, count))
    layers = ", ".join(f"{{ radius_fraction = {r:.17g}, medium = {{ index = [{a:.17g}, {b:.17g}] }} }}"
                       for r, a, b in zip(radii, n, k))
    _, s1, s2, q = gonio(x, f"{{ layers = [ {layers} ] }}", repeat=1)
    _, t1, t2, p = nlay(x * radii, n + 1j * k)
    worst = max(worst, l2((s1, s2), (t1, t2)), abs(q / p - 1))
print(f"40 random spheres of 1 to 4 layers, x = 0.3 to 100: largest difference {worst:.1e}")
