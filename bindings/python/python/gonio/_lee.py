"""Lee diagrams."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from gonio import _gonio
from gonio._datasets import xarray
from gonio._numbers import numbers
from gonio._progress import bar
from gonio._keys import json_of
from gonio.particles import in_keys

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr
    from numpy.typing import ArrayLike

__all__ = ["lee"]


def lee(
    *,
    radius_mm: ArrayLike,
    theta_deg: ArrayLike,
    shape: Literal["sphere", "raindrop"] = "sphere",
    medium: str | complex | Mapping[str, Any] = "water",
    sun_elevation_deg: float = 20.0,
    azimuth_deg: float = 180.0,
    polarisation: Literal["total", "parallel", "perpendicular"] = "total",
    sun_disc: bool = True,
    size_spread: float = 0.0,
    illuminant: str = "D65",
    observer: str = "1931",
    fineness: float = 1.0,
    threads: int | None = None,
    progress: bool | None = None,
) -> xr.Dataset:
    """The colour of the bow over drop radius and scattering angle (Lee 1998, Appl. Opt. 37, 1506).

    Parameters
    ----------
    radius_mm : array_like of float
        Radii, 0.0001 to 10 mm.
    theta_deg : array_like of float
        Scattering angles, ascending.
    shape : {"sphere", "raindrop"}, optional
        Spheres by Lorenz–Mie, raindrops by rays.
    medium : str, complex or dict, optional
        As for :func:`gonio.material`.
    sun_elevation_deg, azimuth_deg : float, optional
        For raindrops: the sun above the horizon; 180 is the top of the bow, 90 its side.
    polarisation : {"total", "parallel", "perpendicular"}, optional
        Light seen through no filter, or one along or across the scattering plane.
    sun_disc : bool, optional
        Average over the sun's disc of 0.53°.
    size_spread : float, optional
        Standard deviation of ln(radius) about each radius.
    illuminant : str, optional
        D65, A, E, D50, 5778K, sun, sun-ground, sun@DEGREES.
    observer : {"1931", "2015"}, optional
        The CIE's standard observer.
    fineness : float, optional
        Factor on the numbers of angles and wavelengths; 1 is meant for ΔE below 1.
    threads, progress : int and bool, optional
        As for :func:`gonio.table`.

    Returns
    -------
    xarray.Dataset
        ``xyz_parallel`` and ``xyz_perpendicular`` (CIE X, Y, Z of the differential over the geometrical
        cross-section, sr⁻¹) as in the program's file, and ``srgb`` (uint8), every radius scaled to the same brightest
        luminance.

    Raises
    ------
    ValueError
        Radii, angles or words that have no meaning.

    Examples
    --------
    >>> import gonio
    >>> diagram = gonio.lee(radius_mm=[0.01], theta_deg=[138, 140, 142], medium=1.333, fineness=0.3)
    >>> diagram.srgb.shape
    (1, 3, 3)
    """
    module = xarray()
    radii = numbers("radius_mm", radius_mm)
    theta = numbers("theta_deg", theta_deg)
    medium = in_keys(medium)
    with bar(len(radii), "radii", progress) as advance:
        parallel, perpendicular, srgb = _gonio.lee(
            radius_mm=radii.tolist(),
            theta_deg=theta.tolist(),
            shape=shape,
            medium_name=medium if isinstance(medium, str) else None,
            medium_json=None if isinstance(medium, str) else json_of(medium),
            sun_elevation_deg=sun_elevation_deg,
            azimuth_deg=azimuth_deg,
            polarisation=polarisation,
            sun_disc=sun_disc,
            size_spread=size_spread,
            illuminant=illuminant,
            observer=observer,
            fineness=fineness,
            threads=threads,
            progress=advance,
        )
    stimuli = ("radius_mm", "theta", "stimulus")
    data = {
        "xyz_parallel": (
            stimuli,
            parallel,
            {"units": "sr-1", "long_name": "light polarised along the scattering plane"},
        ),
        "xyz_perpendicular": (stimuli, perpendicular, {"units": "sr-1", "long_name": "light polarised across it"}),
        "srgb": (("radius_mm", "theta", "channel"), srgb, {"long_name": f"sRGB of the light seen ({polarisation})"}),
    }
    coordinates = {
        "radius_mm": ("radius_mm", radii, {"units": "mm", "long_name": "radius of the sphere of equal volume"}),
        "theta": ("theta", theta, {"units": "degree", "long_name": "scattering angle, 0 = forward"}),
        "stimulus": ("stimulus", [0.0, 1.0, 2.0], {"units": "1", "long_name": "CIE X, Y, Z"}),
        "channel": ("channel", ["red", "green", "blue"]),
    }
    attributes = {
        "title": "Lee diagram: colour over drop radius and scattering angle",
        "source": f"gonio {_gonio.__version__}",
        "illuminant": illuminant,
        "observer": observer,
    }
    diagram: xr.Dataset = module.Dataset(data, coordinates, attributes)
    return diagram
