"""T-matrices: spheroids and raindrops exactly, up to size parameters of about 150.

Found once, a T-matrix serves light from every side and the mean over all orientations; that is what makes it worth
more than single calls of :func:`gonio.scatter`. Conventions are those of :mod:`gonio.mie` (exp(-iωt), m = n + ik), and
for the directions those of the tables: azimuth 0 is the upper half of the vertical plane through the light.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from gonio import _gonio
from gonio.mie import Efficiencies

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

__all__ = ["Amplitudes", "RandomOrientation", "TMatrix"]


class Amplitudes(NamedTuple):
    """The amplitude matrix: E∥ = s2 E∥₀ + s3 E⊥₀ and E⊥ = s4 E∥₀ + s1 E⊥₀ (Bohren & Huffman 1983, eq. 3.12).

    Parameters
    ----------
    s1, s2, s3, s4 : ndarray of complex128
        Of the shape that the angles broadcast to.
    """

    s1: NDArray[np.complex128]
    s2: NDArray[np.complex128]
    s3: NDArray[np.complex128]
    s4: NDArray[np.complex128]


class TMatrix:
    """The T-matrix of a body of revolution.

    Parameters
    ----------
    x : float
        Size parameter 2πr/λ of the sphere of equal volume, λ in the medium outside.
    m : complex
        Index n + ik relative to the outside, k ≥ 0.
    shape : {"spheroid", "raindrop", "sphere"}, optional
        What body.
    axis_ratio : float, optional
        Of a spheroid: vertical over horizontal diameter, 0.1 to 10.
    diameter_mm : float, optional
        Of a raindrop: that of the sphere of equal volume, which says how flat it is.
    model : {"beard-chuang-1987", "chuang-beard-1990"}, optional
        Of a raindrop: who gives its shape.
    tolerance : float, optional
        Relative error of amplitudes that is accepted; what is reached is mostly far better.
    threads : int, optional
        Threads to compute with.

    Attributes
    ----------
    x : float
        As given.
    m : complex
        As given.
    error : float
        Estimated relative error of amplitudes, root mean square over all directions.
    solver : tuple of str and int
        "null field" or "least squares", and the highest degree of the waves.

    Raises
    ------
    ValueError
        A size, index or shape that has no meaning.
    RuntimeError
        A body whose T-matrix does not converge to the tolerance, with what was reached.

    References
    ----------
    Waterman (1971), Phys. Rev. D 3, 825; Mishchenko, Travis & Lacis (2002), chapter 5.

    Examples
    --------
    >>> t = TMatrix(5.0, 1.33, axis_ratio=0.8)
    >>> t.error < 1e-3
    True
    >>> q = t.efficiencies(elevation_deg=30.0)
    >>> abs(q.q_ext - q.q_sca) < 1e-9  # nothing is absorbed
    True
    """

    def __init__(
        self,
        x: float,
        m: complex,
        *,
        shape: Literal["spheroid", "raindrop", "sphere"] = "spheroid",
        axis_ratio: float | None = None,
        diameter_mm: float | None = None,
        model: str | None = None,
        tolerance: float = 1e-3,
        threads: int | None = None,
    ) -> None:
        if shape == "spheroid" and axis_ratio is None:
            raise ValueError("axis_ratio = None: 0.1 to 10 is accepted for a spheroid")
        if (shape == "raindrop") != (diameter_mm is not None):
            raise ValueError(f"diameter_mm = {diameter_mm}: a number for shape = \"raindrop\", and for no other")
        self.x = float(x)
        self.m = complex(m)
        self._inner = _gonio.TMatrix(
            self.x,
            self.m,
            shape=shape,
            axis_ratio=None if axis_ratio is None else repr(float(axis_ratio)),
            diameter_mm=1.0 if diameter_mm is None else float(diameter_mm),
            model=model,
            tolerance=tolerance,
            threads=threads,
        )
        self.error: float = self._inner.error
        self.solver: tuple[str, int] = self._inner.solver

    def __repr__(self) -> str:
        solver, degrees = self.solver
        return f"<gonio T-matrix, x = {self.x:g}, m = {self.m:g}, {solver} of {degrees} degrees, error {self.error:.0e}>"

    def amplitudes(
        self, *, theta_deg: ArrayLike, azimuth_deg: ArrayLike = 0.0, elevation_deg: float = 0.0
    ) -> Amplitudes:
        """Amplitude matrices in directions.

        Parameters
        ----------
        theta_deg : array_like of float
            Scattering angles, 0 (forward) to 180 degrees.
        azimuth_deg : array_like of float, optional
            Azimuths about the light, 0 the upper half of the vertical plane; broadcast against ``theta_deg``.
        elevation_deg : float, optional
            Light above the horizon; the body's axis is vertical.

        Returns
        -------
        Amplitudes
            s1, s2, s3, s4 of the shape that the angles broadcast to.

        Raises
        ------
        ValueError
            Angles outside what is accepted.

        Examples
        --------
        >>> t = TMatrix(5.0, 1.33, axis_ratio=0.8)
        >>> side = t.amplitudes(theta_deg=[[10.0], [90.0]], azimuth_deg=[0.0, 90.0])
        >>> side.s1.shape
        (2, 2)
        >>> bool(abs(side.s3[1, 0]) < 1e-12)  # in the plane of symmetry nothing is crossed
        True
        """
        return Amplitudes._make(self._inner.amplitudes(theta_deg, azimuth_deg, elevation_deg))

    def efficiencies(self, *, elevation_deg: float = 0.0) -> Efficiencies:
        """Cross-sections of unpolarised light over the shadow of the sphere of equal volume, and the asymmetry.

        Parameters
        ----------
        elevation_deg : float, optional
            Light above the horizon.

        Returns
        -------
        gonio.mie.Efficiencies

        Examples
        --------
        >>> flat = TMatrix(0.5, 1.5, axis_ratio=0.5)
        >>> above, beside = (flat.efficiencies(elevation_deg=degrees).q_ext for degrees in (90.0, 0.0))
        >>> above > beside  # the field lies along its long axes
        True
        """
        return Efficiencies._make(self._inner.efficiencies(elevation_deg))

    def random(self, *, tolerance: float = 1e-4, threads: int | None = None) -> RandomOrientation:
        """The mean over all orientations.

        Parameters
        ----------
        tolerance : float, optional
            Relative error of the phase function's coefficients.
        threads : int, optional
            Threads to compute with.

        Returns
        -------
        RandomOrientation

        Examples
        --------
        >>> mean = TMatrix(5.0, 1.33 + 0.01j, axis_ratio=0.8).random()
        >>> mean.coefficients.shape[1]
        6
        """
        return RandomOrientation(self._inner.random(tolerance, threads))


class RandomOrientation:
    """The mean over all orientations; made by :meth:`TMatrix.random`.

    Parameters
    ----------
    inner : object
        The engine's mean.

    Attributes
    ----------
    efficiencies : gonio.mie.Efficiencies
        Cross-sections over the shadow of the sphere of equal volume, and the asymmetry.
    coefficients : ndarray of float64
        Shape (degree, 6): α1, α2, α3, α4, β1, β2 of the expansion in generalised spherical functions (Mishchenko,
        Travis & Lacis 2002, eqs. 4.75 to 4.80); α1 of degree 0 is 1, of degree 1 three times the asymmetry.
    """

    def __init__(self, inner: _gonio.RandomMean) -> None:
        self._inner = inner
        self.efficiencies = Efficiencies._make(inner.efficiencies)
        self.coefficients: NDArray[np.float64] = inner.coefficients()

    def scattering_matrix(self, *, theta_deg: ArrayLike) -> NDArray[np.float64]:
        """The scattering matrix of Stokes vectors.

        Parameters
        ----------
        theta_deg : array_like of float
            Scattering angles, 0 (forward) to 180 degrees.

        Returns
        -------
        ndarray of float64
            Shape ``theta_deg.shape + (4, 4)``; the first element has a mean of 1 over all directions (divide by 4π for
            the phase function in sr⁻¹).

        Examples
        --------
        >>> mean = TMatrix(5.0, 1.33, axis_ratio=0.8).random()
        >>> matrix = mean.scattering_matrix(theta_deg=[0.0, 90.0])
        >>> matrix.shape
        (2, 4, 4)
        >>> bool(abs(matrix[0, 0, 1]) < 1e-6 * matrix[0, 0, 0])  # straight ahead nothing is polarised
        True
        """
        import numpy as np

        elements: NDArray[np.float64] = self._inner.elements(theta_deg)
        a1, a2, a3, a4, b1, b2 = np.moveaxis(elements, -1, 0)
        matrix = np.zeros((*elements.shape[:-1], 4, 4))
        matrix[..., 0, 0], matrix[..., 1, 1], matrix[..., 2, 2], matrix[..., 3, 3] = a1, a2, a3, a4
        matrix[..., 0, 1] = matrix[..., 1, 0] = b1
        matrix[..., 2, 3], matrix[..., 3, 2] = b2, -b2
        return matrix
