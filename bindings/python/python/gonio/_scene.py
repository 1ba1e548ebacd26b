"""From what a user gives for a scene (a path, TOML text, a dictionary, a particle) to a checked scene."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from gonio import _gonio
from gonio._keys import checked, tell
from gonio.particles import Particle

SceneLike = str | os.PathLike[str] | Mapping[str, Any] | Particle


def scene_of(scene: SceneLike, keys: Mapping[str, Mapping[str, Any]] | None = None) -> _gonio.Scene:
    """The checked scene; ``keys`` are laid over those of a dictionary or a particle."""
    if isinstance(scene, Particle):
        scene = {"particle": scene.keys()}
    if isinstance(scene, Mapping):
        merged = {name: dict(section) if isinstance(section, Mapping) else section for name, section in scene.items()}
        for section, values in (keys or {}).items():
            merged[section] = {**merged.get(section, {}), **values}
        return checked(merged)
    if isinstance(scene, os.PathLike):
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
