"""Memory of a table as a Dataset, beside that of the program which writes it to a file: most that was resident at once.

    .tools/wheel-3.11/bin/python bindings/python/benches/memory.py target/release/gonio
"""

import os
import sys
import tempfile
from pathlib import Path

SCENE = """
[particle]
shape = "spheroid"
radius_um = 0.3
axis_ratio = 0.8
medium = { index = [1.33, 0.0] }
[light]
wavelengths_nm = { from = 400, to = 720, count = 33 }
[table]
theta_deg = { from = 0, to = 180, count = 1801 }
azimuth_deg = { from = 0, to = 360, count = 361 }
"""
ARRAY = 33 * 1801 * 361 * 4 / 2**20


def most(*command):
    """MiB that a command had resident at most."""
    child = os.posix_spawn(command[0], command, os.environ)
    _, status, used = os.wait4(child, 0)
    assert status == 0, command
    return used.ru_maxrss / 1024


with tempfile.TemporaryDirectory() as folder:
    scene = Path(folder) / "scene.toml"
    scene.write_text(SCENE)
    bare = most(sys.executable, "-c", "import gonio, xarray")
    ours = most(sys.executable, "-c", f"import gonio; gonio.table({str(scene)!r})")
    program = most(sys.argv[1], "table", str(scene), "-o", f"{folder}/t.h5", "--no-preview")
accepted = program + 2 * ARRAY
print(f"array {ARRAY:.0f} MiB; program {program:.0f} MiB; Python {ours:.0f} MiB, of which {bare:.0f} before the table; "
      f"program + 2 arrays = {accepted:.0f} MiB")
assert ours - bare < accepted
