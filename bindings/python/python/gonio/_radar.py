"""Rain as a radar sees it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from gonio import _gonio
from gonio._datasets import xarray
from gonio._numbers import numbers
from gonio._progress import bar

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr
    from numpy.typing import ArrayLike

__all__ = ["radar"]

#: Units and words of what is seen.
QUANTITIES = {
    "z_h": ("mm6 m-3", "reflectivity factor, horizontal polarisation"),
    "z_v": ("mm6 m-3", "reflectivity factor, vertical polarisation"),
    "z_dr": ("dB", "differential reflectivity"),
    "ldr": ("dB", "linear depolarisation ratio, -inf where nothing is depolarised"),
    "rho_hv": ("1", "co-polar correlation at lag 0"),
    "delta_hv": ("degree", "differential phase on backscatter"),
    "k_dp": ("degree km-1", "specific differential phase, one way"),
    "a_h": ("dB km-1", "specific attenuation of horizontal polarisation, one way"),
    "a_dp": ("dB km-1", "specific differential attenuation, one way"),
}


def radar(
    *,
    band: str | Sequence[str] | None = None,
    frequency_ghz: ArrayLike | None = None,
    wavelength_mm: ArrayLike | None = None,
    diameter_mm: ArrayLike | None = None,
    number_per_m3: ArrayLike = 1.0,
    marshall_palmer_mm_h: float | None = None,
    exponential: tuple[float, float] | None = None,
    normalised_gamma: tuple[float, float, float] | None = None,
    from_diameter_mm: float | None = None,
    to_diameter_mm: float | None = None,
    temperature_c: ArrayLike = 10.0,
    water: Literal["liebe-1991", "turner-2016"] = "liebe-1991",
    index: complex | None = None,
    shape: Literal["raindrop", "spheroid", "sphere"] = "raindrop",
    model: str | None = None,
    axis_ratio: float | str | None = None,
    canting_deg: float = 0.0,
    elevation_deg: float = 0.0,
    k_squared: float = 0.93,
    tolerance: float = 1e-3,
    threads: int | None = None,
    progress: bool | None = None,
) -> xr.Dataset:
    """What a radar measures of rain or of single drops, by their T-matrices.

    Parameters
    ----------
    band : str or list of str, optional
        S (2.8 GHz), C (5.6), X (9.4), Ku (13.6), Ka (35.5), W (94). One of this and the next two.
    frequency_ghz, wavelength_mm : array_like of float, optional
        Frequencies or wavelengths in place of bands.
    diameter_mm : array_like of float, optional
        Diameters of the spheres of equal volume. One of this and the next three.
    number_per_m3 : array_like of float, optional
        A number: so many drops of each diameter, each by itself. A list as long as ``diameter_mm``, such as a
        disdrometer counts: drops of all diameters are seen together.
    marshall_palmer_mm_h : float, optional
        Drops of Marshall & Palmer at this rain rate.
    exponential : (float, float), optional
        Drops N0 exp(-Λ D): N0 in m⁻³ mm⁻¹, Λ in mm⁻¹.
    normalised_gamma : (float, float, float), optional
        Drops of a normalised gamma spectrum: N_w in m⁻³ mm⁻¹, median volume diameter in mm, shape μ.
    from_diameter_mm, to_diameter_mm : float, optional
        Ends of a spectrum; 0.05 mm and the largest that the shape's model has, unless said.
    temperature_c : array_like of float, optional
        Temperatures of water.
    water : {"liebe-1991", "turner-2016"}, optional
        Formula of its permittivity.
    index : complex, optional
        Index n + ik in place of water.
    shape : {"raindrop", "spheroid", "sphere"}, optional
        Real shapes, spheroids or spheres.
    model : {"beard-chuang-1987", "chuang-beard-1990"}, optional
        Of raindrops.
    axis_ratio : float or str, optional
        Of spheroids: vertical over horizontal, or a law of the diameter: "thurai-2007" (unless said),
        "beard-chuang-1987", "brandes-2002", "pruppacher-beard-1970".
    canting_deg : float, optional
        Standard deviation of the axes' tilt.
    elevation_deg : float, optional
        Beam above the horizon.
    k_squared : float, optional
        \\|K\\|² that defines reflectivities.
    tolerance : float, optional
        Relative error asked of amplitudes.
    threads, progress : int and bool, optional
        As for :func:`gonio.table`.

    Returns
    -------
    xarray.Dataset
        ``z_h``, ``z_v`` (mm⁶ m⁻³), ``z_dr``, ``ldr`` (dB), ``rho_hv``, ``delta_hv`` (degrees), ``k_dp`` (degrees/km),
        ``a_h``, ``a_dp`` (dB/km) over ``frequency_ghz``, ``temperature_c`` (not with ``index``) and ``diameter_mm`` (where
        each is seen by itself); ``index`` of the drops. Phases and attenuations are one way.

    Raises
    ------
    ValueError
        Values that have no meaning, water or drops beyond their models, frequency or drops given twice.
    RuntimeError
        A drop whose T-matrix does not converge.

    References
    ----------
    Bringi & Chandrasekar (2001), *Polarimetric Doppler Weather Radar*, sections 3.8 to 3.14, 4.5.

    Examples
    --------
    >>> import gonio
    >>> seen = gonio.radar(frequency_ghz=10, temperature_c=20, diameter_mm=[2, 4])
    >>> seen.z_dr.round(2).values.tolist()
    [[[0.78, 2.6]]]
    >>> rain = gonio.radar(band="X", marshall_palmer_mm_h=5, shape="spheroid", canting_deg=7)
    >>> rain.z_dr.dims
    ('frequency_ghz', 'temperature_c')
    """
    import numpy as np

    module = xarray()

    one_of({"band": band, "frequency_ghz": frequency_ghz, "wavelength_mm": wavelength_mm})
    one_of(
        {
            "diameter_mm": diameter_mm,
            "marshall_palmer_mm_h": marshall_palmer_mm_h,
            "exponential": exponential,
            "normalised_gamma": normalised_gamma,
        }
    )
    letters = [band] if isinstance(band, str) else None if band is None else list(band)
    lengths = {"frequency_ghz": frequency_ghz, "wavelength_mm": wavelength_mm}
    given = {name: None if value is None else numbers(name, value).tolist() for name, value in lengths.items()}
    celsius = numbers("temperature_c", temperature_c)
    diameters = None if diameter_mm is None else numbers("diameter_mm", diameter_mm)
    drops = numbers("number_per_m3", number_per_m3)
    together = diameters is not None and np.ndim(number_per_m3) > 0
    if diameters is None and (np.ndim(number_per_m3) > 0 or drops[0] != 1.0):
        raise ValueError("number_per_m3 with a spectrum, which has its own numbers of drops")
    if diameters is not None and (from_diameter_mm is not None or to_diameter_mm is not None):
        raise ValueError("from_diameter_mm and to_diameter_mm are accepted with a spectrum, not with diameter_mm")
    if together and diameters is not None and drops.size != diameters.size:
        raise ValueError(
            f"number_per_m3 has {drops.size} values for {diameters.size} of diameter_mm: as many, or one number, "
            "are accepted"
        )
    dimensions = {"frequency_ghz": len(letters or given["frequency_ghz"] or given["wavelength_mm"] or [])}
    if index is None:
        dimensions["temperature_c"] = celsius.size
    if diameters is not None and not together:
        dimensions["diameter_mm"] = diameters.size
    with bar(int(np.prod(list(dimensions.values()))), "drops" if "diameter_mm" in dimensions else "rows", progress) as advance:
        found = _gonio.radar(
            band=letters,
            frequency_ghz=given["frequency_ghz"],
            wavelength_mm=given["wavelength_mm"],
            temperature_c=celsius.tolist(),
            water=water,
            index=None if index is None else complex(index),
            diameter_mm=None if diameters is None else diameters.tolist(),
            number_per_m3=drops.tolist(),
            together=together,
            marshall_palmer_mm_h=marshall_palmer_mm_h,
            exponential=exponential,
            normalised_gamma=normalised_gamma,
            from_diameter_mm=from_diameter_mm,
            to_diameter_mm=to_diameter_mm,
            shape=shape,
            model=model,
            axis_ratio=axis_ratio if axis_ratio is None or isinstance(axis_ratio, str) else repr(float(axis_ratio)),
            canting_deg=canting_deg,
            elevation_deg=elevation_deg,
            k_squared=k_squared,
            tolerance=tolerance,
            threads=threads,
            progress=advance,
        )
    shaped = tuple(dimensions.values())
    data: dict[str, Any] = {
        name: (tuple(dimensions), found[name].reshape(shaped), {"units": units, "long_name": words})
        for name, (units, words) in QUANTITIES.items()
    }
    # the index is that of the water, whatever the drop
    of_water = tuple(name for name in dimensions if name != "diameter_mm")
    indices = found["index"].reshape(shaped)
    if "diameter_mm" in dimensions:
        indices = indices[..., 0]
    data["index"] = (of_water, indices, {"units": "1", "long_name": "refractive index n + ik of the drops"})
    ghz = given["frequency_ghz"] or found["frequency_ghz"].round(9)
    coordinates: dict[str, Any] = {
        "frequency_ghz": ("frequency_ghz", ghz, {"units": "GHz", "long_name": "frequency"}),
        "wavelength_mm": ("frequency_ghz", found["wavelength_mm"], {"units": "mm", "long_name": "wavelength in vacuum"}),
    }
    if letters is not None:
        coordinates["band"] = ("frequency_ghz", letters)
    if index is None:
        words = "temperature of the water"
        coordinates["temperature_c"] = ("temperature_c", celsius, {"units": "degC", "long_name": words})
    if "diameter_mm" in dimensions:
        words = "diameter of the sphere of equal volume"
        coordinates["diameter_mm"] = ("diameter_mm", diameters, {"units": "mm", "long_name": words})
    attributes = {
        "title": "What a radar sees of rain",
        "source": f"gonio {_gonio.__version__}",
        "shape": shape,
        "elevation_deg": float(elevation_deg),
        "canting_deg": float(canting_deg),
        "k_squared": float(k_squared),
    }
    seen: xr.Dataset = module.Dataset(data, coordinates, attributes)
    return seen


def one_of(given: dict[str, Any]) -> None:
    """Refuses none and several."""
    names = [name for name, value in given.items() if value is not None]
    if len(names) != 1:
        raise ValueError(f"{' and '.join(names) or 'nothing'} given: one of {', '.join(given)} is accepted")
