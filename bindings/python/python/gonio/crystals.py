"""Bodies of facets: ice crystals, prisms, gems, and any closed convex mesh.

Beams through their facets are added with phase, polarisation and diffraction. ``radius_um`` and the like are those of
the sphere of equal volume; :func:`gonio.plan` says how large that makes the crystal.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

from gonio.particles import Particle

__all__ = [
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
]

Orientation = Literal["upright", "random", "horizontal"] | Mapping[str, Any]


@dataclass(frozen=True, kw_only=True)
class Crystal(Particle):
    """What all bodies of facets have.

    Parameters
    ----------
    orientation : str or dict, optional
        ``"upright"`` (axis vertical, turned about it at random), ``"horizontal"``, ``"random"``, or a table:
        ``{"kind": "fixed", "zenith_deg": 90, "azimuth_deg": 0, "spin_deg": 30}``, ``{"kind": "random", "count": 1024}``.
    canting : dict, optional
        Tilts of the axis beside ``upright`` and ``horizontal``: ``{"deviation_deg": 1}``.
    """

    orientation: Orientation | None = None
    canting: Mapping[str, Any] | None = None


@dataclass(frozen=True, kw_only=True)
class HexagonalColumn(Crystal):
    """A hexagonal column, or a plate.

    Parameters
    ----------
    axis_ratio : float
        Length over width from corner to corner, 0.02 to 50; below 1 a plate.

    Examples
    --------
    >>> HexagonalColumn(radius_um=20, axis_ratio=0.2, medium="ice", orientation="upright").keys()["orientation"]
    'upright'
    """

    axis_ratio: float | None = None
    shape: ClassVar[str] = "hexagonal-column"


@dataclass(frozen=True, kw_only=True)
class TriangularPrism(Crystal):
    """A prism over a triangle.

    Parameters
    ----------
    axis_ratio : float
        Length of the edge over the side opposite to the wedge, 0.02 to 50.
    apex_deg : float
        Angle of the wedge, 2 to 178.

    Examples
    --------
    >>> TriangularPrism(radius_um=50, axis_ratio=1, apex_deg=60, medium="N-BK7").apex_deg
    60
    """

    axis_ratio: float | None = None
    apex_deg: float | None = None
    shape: ClassVar[str] = "triangular-prism"


@dataclass(frozen=True, kw_only=True)
class Cuboid(Crystal):
    """A cuboid on a square base.

    Parameters
    ----------
    axis_ratio : float
        Height over the side of the base, 0.02 to 50.

    Examples
    --------
    >>> Cuboid(radius_um=50, axis_ratio=1, medium=1.31).keys()["shape"]
    'cuboid'
    """

    axis_ratio: float | None = None
    shape: ClassVar[str] = "cuboid"


@dataclass(frozen=True, kw_only=True)
class Octahedron(Crystal):
    """A regular octahedron.

    Parameters
    ----------

    Examples
    --------
    >>> Octahedron(radius_um=50, medium="diamond").shape
    'octahedron'
    """

    shape: ClassVar[str] = "octahedron"


@dataclass(frozen=True, kw_only=True)
class PyramidalCrystal(Crystal):
    """A hexagonal column with a pyramid on each end.

    Parameters
    ----------
    axis_ratio : float
        Of the column between the pyramids, 0.02 to 50.
    apex_deg : float
        Between opposite facets of a pyramid, 2 to 178 (56 for ice).

    Examples
    --------
    >>> PyramidalCrystal(radius_um=20, axis_ratio=1, apex_deg=56, medium="ice").apex_deg
    56
    """

    axis_ratio: float | None = None
    apex_deg: float | None = None
    shape: ClassVar[str] = "pyramidal-crystal"


@dataclass(frozen=True, kw_only=True)
class Bullet(Crystal):
    """A hexagonal column with a pyramid on its lower end.

    Parameters
    ----------
    axis_ratio : float
        Of the column, 0.02 to 50.
    apex_deg : float
        Between opposite facets of the pyramid, 2 to 178.

    Examples
    --------
    >>> Bullet(radius_um=20, axis_ratio=1, apex_deg=56, medium="ice").shape
    'bullet'
    """

    axis_ratio: float | None = None
    apex_deg: float | None = None
    shape: ClassVar[str] = "bullet"


@dataclass(frozen=True, kw_only=True)
class TaperedColumn(Crystal):
    """A hexagonal column that narrows upwards.

    Parameters
    ----------
    axis_ratio : float
        Length over width half-way up, 0.02 to 50.
    apex_deg : float
        Between opposite sides, 2 to 178.

    Examples
    --------
    >>> TaperedColumn(radius_um=20, axis_ratio=2, apex_deg=10, medium="ice").axis_ratio
    2
    """

    axis_ratio: float | None = None
    apex_deg: float | None = None
    shape: ClassVar[str] = "tapered-column"


@dataclass(frozen=True, kw_only=True)
class Brilliant(Crystal):
    """A round brilliant of 73 facets after Tolkowsky, its table upwards.

    Parameters
    ----------

    Examples
    --------
    >>> Brilliant(radius_mm=0.1, medium="diamond").shape
    'brilliant'
    """

    shape: ClassVar[str] = "brilliant"


@dataclass(frozen=True, kw_only=True)
class Mesh(Crystal):
    """A closed convex mesh of a file.

    Parameters
    ----------
    file : path
        OBJ, STL or PLY; corners anticlockwise seen from outside.
    file_unit : {"nm", "um", "mm", "m"}, optional
        Unit of the coordinates, in place of a size.

    Examples
    --------
    >>> Mesh(file="gem.obj", radius_um=20)
    Traceback (most recent call last):
        ...
    ValueError: scene: particle.file = gem.obj: No such file or directory (os error 2)
    """

    file: str | os.PathLike[str] | None = None
    file_unit: Literal["nm", "um", "mm", "m"] | None = None
    shape: ClassVar[str] = "mesh"
