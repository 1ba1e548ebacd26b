"""Particles, as scenes know them: the keys of their section ``[particle]`` as arguments.

Crystals and other bodies of facets are in :mod:`gonio.crystals`.

Radii are those of the sphere of equal volume. ``medium`` is a name of the library (:func:`gonio.media`), a complex
index n + ik, or a table as in a scene file: ``{"index": [1.33, 0.0]}``, ``{"file": "glass.yml"}``.
A size is one of ``radius_um``, ``radius_mm``, ``diameter_mm``, or a ``size_distribution``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, fields
from inspect import cleandoc
from typing import Any, ClassVar, Literal

from gonio._keys import checked

__all__ = ["Harmonics", "Particle", "Raindrop", "Sphere", "Spheroid", "Superellipsoid", "mixture"]

Medium = str | complex | Mapping[str, Any]

#: Where a docstring begins to tell of parameters.
PARAMETERS = "Parameters\n----------\n"


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
    outside : str, complex or dict, optional
        The transparent medium around the particle, as ``medium``; vacuum unless said.

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
    outside: Medium | None = None

    shape: ClassVar[str] = ""

    def __init_subclass__(cls) -> None:
        """Tell of every particle also the parameters that its base has."""
        inherited = cls.__mro__[1].__doc__
        if cls.__doc__ and inherited:
            common = cleandoc(inherited).partition(PARAMETERS)[2].partition("\n\n")[0]
            before, heading, own = cleandoc(cls.__doc__).partition(PARAMETERS)
            cls.__doc__ = f"{before}{heading}{common}\n{own}"

    def __post_init__(self) -> None:
        if not self.shape:
            name = type(self).__name__
            raise TypeError(f"{name} is what Sphere, Spheroid and so on have in common: make one of these")
        look_at({"particle": self.keys()})

    def keys(self) -> dict[str, Any]:
        """The keys of the section ``[particle]``.

        Returns
        -------
        dict
            As in a scene file; what was not given is not in it.
        """
        given = {field.name: getattr(self, field.name) for field in fields(self)}
        keys: dict[str, Any] = {"shape": self.shape, **{k: v for k, v in given.items() if v is not None}}
        for name in ("medium", "outside"):
            if name in keys:
                keys[name] = in_keys(keys[name])
        return keys


def look_at(sections: Mapping[str, Any]) -> None:
    """Refuse particles that no scene has; whether their media have data is said with the light that is asked for."""
    try:
        checked({**sections, "table": {"theta_deg": [0, 180], "azimuth_deg": [0]}})
    except ValueError as error:
        if "is outside the data of" not in str(error):
            raise


def in_keys(medium: Medium) -> str | Mapping[str, Any]:
    """A medium as scenes have it: an index as a table."""
    if isinstance(medium, (int, float, complex)):
        return {"index": [complex(medium).real, complex(medium).imag]}
    return medium


def in_film(film: Mapping[str, Any]) -> Mapping[str, Any]:
    """A film as scenes have it."""
    if not isinstance(film, Mapping) or "medium" not in film:
        return film  # refused with the scene
    return {**film, "medium": in_keys(film["medium"])}


@dataclass(frozen=True, kw_only=True)
class Sphere(Particle):
    """A sphere: homogeneous, in layers, with a radial profile of the index, or coated.

    Parameters
    ----------
    coating : list of dict, optional
        Films from inside out: ``[{"medium": "ethanol", "thickness_nm": 100}]``. Layers and profiles are tables of
        ``medium``: ``{"layers": [{"radius_fraction": 0.8, "medium": "water"}, {"medium": "ice"}]}``.

    Examples
    --------
    >>> Sphere(radius_um=10, medium=1.5 + 0.01j).keys()
    {'shape': 'sphere', 'radius_um': 10, 'medium': {'index': [1.5, 0.01]}}
    >>> Sphere(radius_um=2, coating=[{"medium": 1.75 + 0.44j, "thickness_nm": 20}], outside="water").keys()["coating"]
    [{'medium': {'index': [1.75, 0.44]}, 'thickness_nm': 20}]
    >>> Sphere(radius_um=-1)
    Traceback (most recent call last):
        ...
    ValueError: scene: particle.radius_um = -1: a radius must be 0.000001 to 10 mm
    """

    coating: Sequence[Mapping[str, Any]] | None = None
    shape: ClassVar[str] = "sphere"

    def keys(self) -> dict[str, Any]:
        """The keys of the section ``[particle]``, films among them.

        Returns
        -------
        dict
            As in a scene file.
        """
        keys = super().keys()
        if isinstance(self.coating, Sequence) and not isinstance(self.coating, str):
            keys["coating"] = [in_film(film) for film in self.coating]
        return keys


@dataclass(frozen=True, kw_only=True)
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


@dataclass(frozen=True, kw_only=True)
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


@dataclass(frozen=True, kw_only=True)
class Harmonics(Particle):
    """A body of revolution by the cosine series of its outline, r(θ) = Σ c_n cos nθ, θ from straight down.

    Parameters
    ----------
    coefficients : sequence of float
        c_0, c_1, …, 1 to 32; their unit is no matter.
    orientation : {"upright", "random"}, optional
        How the axis stands; ``random`` is the mean over all orientations.

    Examples
    --------
    >>> Harmonics(radius_um=100, coefficients=[1, 0, -0.05]).keys()
    {'shape': 'harmonics', 'radius_um': 100, 'coefficients': [1, 0, -0.05]}
    """

    coefficients: Sequence[float] | None = None
    orientation: Literal["upright", "random"] | None = None
    shape: ClassVar[str] = "harmonics"


@dataclass(frozen=True, kw_only=True)
class Superellipsoid(Particle):
    """A body of revolution between an ellipsoid and a cylinder, (x² + y²)^(m/2) + (z/c)^m = 1.

    Parameters
    ----------
    axis_ratio : float
        c, vertical over horizontal diameter, 0.2 to 5.
    exponent : float
        m, 2 to 4; 2 is a spheroid.
    orientation : {"upright", "random"}, optional
        How the axis stands; ``random`` is the mean over all orientations.

    Examples
    --------
    >>> Superellipsoid(radius_um=100, axis_ratio=1, exponent=2.5).keys()
    {'shape': 'superellipsoid', 'radius_um': 100, 'axis_ratio': 1, 'exponent': 2.5}
    """

    axis_ratio: float | None = None
    exponent: float | None = None
    orientation: Literal["upright", "random"] | None = None
    shape: ClassVar[str] = "superellipsoid"


def mixture(
    parts: Sequence[tuple[float, Particle]], *, by: Literal["number", "volume", "mass"] = "number"
) -> dict[str, Any]:
    """Several kinds of particles as one scene.

    Parameters
    ----------
    parts : sequence of (float, particle)
        Shares, which add up to 1, and the kinds that have them.
    by : {"number", "volume", "mass"}, optional
        What the shares are fractions of: the particles inside the limits of their distributions, their volume or mass.

    Returns
    -------
    dict
        Sections of a scene, for :func:`gonio.table`, :func:`gonio.plan` and :func:`gonio.batch`.

    Raises
    ------
    ValueError
        Shares that do not add up to 1, or kinds that cannot stand in one volume.

    Examples
    --------
    >>> import gonio
    >>> soot = gonio.Sphere(radius_um=0.05, medium=1.75 + 0.44j)
    >>> haze = gonio.mixture([(0.2, soot), (0.8, gonio.Sphere(radius_um=0.2))])
    >>> [kind["number_fraction"] for kind in haze["particles"]]
    [0.2, 0.8]
    """
    if by not in ("number", "volume", "mass"):
        raise ValueError(f'by = {by!r}: "number", "volume" and "mass" are accepted')
    try:
        kinds = [{**particle.keys(), f"{by}_fraction": share} for share, particle in parts]
    except (AttributeError, TypeError, ValueError):
        raise TypeError(f"parts = {parts!r}: pairs of a share and a particle are accepted") from None
    scene: dict[str, Any] = {"particles": kinds}
    look_at(scene)
    return scene
