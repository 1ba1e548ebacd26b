"""Datasets are the program's files: every value, every attribute."""

import numpy as np
import pytest

xr = pytest.importorskip("xarray")
pytest.importorskip("h5netcdf")

import gonio  # noqa: E402

TABLES = {
    "sphere": """
[particle]
shape = "sphere"
radius_um = 5
[light]
wavelengths_nm = [500, 600]
[table]
theta_deg = { from = 0, to = 180, count = 91 }
quantity = "mueller"
""",
    "raindrop": """
[particle]
shape = "raindrop"
radius_mm = 0.3
[light]
wavelengths_nm = [650]
[table]
theta_deg = { from = 0, to = 180, count = 181 }
azimuth_deg = { from = 0, to = 360, count = 13 }
""",
    "plate": """
[particle]
shape = "hexagonal-column"
radius_um = 20
axis_ratio = 0.5
medium = "ice"
orientation = { kind = "random", count = 16 }
[light]
wavelengths_nm = [550]
[table]
theta_deg = { from = 0, to = 180, count = 37 }
azimuth_deg = [0]
[model]
allow_unmet_tolerance = true
""",
    "superellipsoid": """
[particle]
shape = "superellipsoid"
radius_um = 50
axis_ratio = 0.95
exponent = 2.1
[light]
wavelengths_nm = [650]
[table]
theta_deg = { from = 0, to = 180, count = 91 }
azimuth_deg = { from = 0, to = 360, count = 13 }
[model]
tolerance = 0.05
allow_unmet_tolerance = true
""",
    "kinds": """
[[particles]]
number_fraction = 0.3
shape = "sphere"
radius_um = 1
[[particles]]
number_fraction = 0.7
shape = "sphere"
radius_um = 0.2
medium = { index = [1.75, 0.44] }
[light]
wavelengths_nm = [500]
[table]
theta_deg = { from = 0, to = 180, count = 61 }
""",
    "rounded": """
[particle]
shape = "sphere"
size_distribution = { kind = "gamma", effective_radius_um = 5, effective_variance = 0.1 }
[light]
wavelengths_nm = [500]
[table]
theta_deg = { from = 0, to = 180, count = 61 }
bit_round = 10
[amount]
number_per_cm3 = 100
""",
}
#: What must differ: who asked.
OWN = {"command_line"}


@pytest.mark.parametrize("name", TABLES)
def test_a_dataset_is_the_file(name, program, tmp_path, monkeypatch):
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    scene, path = tmp_path / "scene.toml", tmp_path / "table.h5"
    scene.write_text(TABLES[name], encoding="utf-8")
    program("table", scene, "-o", path, "--no-preview")
    made = gonio.table(scene)
    with xr.open_dataset(path, engine="h5netcdf") as opened:
        file = opened.load()
    same(made, file)
    # from text and keys as from the file
    import tomllib

    same(gonio.table(TABLES[name]), made)
    same(gonio.table(tomllib.loads(TABLES[name])), made)


def same(a, b):
    assert set(a.variables) == set(b.variables)
    assert set(a.coords) == set(b.coords)
    for name in b.variables:
        one, other = a.variables[name], b.variables[name]
        assert one.dims == other.dims, name
        assert one.dtype == other.dtype, name
        assert np.array_equal(one.values, other.values, equal_nan=one.dtype.kind == "f"), name
        assert one.attrs == other.attrs, name
    assert set(a.attrs) == set(b.attrs)
    for name in set(b.attrs) - OWN:
        assert a.attrs[name] == b.attrs[name], name
        assert type(a.attrs[name]) is type(b.attrs[name]), name


def test_a_dataset_can_be_written_and_read(tmp_path):
    made = gonio.table(TABLES["sphere"])
    made.to_netcdf(tmp_path / "again.nc", engine="h5netcdf")
    with xr.open_dataset(tmp_path / "again.nc", engine="h5netcdf") as again:
        same(again.load(), made)


def test_scatter_is_the_table():
    drop = gonio.Sphere(radius_um=20, medium=1.33)
    theta = np.linspace(0, 180, 19)
    seen = gonio.scatter(drop, wavelength_nm=[500, 600], theta_deg=theta)
    table = gonio.table(
        drop,
        light={"wavelengths_nm": [500, 600]},
        table={"theta_deg": theta.tolist(), "forward_peak": "point"},
    )
    k = 2 * np.pi / (table.wavelength_nm * 1e-9)
    power = 0.5 * (abs(seen.s1) ** 2 + abs(seen.s2) ** 2).isel(phi=0, drop=True) / k**2
    phase = power / table.scattering_cross_section
    assert np.allclose(phase, table.phase_function.isel(phi=0), rtol=1e-6)
    area = np.pi * 20e-6**2
    assert np.allclose(seen.q_ext.isel(phi=0) * area, table.extinction_cross_section, rtol=1e-12)
    assert seen.attrs["engine"] == "LorenzMie"


