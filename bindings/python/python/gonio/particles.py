"""Particles, as scenes know them: the keys of their section ``[particle]`` as arguments.

Radii are those of the sphere of equal volume. ``medium`` is a name of the library (:func:`gonio.media`), a complex
index n + ik, or a table as in a scene file: ``{"index": [1.33, 0.0]}``, ``{"file": "glass.yml"}``.
A size is one of ``radius_um``, ``radius_mm``, ``diameter_mm``, or a ``size_distribution``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, fields
from typing import Any, ClassVar, Literal

__all__ = ["Particle", "Raindrop", "Sphere", "Spheroid"]

Medium = str | complex | Mapping[str, Any]


@dataclass(frozen=True)
class Particle:
    """What all particles have.

    Parameters
    ----------
    radius_um, radius_mm, diameter_mm : float, optional
        Size of the sphere of equal volume: one of them.
    size_distribution : dict, optional
        Many sizes in place of one, such as
        ``{"kind": "gamma", "effective_radius_um": 10, "effective_variance": 0.1}``.
    medium : str, complex or dict, optional
        What the particle is made of; water unless said.
    temperature_c : float, optional
        Temperature of water and sea water.
    density_kg_m3 : float, optional
        Density, where the library does not know it.

    Raises
    ------
    ValueError
        A value that no particle has, with what is accepted.
    """

    _: KW_ONLY
    radius_um: float | None = None
    radius_mm: float | None = None
    diameter_mm: float | None = None
    size_distribution: Mapping[str, Any] | None = None
    medium: Medium | None = None
    temperature_c: float | None = None
    density_kg_m3: float | None = None

    shape: ClassVar[str] = ""

    def __post_init__(self) -> None:
        if not self.shape:
            raise TypeError("Particle is what Sphere, Spheroid and Raindrop have in common: make one of these")
        from gonio._scene import scene_of

        # one wavelength inside all data of the library, where the medium allows: said with the light otherwise
        scene_of(self, {"table": {"theta_deg": [0, 180], "azimuth_deg": [0]}})

    def keys(self) -> dict[str, Any]:
        """The keys of the section ``[particle]``."""
        given = {field.name: getattr(self, field.name) for field in fields(self)}
        keys: dict[str, Any] = {"shape": self.shape, **{k: v for k, v in given.items() if v is not None}}
        medium = keys.get("medium")
        if isinstance(medium, (int, float, complex)):
            keys["medium"] = {"index": [complex(medium).real, complex(medium).imag]}
        return keys


@dataclass(frozen=True)
class Sphere(Particle):
    """A homogeneous sphere.

    Parameters are those of :class:`Particle`.

    Examples
    --------
    >>> Sphere(radius_um=10, medium=1.5 + 0.01j).keys()
    {'shape': 'sphere', 'radius_um': 10, 'medium': {'index': [1.5, 0.01]}}
    >>> Sphere(radius_um=-1)
    Traceback (most recent call last):
        ...
    ValueError: scene: particle.radius_um = -1: a radius must be 0.000001 to 10 mm
    """

    shape: ClassVar[str] = "sphere"


@dataclass(frozen=True)
class Spheroid(Particle):
    """A spheroid, its axis vertical unless said.

    Parameters
    ----------
    axis_ratio : float or str
        Vertical over horizontal diameter, 0.1 to 10; or a law of raindrops by name, such as ``"thurai-2007"``.
    canting : dict, optional
        Tilts of the axis: ``{"deviation_deg": 7}``.
    orientation : {"upright", "random"}, optional
        How the axis stands; ``random`` is the mean over all orientations.

    Examples
    --------
    >>> Spheroid(radius_um=3, axis_ratio=0.7).keys()
    {'shape': 'spheroid', 'radius_um': 3, 'axis_ratio': 0.7}
    """

    axis_ratio: float | str | None = None
    canting: Mapping[str, Any] | None = None
    orientation: Literal["upright", "random"] | None = None
    shape: ClassVar[str] = "spheroid"


@dataclass(frozen=True)
class Raindrop(Particle):
    """A falling raindrop.

    Parameters
    ----------
    model : {"beard-chuang-1987", "chuang-beard-1990"}, optional
        Who gives its shape.
    canting : dict, optional
        Tilts of the axis: ``{"deviation_deg": 7}``.

    Examples
    --------
    >>> Raindrop(radius_mm=0.5).keys()
    {'shape': 'raindrop', 'radius_mm': 0.5}
    """

    model: str | None = None
    canting: Mapping[str, Any] | None = None
    shape: ClassVar[str] = "raindrop"
