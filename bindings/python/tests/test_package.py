"""What is installed with the package, and what it is built from."""

import importlib.metadata
import tomllib

import pytest

import gonio
from conftest import ROOT


def test_numpy_alone_is_required():
    try:
        required = importlib.metadata.requires("gonio") or []
    except importlib.metadata.PackageNotFoundError:
        pytest.skip("the package is not installed")
    assert [line for line in required if "extra ==" not in line] == ["numpy>=1.25"]
    assert importlib.metadata.version("gonio") == gonio.__version__


def test_versions_are_those_of_the_program():
    """The same version, and the same versions of what both are built from, so that both share what is built."""

    def versions(path):
        found = {}
        for package in tomllib.loads((ROOT / path).read_text(encoding="utf-8"))["package"]:
            found.setdefault(package["name"], set()).add(package["version"])
        return found

    program, package = versions("Cargo.lock"), versions("bindings/python/Cargo.lock")
    assert program["gonio"] == package["gonio"] == package["gonio-python"] == {gonio.__version__}
    differ = {name for name in program.keys() & package.keys() if not package[name] <= program[name]}
    assert not differ, "cp Cargo.lock bindings/python/ and run cargo metadata there"
