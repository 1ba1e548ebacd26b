"""Lorenz–Mie: the homogeneous sphere, exactly.

Arguments broadcast as in numpy: ``x`` against ``m``; the dimensions of ``theta_deg`` come after those of the spheres.
Plain numbers in give plain numbers out, in a few microseconds.

Conventions are those of Bohren & Huffman (1983): exp(-iωt), m = n + ik, S1 perpendicular and S2 parallel to the
scattering plane, so that the intensity of unpolarised light is (\\|S1\\|² + \\|S2\\|²) / (2 k² r²).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, overload

from gonio import _gonio

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Efficiencies", "amplitudes", "efficiencies", "legendre"]


class Efficiencies(NamedTuple):
    """Cross-sections over πa², and the asymmetry, of spheres.

    Parameters
    ----------
    q_ext, q_sca, q_abs : float or ndarray
        Extinction, scattering, absorption; the first is the sum of the others.
    q_back : float or ndarray
        Radar back-scattering efficiency 4 \\|S(180°)\\|² / x².
    asymmetry : float or ndarray
        Mean cosine of the scattering angle.
    """

    q_ext: Any
    q_sca: Any
    q_abs: Any
    q_back: Any
    asymmetry: Any


@overload
def amplitudes(
    x: float, m: complex, *, theta_deg: float, threads: int | None = None
) -> tuple[complex, complex]: ...
@overload
def amplitudes(
    x: ArrayLike, m: ArrayLike, *, theta_deg: ArrayLike, threads: int | None = None
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]: ...
def amplitudes(x: Any, m: Any, *, theta_deg: Any, threads: int | None = None) -> Any:
    """Amplitudes S1 and S2 of spheres.

    Parameters
    ----------
    x : array_like of float
        Size parameters 2πr/λ, λ the wavelength in the medium outside.
    m : array_like of complex
        Indices n + ik relative to the outside, k ≥ 0.
    theta_deg : array_like of float
        Scattering angles, 0 (forward) to 180 degrees, in any order.
    threads : int, optional
        Threads to compute with.

    Returns
    -------
    s1, s2 : ndarray of complex128, or complex where all arguments are plain numbers
        Shape ``broadcast(x, m).shape + theta_deg.shape``; perpendicular and parallel to the scattering plane.

    Raises
    ------
    ValueError
        A size, index or angle that has no meaning, or shapes that do not broadcast.

    References
    ----------
    Bohren & Huffman (1983), eqs. 4.53, 4.74, 4.88.

    Examples
    --------
    >>> s1, s2 = amplitudes(3.0, 1.33 + 1e-8j, theta_deg=0.0)
    >>> round(4 * s1.real / 3.0**2, 5)  # the optical theorem: q_ext
    1.7534
    >>> s1, s2 = amplitudes([1.0, 2.0, 5.0], 1.5, theta_deg=[0, 90, 180])
    >>> s1.shape
    (3, 3)
    """
    return _gonio.mie_amplitudes(x, m, theta_deg, threads)


@overload
def efficiencies(x: float, m: complex, *, threads: int | None = None) -> Efficiencies: ...
@overload
def efficiencies(x: ArrayLike, m: ArrayLike, *, threads: int | None = None) -> Efficiencies: ...
def efficiencies(x: Any, m: Any, *, threads: int | None = None) -> Efficiencies:
    """Efficiencies and asymmetry of spheres.

    Parameters
    ----------
    x : array_like of float
        Size parameters 2πr/λ.
    m : array_like of complex
        Indices n + ik relative to the outside, k ≥ 0.
    threads : int, optional
        Threads to compute with.

    Returns
    -------
    Efficiencies
        Named tuple of q_ext, q_sca, q_abs, q_back and asymmetry, each of the shape that x and m broadcast to.

    Raises
    ------
    ValueError
        A size or index that has no meaning, or shapes that do not broadcast.

    References
    ----------
    Bohren & Huffman (1983), eqs. 4.61, 4.62, and section 4.5.

    Examples
    --------
    >>> q = efficiencies([1.0, 10.0, 100.0], 1.33 + 0.01j)
    >>> [round(float(value), 4) for value in q.q_ext]
    [0.1218, 2.2492, 2.0923]
    """
    return Efficiencies._make(_gonio.mie_efficiencies(x, m, threads))


def legendre(
    x: ArrayLike, m: ArrayLike, *, count: int | None = None, threads: int | None = None
) -> NDArray[np.float64]:
    """Legendre coefficients χ_l of the phase function: 4π P(θ) = Σ (2l + 1) χ_l P_l(cos θ).

    Parameters
    ----------
    x : array_like of float
        Size parameters 2πr/λ.
    m : array_like of complex
        Indices n + ik relative to the outside, k ≥ 0.
    count : int, optional
        How many, from l = 0 on; without it all that the largest sphere has.
    threads : int, optional
        Threads to compute with.

    Returns
    -------
    ndarray of float64
        Shape ``broadcast(x, m).shape + (count,)``. χ_0 = 1, χ_1 is the asymmetry; the factor 2l + 1 is not included.

    Raises
    ------
    ValueError
        A size or index that has no meaning, or shapes that do not broadcast.

    Examples
    --------
    >>> chi = legendre(1e-3, 1.5)  # Rayleigh: 1, 0, 1/10
    >>> chi[:3].round(6).tolist()
    [1.0, 0.0, 0.1]
    """
    coefficients: NDArray[np.float64] = _gonio.mie_legendre(x, m, count, threads)
    return coefficients
