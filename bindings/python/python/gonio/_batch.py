"""Sweeps: many tables as one Dataset, resumable in a folder."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from gonio import _gonio
from gonio._datasets import dataset_of, xarray
from gonio._progress import bar
from gonio._scene import scene_of

if TYPE_CHECKING:
    from pathlib import Path

    import xarray as xr

    from gonio._scene import SceneLike

__all__ = ["batch"]

#: Names, units and factors of swept keys, as in the merged file of ``gonio batch``.
COORDINATES: dict[str, tuple[str, str, float]] = {
    "particle.radius_mm": ("radius_um", "um", 1e3),
    "particle.radius_um": ("radius_um", "um", 1.0),
    "particle.diameter_mm": ("radius_um", "um", 500.0),
    "particle.temperature_c": ("temperature", "degC", 1.0),
    "particle.model": ("shape_model", "", 1.0),
    "particle.density_kg_m3": ("density_kg_m3", "kg m-3", 1.0),
    "light.sun_elevation_deg": ("sun_elevation", "degree", 1.0),
}

Axis = tuple[tuple[str, ...], list[tuple[Any, ...]]]


def batch(
    scene: SceneLike,
    sweep: Mapping[str | tuple[str, ...], Sequence[Any]],
    *,
    folder: str | os.PathLike[str] | None = None,
    threads: int | None = None,
    progress: bool | None = None,
    **keys: Any,
) -> xr.Dataset:
    """Tables of a scene for every combination of some values.

    Parameters
    ----------
    scene : dict of sections, or particle
        What stays, as for :func:`gonio.table`.
    sweep : dict
        Dotted keys and their values: ``{"particle.radius_mm": [0.1, 0.5], "light.sun_elevation_deg": [0, 20]}``. A
        tuple of keys has tuples of values that go together.
    folder : path, optional
        Where finished tables are kept, named by what they are of: a second call takes them from there, so that an
        interrupted sweep goes on where it was.
    threads : int, optional
        Threads to compute with.
    progress : bool, optional
        As for :func:`gonio.table`, counting tables.
    **keys
        Sections laid over the scene.

    Returns
    -------
    xarray.Dataset
        As from :func:`gonio.table`, with one more leading dimension per entry of ``sweep``, named as in the merged
        file of ``gonio batch`` (``radius_um``, ``sun_elevation``).

    Raises
    ------
    ValueError
        A key or value that is wrong, before anything is computed.

    Examples
    --------
    >>> import gonio
    >>> ds = gonio.batch(
    ...     gonio.Sphere(radius_um=1),
    ...     {"particle.radius_um": [1, 2, 3]},
    ...     light={"wavelengths_nm": [550]},
    ...     table={"theta_deg": [0, 90, 180]},
    ... )
    >>> ds.phase_function.dims
    ('radius_um', 'wavelength_nm', 'theta', 'phi')
    """
    import itertools
    from pathlib import Path

    from gonio.particles import Particle

    module = xarray()
    if isinstance(scene, Particle):
        scene = {"particle": scene.keys()}
    if not isinstance(scene, Mapping):
        raise TypeError(f"scene = {scene!r}: a dictionary of sections or a particle is accepted")
    axes = [axis_of(key, values) for key, values in sweep.items()]
    shape = tuple(len(values) for _, values in axes)
    places = list(itertools.product(*(range(n) for n in shape)))
    base = {name: dict(section) if isinstance(section, Mapping) else section for name, section in scene.items()}
    for section, laid in keys.items():
        base[section] = {**base.get(section, {}), **laid}
    # all of them are checked before the first is computed
    points = {place: scene_of(keys_at(base, axes, place)) for place in places}
    kept = Path(folder) if folder is not None else None
    if kept is not None:
        kept.mkdir(parents=True, exist_ok=True)
    tables = {}
    with bar(len(places), "tables", progress) as advance:
        for number, (place, point) in enumerate(points.items()):
            tables[place] = dataset_of(module, whole_of(point, kept, threads))
            if advance is not None:
                advance(number + 1)
    return joined(module, tables, axes)


def axis_of(key: str | tuple[str, ...], values: Sequence[Any]) -> Axis:
    """Keys that vary together, and their values."""
    names = (key,) if isinstance(key, str) else tuple(key)
    rows = [(value,) if isinstance(key, str) else tuple(value) for value in values]
    for name in names:
        if "." not in name:
            raise ValueError(f"sweep: {name!r}: keys with their section are accepted, such as particle.radius_um")
    if not rows or any(len(row) != len(names) for row in rows):
        raise ValueError(f"sweep: {key!r} = {values!r}: at least one value, for each of the keys, is accepted")
    if len({json.dumps(row, default=repr) for row in rows}) < len(rows):
        raise ValueError(f"sweep: {key!r} = {values!r}: each value once is accepted")
    return names, rows


def keys_at(base: Mapping[str, Any], axes: Sequence[Axis], place: tuple[int, ...]) -> dict[str, Any]:
    """The keys of one table."""
    scene = {name: dict(section) if isinstance(section, Mapping) else section for name, section in base.items()}
    for (names, rows), at in zip(axes, place, strict=True):
        for name, value in zip(names, rows[at], strict=True):
            section, *inner = name.split(".")
            target = scene.setdefault(section, {})
            if section == "particle" and inner[0] in ("radius_um", "radius_mm", "diameter_mm"):
                for other in ("radius_um", "radius_mm", "diameter_mm"):
                    target.pop(other, None)
            for step in inner[:-1]:
                target[step] = dict(target.get(step, {}))
                target = target[step]
            target[inner[-1]] = value
    return scene


def whole_of(scene: _gonio.Scene, folder: Path | None, threads: int | None) -> dict[str, Any]:
    """The described table of a scene, from the folder where it is there."""

    import hashlib

    def compute() -> dict[str, Any]:
        return scene.table(command_line="gonio.batch (Python)", threads=threads)

    if folder is None:
        return compute()
    digest = hashlib.sha256(f"gonio {_gonio.__version__}\n{scene.toml}".encode())
    for file in scene.files:
        # a scene means what its files hold
        content = file.read_bytes()
        digest.update(f"\n{file} {len(content)}\n".encode() + content)
    path = folder / f"{digest.hexdigest()[:20]}.npz"
    found = load(path)
    if found is None:
        found = compute()
        save(path, found)
    return found


def save(path: Path, whole: Mapping[str, Any]) -> None:
    """Keep a described table; the file appears only when it is complete."""
    import numpy as np

    arrays: dict[str, Any] = {f"v{i}": np.asarray(values) for i, (_, _, values, _) in enumerate(whole["variables"])}
    head = [(name, dimensions, attributes) for name, dimensions, _, attributes in whole["variables"]]
    text = json.dumps({"attributes": whole["attributes"], "variables": head})
    pending = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        with open(pending, "wb") as file:
            np.savez(file, head=np.array(text), **arrays)
        os.replace(pending, path)
    finally:
        pending.unlink(missing_ok=True)


def load(path: Path) -> dict[str, Any] | None:
    """A kept table; nothing where there is none or it is damaged."""
    import zipfile

    import numpy as np

    try:
        with np.load(path) as kept:
            head = json.loads(str(kept["head"]))
            rows = [(name, dimensions, kept[f"v{i}"], given) for i, (name, dimensions, given) in enumerate(head["variables"])]
    except (OSError, ValueError, KeyError, zipfile.BadZipFile):
        return None
    return {"attributes": head["attributes"], "variables": rows}


def joined(xarray: Any, tables: dict[tuple[int, ...], Any], axes: Sequence[Axis]) -> xr.Dataset:
    """One Dataset of many, a leading dimension per axis."""
    import numpy as np

    azimuths = max((table.phi for table in tables.values()), key=len)
    attributes = [table.attrs.pop("methods", "") for table in tables.values()]
    swept: list[list[tuple[str, Any, dict[str, str]]]] = []
    for names, rows in axes:
        coordinates = []
        # a paired axis is named by the radius where that is in it
        for k in sorted(range(len(names)), key=lambda k: not names[k].startswith("particle.radius")):
            name, units, factor = COORDINATES.get(names[k], (names[k].rsplit(".", 1)[-1], "1", 1.0))
            values = [row[k] for row in rows]
            if all(isinstance(value, (int, float, np.number)) for value in values):
                array = np.array([float(f"{float(value) * factor:.13g}") for value in values])
            else:
                array, units = np.array([value if isinstance(value, str) else json.dumps(value) for value in values]), ""
            coordinates.append((name, array, {"units": units} if units else {}))
        swept.append(coordinates)
    taken = {name for coordinates in swept for name, _, _ in coordinates}
    if "sun_elevation" in taken:
        taken.add("solar_zenith_angle")

    def build(place: tuple[int, ...]) -> Any:
        depth = len(place)
        if depth == len(axes):
            table = tables[place].drop_vars(taken & set(tables[place].variables))
            if table.sizes["phi"] != azimuths.size:
                table = spread(table, azimuths)
            return table
        parts = [build((*place, i)) for i in range(len(axes[depth][1]))]
        whole = xarray.concat(
            parts,
            dim=swept[depth][0][0],
            data_vars=[name for name in parts[0].data_vars if name != "solid_angle"],
            coords="minimal",
            compat="override",
            join="outer",
            combine_attrs="drop_conflicts",
        )
        along = swept[depth][0][0]
        return whole.assign_coords({name: (along, array, given) for name, array, given in swept[depth]})

    whole: xr.Dataset = build(())
    leading = [coordinates[0][0] for coordinates in swept]
    if any(attributes):
        shape = [len(rows) for _, rows in axes]
        words = {"long_name": "JSON: what computed each order, why, its expected error"}
        whole["methods"] = (leading, np.array(attributes).reshape(shape), words)
    whole.attrs["format"] = "gonio phase table sweep"
    whole.attrs["sweep_axes"] = " ".join(leading)
    return whole


def spread(table: xr.Dataset, azimuths: Any) -> Any:
    """A table without azimuth dependence, written out for every azimuth."""
    first = table.isel(phi=0, drop=True)
    for name, variable in table.data_vars.items():
        if "phi" in variable.dims and name != "solid_angle":
            first[name] = first[name].expand_dims(phi=azimuths, axis=-1)
    return first.drop_vars("solid_angle").assign_coords(phi=azimuths)