def test_scatter_of_a_drop_by_two_methods():
    drop = gonio.Spheroid(radius_um=1, axis_ratio=0.9, medium=1.33)
    at = {"wavelength_nm": 600, "theta_deg": [20, 60, 120], "azimuth_deg": [0, 70]}
    seen = gonio.scatter(drop, **at, method="tmatrix", tolerance=1e-4, sun_elevation_deg=10)
    assert seen.s1.shape == (1, 2, 3)
    # a mirror image on the other side
    other = gonio.scatter(
        drop, **{**at, "azimuth_deg": [0, -70]}, method="tmatrix", tolerance=1e-4, sun_elevation_deg=10
    )
    assert np.allclose(seen.s1, other.s1, rtol=1e-6)
    assert np.allclose(seen.s3, -other.s3, atol=1e-6)


def test_lee_is_the_file(program, tmp_path):
    path = tmp_path / "lee.h5"
    angles = np.arange(136.0, 144.1, 1.0)
    program("lee", "--data", path, "--radius-mm", "0.02:0.05:3", "--theta", "136:144:1", "--fineness", "0.3")
    with xr.open_dataset(path, engine="h5netcdf") as opened:
        file = opened.load()
    made = gonio.lee(radius_mm=file.radius_mm.values, theta_deg=angles, fineness=0.3)
    assert np.allclose(made.theta, file.theta)
    for name in ("xyz_parallel", "xyz_perpendicular"):
        assert np.allclose(made[name], file[name], rtol=1e-5)
        assert made[name].attrs == file[name].attrs
    assert made.srgb.dtype == np.uint8 and made.srgb.values.max() > 150


def test_materials():
    glass = gonio.material("N-BK7")
    # Schott's data sheet
    assert glass.index(587.5618).real == pytest.approx(1.5168, abs=1e-5)
    assert glass.abbe[1] == pytest.approx(64.17, abs=0.01)
    assert glass.index([[500.0], [600.0]]).shape == (2, 1)
    assert gonio.material(1.5 + 0.1j).index(500.0) == 1.5 + 0.1j


def test_plan():
    planned = gonio.plan(gonio.Raindrop(radius_mm=0.5))
    assert planned["engine"] == "Meridians" and planned["azimuths_stored"] == 361
    assert planned["ranges"][0]["parts"][0]["method"]


def test_particles_are_their_scenes(tmp_path):
    at = {"light": {"wavelengths_nm": [500]}, "table": {"theta_deg": [0, 90, 180]}}
    kinds = gonio.mixture(
        [(0.3, gonio.Sphere(radius_um=1)), (0.7, gonio.Sphere(radius_um=0.2, medium=1.75 + 0.44j))]
    )
    mean = gonio.table(kinds, **at).extinction_cross_section
    one, other = (gonio.table(p, **at).extinction_cross_section for p in (
        gonio.Sphere(radius_um=1), gonio.Sphere(radius_um=0.2, medium=1.75 + 0.44j)
    ))
    assert np.allclose(mean, 0.3 * one + 0.7 * other, rtol=1e-9)
    # a cube by its corners is the cube by its name
    corners = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    faces = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6)]
    path = tmp_path / "cube.obj"
    path.write_text(
        "".join("v {} {} {}\n".format(*c) for c in corners) + "".join("f {} {} {} {}\n".format(*f) for f in faces)
    )
    fixed = {"kind": "fixed", "zenith_deg": 20, "azimuth_deg": 10, "spin_deg": 0}
    # the named one has a corner towards azimuth 0 at spin 0, the mesh a face
    turned = {**fixed, "spin_deg": 45}
    at = {"light": {"wavelengths_nm": [500]}, "table": {"theta_deg": {"from": 0, "to": 180, "count": 19},
                                                        "azimuth_deg": [0]},
          "model": {"allow_unmet_tolerance": True}}
    mesh = gonio.table(gonio.Mesh(file=path, radius_um=10, medium="ice", orientation=fixed), **at)
    cube = gonio.table(gonio.Cuboid(axis_ratio=1, radius_um=10, medium="ice", orientation=turned), **at)
    assert np.allclose(mesh.extinction_cross_section, cube.extinction_cross_section, rtol=1e-6)
