"""Tables and amplitudes as xarray Datasets."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from gonio._numbers import numbers
from gonio._progress import bar
from gonio._scene import scene_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr
    from numpy.typing import ArrayLike

    from gonio._scene import SceneLike

__all__ = ["plan", "scatter", "table"]

#: Variables that are coordinates without being dimensions, as the file's attribute ``coordinates`` says.
COORDINATES = ("angle_from_antisolar_point", "radius_um", "sun_elevation", "solar_zenith_angle")


def xarray() -> Any:
    """The module xarray, with words where it is missing."""
    try:
        import xarray as xr
    except ImportError:
        raise ImportError('Datasets need xarray: pip install "gonio[datasets]"') from None
    import gonio._accessor  # noqa: F401  registers .gonio

    return xr


def table(
    scene: SceneLike, *, threads: int | None = None, progress: bool | None = None, **keys: Any
) -> xr.Dataset:
    """Tabulate the scattering of a scene.

    Parameters
    ----------
    scene : path, TOML text, dict of sections, or particle
        What the program's ``gonio table`` takes: sections ``particle``, ``light``, ``table``, ``model`` with the keys
        of a scene file. A :class:`gonio.Sphere` and the like stand for the section ``particle``.
    threads : int, optional
        Threads to compute with; else ``GONIO_THREADS``, else ``RAYON_NUM_THREADS``, else all cores.
    progress : bool, optional
        Show a bar by tqdm. Without it: on a terminal and in notebooks where tqdm is installed, and where there are
        several wavelengths.
    **keys
        Sections laid over those of a dictionary or a particle: ``light={"wavelengths_nm": [550]}``.

    Returns
    -------
    xarray.Dataset
        Variables, coordinates, units and attributes of the program's HDF5 file, to the last bit: ``phase_function``
        (or ``mueller``) over ``wavelength_nm``, ``theta``, ``phi`` in sr⁻¹, its integral over the sphere 1;
        cross-sections in m²; the error estimates. ``Dataset.gonio`` looks at it.

    Raises
    ------
    ValueError
        A key, value or unit that is wrong, with what is accepted.
    MemoryError
        A table that does not fit into the memory that is free.
    RuntimeError
        A result that does not pass its own checks.

    Examples
    --------
    >>> import gonio
    >>> ds = gonio.table(
    ...     gonio.Sphere(radius_um=10),
    ...     light={"wavelengths_nm": [550]},
    ...     table={"theta_deg": {"from": 0, "to": 180, "count": 181}},
    ... )
    >>> ds.phase_function.dims
    ('wavelength_nm', 'theta', 'phi')
    >>> round(float((ds.phase_function * ds.solid_angle).sum()), 4)
    1.0
    """
    module = xarray()
    made = scene_of(scene, keys)
    with bar(made.wavelengths, "wavelengths", progress) as advance:
        whole = made.table(command_line="gonio.table (Python)", threads=threads, progress=advance)
    return dataset_of(module, whole)


def dataset_of(xarray: Any, whole: Mapping[str, Any]) -> xr.Dataset:
    """The Dataset of described variables."""
    import numpy as np

    def attributes(given: Mapping[str, str | int]) -> dict[str, Any]:
        return {name: np.int32(value) if isinstance(value, int) else value for name, value in given.items()}

    data: dict[str, Any] = {}
    coordinates: dict[str, Any] = {}
    for name, dimensions, values, given in whole["variables"]:
        given = attributes(given)
        along = given.pop("coordinates", None)
        if isinstance(values, list):
            values = np.array(values)
        variable = xarray.Variable(dimensions, values, given)
        if along is not None:
            variable.encoding["coordinates"] = along
        is_coordinate = name in COORDINATES or tuple(dimensions) == (name,)
        (coordinates if is_coordinate else data)[name] = variable
    made: xr.Dataset = xarray.Dataset(data, coordinates, attributes(whole["attributes"]))
    return made


def plan(scene: SceneLike, *, threads: int | None = None, **keys: Any) -> dict[str, Any]:
    """What a scene would compute, by which methods, what is skipped and why.

    Parameters
    ----------
    scene : path, TOML text, dict of sections, or particle
        As for :func:`gonio.table`.
    threads : int, optional
        Threads that the memory is estimated for.
    **keys
        As for :func:`gonio.table`.

    Returns
    -------
    dict
        ``engine``, ``orders``, ``ranges`` (methods by wavelength and order with reason and expected error),
        ``skipped``, numbers of samples, ``memory_bytes``. The times that ``gonio plan`` measures are not in it.

    Raises
    ------
    ValueError
        As :func:`gonio.table`.

    Examples
    --------
    >>> import gonio
    >>> gonio.plan(gonio.Sphere(radius_um=10))["engine"]
    'LorenzMie'
    """
    planned: dict[str, Any] = json.loads(scene_of(scene, keys).plan(threads))
    return planned


def scatter(
    particle: SceneLike,
    *,
    wavelength_nm: ArrayLike,
    theta_deg: ArrayLike,
    azimuth_deg: ArrayLike = 0.0,
    method: str = "auto",
    sun_elevation_deg: float = 0.0,
    tolerance: float = 0.01,
    threads: int | None = None,
    **keys: Any,
) -> xr.Dataset:
    """Amplitude matrix of one particle in chosen directions.

    Parameters
    ----------
    particle : particle, dict of sections, path or TOML text
        One particle of one size; of a file or text the keyword arguments below are those of the scene.
    wavelength_nm : array_like of float
        Wavelengths in vacuum.
    theta_deg : array_like of float
        Scattering angles, 0 (forward) to 180 degrees.
    azimuth_deg : array_like of float, optional
        Azimuths about the incident light, 0 the upper half of the vertical plane.
    method : {"auto", "mie", "debye", "tmatrix", "rays"}, optional
        Who computes; ``auto`` chooses as for tables.
    sun_elevation_deg : float, optional
        Light above the horizon, for particles that are no spheres.
    tolerance : float, optional
        Relative error asked of T-matrices and rays.
    threads : int, optional
        Threads to compute with.
    **keys
        Sections laid over the scene.

    Returns
    -------
    xarray.Dataset
        Complex ``s1`` … ``s4`` over ``wavelength_nm``, ``phi``, ``theta`` (Bohren & Huffman: E∥ = s2 E∥₀ + s3 E⊥₀,
        E⊥ = s4 E∥₀ + s1 E⊥₀), ``q_ext``, ``q_sca``, ``q_abs``, ``q_back``, ``asymmetry``, ``error_estimate`` (NaN where
        the method is exact), ``index``.

    Raises
    ------
    ValueError
        Values that have no meaning, several particles or sizes, a method that does not serve the particle.

    Examples
    --------
    >>> import gonio
    >>> drop = gonio.Sphere(radius_um=50, medium="water")
    >>> seen = gonio.scatter(drop, wavelength_nm=550, theta_deg=[0, 90, 139])
    >>> seen.s1.shape, seen.attrs["engine"]
    ((1, 1, 3), 'LorenzMie')
    """
    import numpy as np

    module = xarray()

    nm = numbers("wavelength_nm", wavelength_nm, (1.0, 1e9), "wavelengths from 1 to 1e9 nm are accepted")
    theta = numbers("theta_deg", theta_deg, (0.0, 180.0), "scattering angles from 0 to 180 degrees are accepted")
    phi = numbers("azimuth_deg", azimuth_deg, (-360.0, 360.0), "azimuths from -360 to 360 degrees are accepted")
    laid: dict[str, Any] = {
        "light": {"wavelengths_nm": sorted(set(nm.tolist())), "sun_elevation_deg": sun_elevation_deg},
        "model": {"method": method, "tolerance": tolerance},
    }
    for section, values in keys.items():
        laid[section] = {**laid.get(section, {}), **values}
    made = scene_of(particle, laid)
    found = made.scatter(nm.tolist(), theta.tolist(), phi.tolist(), threads)
    directions, spectrum = ("wavelength_nm", "phi", "theta"), ("wavelength_nm", "phi")
    units = {"units": "1"}
    elements = {"s1": "⊥ from ⊥", "s2": "∥ from ∥", "s3": "∥ from ⊥", "s4": "⊥ from ∥"}
    data: dict[str, Any] = {
        name: (directions, found[name], units | {"long_name": f"amplitude, {words} the scattering plane"})
        for name, words in elements.items()
    }
    sections = {
        "q_ext": "extinction over the shadow of the sphere of equal volume",
        "q_sca": "scattering, likewise",
        "q_abs": "absorption, likewise",
        "q_back": "radar back-scattering, likewise",
        "asymmetry": "mean cosine of the scattering angle",
    }
    data |= {name: (spectrum, found[name], units | {"long_name": words}) for name, words in sections.items()}
    words = "estimated relative error of the intensity, NaN where the method is exact"
    data["error_estimate"] = (directions, found["error_estimate"], units | {"long_name": words})
    data["index"] = ("wavelength_nm", found["index"], units | {"long_name": "refractive index n + ik"})
    coordinates = {
        "wavelength_nm": ("wavelength_nm", nm, {"units": "nm", "long_name": "wavelength in vacuum"}),
        "phi": ("phi", phi, {"units": "degree", "long_name": "azimuth about the incident light"}),
        "theta": ("theta", theta, {"units": "degree", "long_name": "scattering angle, 0 is forward"}),
    }
    attributes = {"engine": found["engine"], "scene": made.toml}
    attributes["diffraction_included"] = np.int32(found["diffraction_included"])
    seen: xr.Dataset = module.Dataset(data, coordinates, attributes)
    return seen
