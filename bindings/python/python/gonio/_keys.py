"""Keys of scenes on their way into the engine: as JSON, checked, with what it has to say of them."""

from __future__ import annotations

import json
import os
import sys
import warnings
from collections.abc import Mapping
from typing import Any

from gonio import _gonio

#: Notes that have been told already.
_told: set[str] = set()


def checked(sections: Mapping[str, Any]) -> _gonio.Scene:
    """The scene of these sections."""
    scene = _gonio.Scene(json=json_of(sections))
    tell(scene.notes)
    return scene


def tell(notes: list[str]) -> None:
    """Warn of each note once in a session, at the line of the user who called."""
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_globals["__name__"].partition(".")[0] == "gonio":
        level, frame = level + 1, frame.f_back
    for note in notes:
        if note not in _told:
            _told.add(note)
            warnings.warn(note, stacklevel=level)


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
