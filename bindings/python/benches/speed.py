"""Lorenz–Mie beside scatrs and miepython, in one run and in turns: the best of several counts.

    .tools/wheel-3.11/bin/python -m pip install "scatrs==0.3.*" miepython numba
    MIEPYTHON_USE_JIT=1 .tools/wheel-3.11/bin/python bindings/python/benches/speed.py

Processor time of one call, so that other load on the machine hurts all alike; all on one thread.
"""

import os
import time

os.environ.setdefault("MIEPYTHON_USE_JIT", "1")

import miepython  # noqa: E402
import numpy as np  # noqa: E402
import scatrs.mie  # noqa: E402

import gonio  # noqa: E402

INDEX = 1.333
THETA = np.linspace(0, 180, 1801)
MU = np.cos(np.radians(THETA))


def seconds(call, calls=1):
    start = time.process_time()
    for _ in range(calls):
        call()
    return (time.process_time() - start) / calls


def main():
    print("| x | gonio (ms) | scatrs (ms) | ratio | miepython (ms) | ratio | largest difference to scatrs |")
    print("|---|---|---|---|---|---|---|")
    for x in (10.0, 1000.0, 10_000.0):
        ours = lambda: gonio.mie.amplitudes(x, INDEX, theta_deg=THETA, threads=1)  # noqa: E731, B023
        theirs = lambda: scatrs.mie.amplitudes(x, INDEX, MU)  # noqa: E731, B023
        peers = lambda: miepython.S1_S2(INDEX, x, MU, norm="wiscombe")  # noqa: E731, B023
        for call in (ours, theirs, peers):
            call()
        calls = 100 if x < 100 else 3
        best = [float("inf")] * 3
        for _ in range(7):
            best = [min(b, seconds(call, calls)) for b, call in zip(best, (ours, theirs, peers), strict=True)]
        a, b = ours()[0], theirs().s1
        off = np.max(abs(a - b)) / np.max(abs(a))
        one, two, three = (1e3 * b for b in best)
        print(f"| {x:g} | {one:.3g} | {two:.3g} | {two / one:.1f} | {three:.3g} | {three / one:.1f} | {off:.1e} |")
    calls = 100_000
    each = min(seconds(lambda: gonio.mie.amplitudes(1.0, INDEX, theta_deg=30.0), calls) for _ in range(3))
    print(f"\n{calls} calls, x = 1, one angle: {1e6 * each:.2f} µs each")
    x = np.geomspace(1, 1000, 10_000)
    cores = os.cpu_count()
    best = dict.fromkeys((1, cores), (float("inf"), 0.0))
    for _ in range(5):
        for threads in best:
            start = time.perf_counter(), time.process_time()
            gonio.mie.amplitudes(x, INDEX, theta_deg=THETA[::10], threads=threads)
            best[threads] = min(best[threads], (time.perf_counter() - start[0], time.process_time() - start[1]))
    for threads, (wall, used) in best.items():
        print(f"10 000 sizes, 181 angles, {threads} threads: {wall:.2f} s on the clock, {used / wall:.2f} cores busy")
    print(f"{cores} threads are {best[1][0] / best[cores][0]:.2f} times as fast as one")


if __name__ == "__main__":
    main()
