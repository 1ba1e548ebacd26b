"""The program beside the package: tests compare with its files."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def program():
    """Runs the program ``gonio``: that of GONIO_PROGRAM, of the target folder, or of the path."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release" / "gonio"
    found = os.environ.get("GONIO_PROGRAM") or (str(target) if target.exists() else shutil.which("gonio"))
    if not found:
        pytest.skip("no program gonio to compare with: cargo build --release")

    def run(*arguments, **environment):
        subprocess.run(
            [found, *map(str, arguments)], check=True, capture_output=True, env={**os.environ, **environment}
        )

    return run
