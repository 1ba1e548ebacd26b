"""Refractive indices by name, formula or file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gonio import _gonio
from gonio._keys import json_of, tell
from gonio.particles import in_keys

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import ArrayLike

__all__ = ["Material", "material", "media"]


class Material:
    """A material; made by :func:`gonio.material`.

    Parameters
    ----------
    inner : object
        The engine's medium.

    Attributes
    ----------
    name, source : str
        What it is, and where its data are from.
    range_nm : tuple of float
        Wavelengths in vacuum that the data cover.
    abbe : tuple of float, or None
        n_d and V_d.
    """

    def __init__(self, inner: _gonio.Medium) -> None:
        self._inner = inner
        self.name = inner.name
        self.source = inner.source
        self.range_nm = inner.range_nm
        self.abbe = inner.abbe

    def __repr__(self) -> str:
        low, high = self.range_nm
        return f"<gonio material {self.name}, {low:g} to {high:g} nm>"

    def index(self, wavelength_nm: ArrayLike) -> Any:
        """Refractive index n + ik, k ≥ 0 absorbs.

        Parameters
        ----------
        wavelength_nm : array_like of float
            Wavelengths in vacuum.

        Returns
        -------
        ndarray of complex128, or complex
            Of the shape of ``wavelength_nm``.

        Raises
        ------
        ValueError
            A wavelength outside the data.

        Examples
        --------
        >>> import gonio
        >>> round(gonio.material("N-BK7").index(587.5618).real, 5)
        1.5168
        """
        return self._inner.index(wavelength_nm)


def material(medium: str | complex | Mapping[str, Any]) -> Material:
    """A material by its name, file or formula.

    Parameters
    ----------
    medium : str, complex or dict
        A name of :func:`gonio.media`; a file of refractiveindex.info (.yml), a .csv, or ``catalogue.agf:GLASS``; an
        index n + ik; or a table as in a scene file.

    Returns
    -------
    Material
        With ``index(wavelength_nm)``.

    Raises
    ------
    ValueError
        An unknown name, with the nearest known one; data that cannot be read.

    Examples
    --------
    >>> import gonio
    >>> gonio.material({"cauchy": [1.5, 0.004]}).index([500.0, 1000.0]).real.round(3).tolist()
    [1.516, 1.504]
    """
    known = in_keys(medium)
    inner = _gonio.Medium(name=known) if isinstance(known, str) else _gonio.Medium(json=json_of(known))
    tell(inner.notes)
    return Material(inner)


def media() -> dict[str, str]:
    """Names of the library's media, each with what it is and its source.

    Returns
    -------
    dict
        Name to words.

    Examples
    --------
    >>> import gonio
    >>> "water" in gonio.media()
    True
    """
    return {name: f"{kind}; {source}" for name, kind, source in _gonio.media()}
