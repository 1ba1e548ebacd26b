"""In an environment that holds the wheel and what it pulled alone: packages, size, time of the import, one result.
Called by tools/wheel.sh --fresh."""

import importlib.metadata
import os
import subprocess
import sys

MOST_BYTES, MOST_SECONDS = 4 << 20, 0.1

names = {distribution.metadata["Name"].lower() for distribution in importlib.metadata.distributions()}
pulled = sorted(names - {"pip", "setuptools", "gonio"})
assert pulled == ["numpy"], f"the wheel pulls {pulled}, numpy alone is accepted"
size = os.path.getsize(sys.argv[1])
assert size < MOST_BYTES, f"the wheel has {size} bytes, at most {MOST_BYTES} are accepted"


def seconds(line):
    """Processor time of a Python that runs a line: the least of five, so that other work on the machine does not count."""
    least = float("inf")
    for _ in range(5):
        before = os.times()
        subprocess.run([sys.executable, "-c", line], check=True)
        after = os.times()
        least = min(least, after.children_user + after.children_system - before.children_user - before.children_system)
    return least


subprocess.run([sys.executable, "-c", "import gonio"], check=True)
spent = seconds("import gonio") - seconds("pass")
assert spent < MOST_SECONDS, f"import gonio takes {spent:.3f} s, at most {MOST_SECONDS} are accepted"

import gonio  # noqa: E402

q = gonio.mie.efficiencies(10.0, 1.33)
assert abs(q.q_ext - q.q_sca) < 1e-12 and 2 < q.q_ext < 3
print(f"Python {sys.version.split()[0]}: {os.path.basename(sys.argv[1])}, {size / 2**20:.2f} MiB, pulls {pulled}, "
      f"import {1e3 * spent:.0f} ms")
