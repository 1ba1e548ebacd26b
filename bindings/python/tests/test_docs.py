"""Examples of the documentation run; types hold on the examples."""

import doctest
import importlib
import os
import subprocess
import sys
from pathlib import Path

import pytest

import gonio

MODULES = ["gonio", "gonio.mie", "gonio.debye", "gonio.tmatrix", "gonio.particles", "gonio._datasets", "gonio._batch",
           "gonio._lee", "gonio._material", "gonio._radar", "gonio._accessor"]
HERE = Path(__file__).parent


@pytest.mark.parametrize("name", MODULES)
def test_doctests(name):
    pytest.importorskip("xarray")
    module = importlib.import_module(name)
    result = doctest.testmod(module)
    assert result.attempted > 0 and result.failed == 0


def test_everything_is_documented():
    for name in gonio.__all__:
        thing = getattr(gonio, name)
        if callable(thing):
            assert thing.__doc__ and len(thing.__doc__) > 80, name


def test_mypy(tmp_path_factory):
    pytest.importorskip("mypy")
    package = Path(gonio.__file__).parent
    cache = Path(os.environ.get("CARGO_TARGET_DIR", tmp_path_factory.mktemp("mypy"))) / "mypy"
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(cache), "-p", "gonio"]
    environment = {**os.environ, "MYPYPATH": str(package.parent)} if "site-packages" not in str(package) else None
    ran = subprocess.run([*command, "-m", "typed_example"], capture_output=True, text=True, cwd=HERE, env=environment)
    assert ran.returncode == 0, ran.stdout


def test_pyright():
    pytest.importorskip("pyright")
    command = [sys.executable, "-m", "pyright", "--pythonpath", sys.executable, str(HERE / "typed_example.py")]
    ran = subprocess.run(command, capture_output=True, text=True)
    if "error: " not in ran.stdout and ran.returncode != 0:
        pytest.skip("pyright could not be started")
    assert ran.returncode == 0, ran.stdout
