"""The virtual gonioreflectometer: how one particle scatters light.

Everywhere: time factor exp(-iωt), refractive index n + ik with k ≥ 0 where light is absorbed, scattering angle 0
straight ahead; wavelengths in vacuum, units in the names of arguments (``radius_um``, ``wavelength_nm``,
``theta_deg``). Angles are keyword-only.

Arrays for loops and fits come from :mod:`gonio.mie`, :mod:`gonio.debye` and :mod:`gonio.tmatrix`; xarray Datasets
with units and provenance from :func:`gonio.table`, :func:`gonio.scatter`, :func:`gonio.radar`, :func:`gonio.lee` and
:func:`gonio.batch`.

Long calls run without the interpreter's lock on as many threads as their argument ``threads`` says, else the
environment variable ``GONIO_THREADS``, else ``RAYON_NUM_THREADS``, else all cores. Ctrl-C stops them.

Examples
--------
>>> import gonio
>>> s1, s2 = gonio.mie.amplitudes(10.0, 1.33, theta_deg=30.0)
>>> gonio.mie.efficiencies(10.0, 1.33 + 0.01j).q_ext > 2
True
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gonio import debye, mie, tmatrix
from gonio._gonio import __version__

if TYPE_CHECKING:
    from gonio._batch import batch
    from gonio._datasets import plan, scatter, table
    from gonio._lee import lee
    from gonio._material import Material, material, media
    from gonio._radar import radar
    from gonio.crystals import (
        Brilliant,
        Bullet,
        Crystal,
        Cuboid,
        HexagonalColumn,
        Mesh,
        Octahedron,
        PyramidalCrystal,
        TaperedColumn,
        TriangularPrism,
    )
    from gonio.particles import Harmonics, Particle, Raindrop, Sphere, Spheroid, Superellipsoid, mixture

__all__ = [
    "Brilliant",
    "Bullet",
    "Crystal",
    "Cuboid",
    "Harmonics",
    "HexagonalColumn",
    "Material",
    "Mesh",
    "Octahedron",
    "Particle",
    "PyramidalCrystal",
    "Raindrop",
    "Sphere",
    "Spheroid",
    "Superellipsoid",
    "TaperedColumn",
    "TriangularPrism",
    "__version__",
    "batch",
    "debye",
    "lee",
    "material",
    "media",
    "mie",
    "mixture",
    "plan",
    "radar",
    "scatter",
    "table",
    "tmatrix",
]

#: Where the rest is, imported when it is first asked for: arrays come without waiting for it.
_HOMES = {
    "batch": "_batch",
    "lee": "_lee",
    "radar": "_radar",
    **dict.fromkeys(("plan", "scatter", "table"), "_datasets"),
    **dict.fromkeys(("Material", "material", "media"), "_material"),
    **dict.fromkeys(
        ("Harmonics", "Particle", "Raindrop", "Sphere", "Spheroid", "Superellipsoid", "mixture"), "particles"
    ),
    **dict.fromkeys(
        (
            "Brilliant",
            "Bullet",
            "Crystal",
            "Cuboid",
            "HexagonalColumn",
            "Mesh",
            "Octahedron",
            "PyramidalCrystal",
            "TaperedColumn",
            "TriangularPrism",
        ),
        "crystals",
    ),
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'gonio' has no attribute {name!r}")
    from importlib import import_module

    value = getattr(import_module(f"gonio.{_HOMES[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
