"""Debye's terms: single orders of the Lorenz–Mie series.

Order 0 is external reflection, order 1 what goes straight through, order 2 the primary rainbow, and so on:
the number of chords inside the sphere. ``"diffraction"`` is the ½ of every partial wave that meets the sphere.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from gonio import _gonio

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Term = int | Literal["diffraction", "all"]

__all__ = ["amplitudes"]


def amplitudes(
    x: ArrayLike,
    m: ArrayLike,
    *,
    theta_deg: ArrayLike,
    order: Term | Sequence[Term],
    threads: int | None = None,
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Amplitudes S1 and S2 of single orders of spheres.

    Parameters
    ----------
    x : array_like of float
        Size parameters 2πr/λ.
    m : array_like of complex
        Indices n + ik relative to the outside, k ≥ 0.
    theta_deg : array_like of float
        Scattering angles, 0 (forward) to 180 degrees.
    order : int, "diffraction", "all", or a list of the former two
        Terms of a list are added as waves. "all" is Lorenz–Mie.
    threads : int, optional
        Threads to compute with.

    Returns
    -------
    s1, s2 : ndarray of complex128
        Shape ``broadcast(x, m).shape + theta_deg.shape``; conventions of :func:`gonio.mie.amplitudes`.

    Raises
    ------
    ValueError
        A size, index, angle or order that has no meaning, or shapes that do not broadcast.

    References
    ----------
    Hovenac & Lock (1992), J. Opt. Soc. Am. A 9, 781.

    Examples
    --------
    >>> import numpy as np
    >>> theta = np.linspace(130, 150, 201)
    >>> s1, s2 = amplitudes(1000.0, 1.33, theta_deg=theta, order=2)
    >>> bool(abs(theta[np.argmax(abs(s1))] - 139) < 2)  # the primary rainbow
    True
    """
    result: tuple[Any, Any] = _gonio.debye_amplitudes(x, m, theta_deg, order, threads)
    return result
