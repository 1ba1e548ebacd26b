"""From what a user gives for a scene (a path, TOML text, a dictionary, a particle) to a checked scene."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gonio import _gonio

if TYPE_CHECKING:
    from gonio.particles import Particle

    SceneLike = str | os.PathLike[str] | Mapping[str, Any] | Particle

#: Notes that have been told already.
_told: set[str] = set()


def scene_of(scene: SceneLike, keys: Mapping[str, Mapping[str, Any]] | None = None) -> _gonio.Scene:
    """The checked scene; ``keys`` are laid over those of a dictionary or a particle."""
    from gonio.particles import Particle

    if isinstance(scene, Particle):
        scene = {"particle": scene.keys()}
    if isinstance(scene, Mapping):
        merged = {name: dict(section) if isinstance(section, Mapping) else section for name, section in scene.items()}
        for section, values in (keys or {}).items():
            merged[section] = {**merged.get(section, {}), **values}
        made = _gonio.Scene(json=json_of(merged))
    elif isinstance(scene, os.PathLike):
        made = _gonio.Scene(path=os.fspath(scene))
    elif isinstance(scene, str):
        # a text has a key or a section, which no path has
        made = _gonio.Scene(toml=scene) if "=" in scene or "\n" in scene else _gonio.Scene(path=scene)
    else:
        raise TypeError(
            f"scene = {scene!r}: a path, TOML text, a dictionary of sections or a particle is accepted"
        )
    tell(made.notes)
    return made


def tell(notes: list[str]) -> None:
    """Warn of each note once in a session."""
    for note in notes:
        if note not in _told:
            _told.add(note)
            warnings.warn(note, stacklevel=4)


def plain(value: Any) -> Any:
    """Numbers and arrays of numpy, tuples and paths as JSON has them; keys without a value are left out."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items() if item is not None}
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, complex):
        return [value.real, value.imag]
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    return value


def json_of(keys: Mapping[str, Any]) -> str:
    """Keys as JSON; numbers that JSON does not have are refused by name."""
    try:
        return json.dumps(plain(keys), allow_nan=False)
    except ValueError:
        raise ValueError(f"scene = {keys!r}: finite numbers are accepted") from None
    except TypeError as error:
        raise TypeError(f"scene = {keys!r}: numbers, texts, lists and dictionaries are accepted ({error})") from None
