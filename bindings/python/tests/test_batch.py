"""Sweeps: dimensions, files that stay, what goes wrong."""

import numpy as np
import pytest

xr = pytest.importorskip("xarray")

import gonio  # noqa: E402

FIXED = {"light": {"wavelengths_nm": [550]}, "table": {"theta_deg": {"from": 0, "to": 180, "count": 37}}}


def test_dimensions_and_values():
    sweep = {"particle.radius_um": [1, 2], "particle.medium": ["water", {"index": [1.5, 0.0]}]}
    whole = gonio.batch(gonio.Sphere(radius_um=1), sweep, **FIXED)
    assert whole.phase_function.dims == ("radius_um", "medium", "wavelength_nm", "theta", "phi")
    assert whole.attrs["sweep_axes"] == "radius_um medium"
    alone = gonio.table(gonio.Sphere(radius_um=2, medium=1.5), **FIXED)
    one = whole.isel(radius_um=1, medium=1)
    for name in ("phase_function", "extinction_cross_section", "mean_volume"):
        assert np.array_equal(one[name], alone[name]), name


def test_merged_as_by_the_program(program, tmp_path):
    pytest.importorskip("h5netcdf")
    text = """
[particle]
shape = "sphere"
radius_um = [1, 2, 3]
[light]
wavelengths_nm = [550]
[table]
theta_deg = { from = 0, to = 180, count = 37 }
"""
    (tmp_path / "sweep.toml").write_text(text, encoding="utf-8")
    program("batch", "plan", tmp_path / "sweep.toml", "-o", tmp_path / "plan.jsonl")
    program("batch", "run", "--plan", tmp_path / "plan.jsonl", "--dir", tmp_path / "shards")
    merged = ("--dir", tmp_path / "shards", "-o", tmp_path / "all.h5")
    program("batch", "merge", "--plan", tmp_path / "plan.jsonl", *merged)
    with xr.open_dataset(tmp_path / "all.h5", engine="h5netcdf") as opened:
        file = opened.load()
    made = gonio.batch(gonio.Sphere(radius_um=1), {"particle.radius_um": [1, 2, 3]}, **FIXED)
    for name in set(made.variables) - {"methods"}:
        assert made[name].dims == file[name].dims, name
        # numbers that the program has read from files went through another unit once more
        equal = np.allclose if made[name].dtype == float else np.array_equal
        exact = {"rtol": 1e-15, "atol": 0} if made[name].dtype == float else {}
        assert equal(made[name], file[name], equal_nan=made[name].dtype.kind == "f", **exact), name
    assert set(file.variables) - set(made.variables) == {"present"}


def test_a_second_call_goes_on(tmp_path, monkeypatch):
    sweep = {("particle.radius_um", "light.sun_elevation_deg"): [(1, 0), (2, 20)]}
    first = gonio.batch(gonio.Sphere(radius_um=1), sweep, folder=tmp_path, **FIXED)
    files = sorted(tmp_path.iterdir())
    assert len(files) == 2 and all(file.suffix == ".npz" for file in files)
    times = [file.stat().st_mtime_ns for file in files]
    files[0].write_bytes(b"half a file")
    again = gonio.batch(gonio.Sphere(radius_um=1), sweep, folder=tmp_path, **FIXED)
    assert np.array_equal(first.phase_function, again.phase_function)
    assert first.sun_elevation.dims == ("radius_um",)
    now = [file.stat().st_mtime_ns for file in sorted(tmp_path.iterdir())]
    assert now[1] == times[1] and now[0] != times[0]


@pytest.mark.parametrize(
    ("sweep", "words"),
    [
        ({"radius_um": [1]}, "section"),
        ({"particle.radius_um": []}, "at least one value"),
        ({"particle.radius_um": [1, 1]}, "each value once"),
        ({"particle.radius_um": [1, -1]}, "particle.radius_um = -1"),
        ({("particle.radius_um", "light.sun_elevation_deg"): [(1,)]}, "for each of the keys"),
        ({"particle.colour": [1]}, "unknown key"),
    ],
)
def test_wrong_sweeps(sweep, words, tmp_path):
    with pytest.raises(ValueError, match=words):
        gonio.batch(gonio.Sphere(radius_um=1), sweep, folder=tmp_path, **FIXED)
    assert not list(tmp_path.iterdir())


def test_data_that_changed_are_seen(tmp_path):
    data, kept = tmp_path / "glass.csv", tmp_path / "kept"
    found = []
    for n in (1.5, 1.8, 1.5):
        data.write_text(f"wavelength_um,n\n0.4,{n}\n0.7,{n}\n", encoding="utf-8")
        glass = gonio.Sphere(radius_um=1, medium={"file": str(data)})
        made = gonio.batch(glass, {"light.sun_elevation_deg": [0]}, folder=kept, **FIXED)
        found.append(float(made.extinction_cross_section.item()))
    assert found[0] == found[2] != found[1]
    assert len(list(kept.iterdir())) == 2
