"""``Dataset.gonio``: looking at a table, nothing else. matplotlib is needed by the plots alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import xarray as xr

from gonio import _gonio

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["Look"]


@xr.register_dataset_accessor("gonio")  # type: ignore[no-untyped-call]
class Look:
    """Views of a table of :func:`gonio.table`.

    Parameters
    ----------
    dataset : xarray.Dataset
        The table.

    Examples
    --------
    >>> import gonio
    >>> ds = gonio.table(
    ...     gonio.Sphere(radius_um=10),
    ...     light={"wavelengths_nm": [550]},
    ...     table={"theta_deg": [0, 90, 180], "quantity": "mueller"},
    ... )
    >>> ds.gonio.cut().dims, ds.gonio.polarisation().dims
    (('wavelength_nm', 'theta'), ('wavelength_nm', 'theta', 'phi'))
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset

    @property
    def intensity(self) -> xr.DataArray:
        """The phase function of unpolarised light, sr⁻¹, over wavelength, theta and phi."""
        if "phase_function" in self._dataset:
            return self._dataset["phase_function"]
        if "mueller" in self._dataset:
            return self._dataset["mueller"].sel(mueller_element="11", drop=True)
        raise ValueError("the Dataset has neither phase_function nor mueller: one of gonio.table is accepted")

    def cut(self, azimuth_deg: float = 180.0) -> xr.DataArray:
        """The phase function along one half-plane of azimuth.

        Parameters
        ----------
        azimuth_deg : float, optional
            The nearest azimuth of the table is taken; 180, light that goes down, is the top of a bow.

        Returns
        -------
        xarray.DataArray
            Over wavelength and theta, sr⁻¹.
        """
        cut: xr.DataArray = self.intensity.sel(phi=azimuth_deg, method="nearest")
        return cut

    def polarisation(self) -> xr.DataArray:
        """The degree of linear polarisation −S12/S11 of unpolarised light; needs a table of all elements.

        Returns
        -------
        xarray.DataArray
            Positive: across the scattering plane.
        """
        if "mueller" not in self._dataset:
            raise ValueError('the polarisation needs a table with table={"quantity": "mueller"}')
        mueller = self._dataset["mueller"]
        first, second = (mueller.sel(mueller_element=name, drop=True) for name in ("11", "12"))
        degree: xr.DataArray = -second / first
        degree.attrs = {"units": "1", "long_name": "degree of linear polarisation, positive across the scattering plane"}
        renamed: xr.DataArray = degree.rename("polarisation")
        return renamed

    def xyz(self, illuminant: str = "D65", observer: str = "1931") -> xr.DataArray:
        """CIE X, Y, Z of the phase function under a light, sr⁻¹.

        Parameters
        ----------
        illuminant, observer : str, optional
            As for :func:`gonio.lee`.

        Returns
        -------
        xarray.DataArray
            Over theta, phi and ``stimulus``.

        Raises
        ------
        ValueError
            Wavelengths that do not cover the visible.
        """
        nm = self._dataset["wavelength_nm"]
        weights = _gonio.colour_weights(nm.values.tolist(), illuminant, observer)
        by = xr.DataArray(weights, dims=("wavelength_nm", "stimulus"), coords={"wavelength_nm": nm})
        # scattered power per direction: the phase function times its cross-section
        cross = self._dataset["scattering_cross_section"]
        power = self.intensity.astype(float) * (cross / cross.mean())
        whole = xr.dot(power, by, dim="wavelength_nm")
        whole.attrs = {"units": "sr-1", "long_name": "CIE X, Y, Z"}
        renamed: xr.DataArray = whole.assign_coords(stimulus=["X", "Y", "Z"]).rename("xyz")
        return renamed

    def srgb(
        self, illuminant: str = "D65", observer: str = "1931", *, exposure: float | None = None, peak: float = 0.8
    ) -> xr.DataArray:
        """Colours on a screen.

        Parameters
        ----------
        illuminant, observer : str, optional
            As for :func:`gonio.lee`.
        exposure : float, optional
            Factor on Y; without it such that the brightest direction beyond 90° has luminance ``peak``.
        peak : float, optional
            See there.

        Returns
        -------
        xarray.DataArray of uint8
            Over theta, phi and ``channel``.
        """
        import numpy as np

        xyz = self.xyz(illuminant, observer).transpose(..., "stimulus")
        if exposure is None:
            behind = xyz.where(xyz.theta > 90, drop=True) if float(xyz.theta.max()) > 90 else xyz
            exposure = peak / float(behind.sel(stimulus="Y").max())
        flat = np.ascontiguousarray(xyz.values.reshape(-1, 3), dtype=float)
        colours = _gonio.srgb_of(flat, exposure).reshape(xyz.shape)
        return xr.DataArray(
            colours,
            dims=(*xyz.dims[:-1], "channel"),
            coords={name: xyz.coords[name] for name in ("theta", "phi") if name in xyz.coords}
            | {"channel": ["red", "green", "blue"]},
            name="srgb",
            attrs={"long_name": "sRGB"},
        )

    def plot(self, azimuth_deg: float = 180.0, ax: Axes | None = None, **style: Any) -> Axes:
        """The phase function of every wavelength over the scattering angle, logarithmic.

        Parameters
        ----------
        azimuth_deg : float, optional
            As for :meth:`cut`.
        ax : matplotlib Axes, optional
            Where to draw.
        **style
            Goes to matplotlib.

        Returns
        -------
        matplotlib Axes
        """
        ax = _axes(ax)
        cut = self.cut(azimuth_deg)
        for nm in cut.wavelength_nm.values:
            ax.plot(cut.theta, cut.sel(wavelength_nm=nm), **{"label": f"{nm:g} nm", "lw": 1, **style})
        ax.set(yscale="log", xlabel="scattering angle (degrees)", ylabel="phase function (1/sr)")
        if 1 < cut.sizes["wavelength_nm"] <= 8:
            ax.legend()
        return ax

    def plot_bow(self, theta_deg: tuple[float, float] = (120.0, 150.0), ax: Axes | None = None) -> Axes:
        """The colours of a bow over angle and azimuth, as the eye would see them.

        Parameters
        ----------
        theta_deg : tuple of float, optional
            First and last scattering angle.
        ax : matplotlib Axes, optional
            Where to draw.

        Returns
        -------
        matplotlib Axes
        """
        import numpy as np

        ax = _axes(ax)
        part = self._dataset.sel(theta=slice(*theta_deg))
        if part.sizes["theta"] < 2:
            raise ValueError(f"theta_deg = {theta_deg}: a range that holds angles of the table is accepted")
        colours = part.gonio.srgb().transpose("phi", "theta", "channel").values
        phi = part.phi.values
        if len(phi) == 1:
            colours, phi = np.repeat(colours, 2, axis=0), np.array([0.0, 360.0])
        extent = (float(part.theta[0]), float(part.theta[-1]), float(phi[0]), float(phi[-1]))
        ax.imshow(colours, extent=extent, aspect="auto", origin="lower")
        ax.set(xlabel="scattering angle (degrees)", ylabel="azimuth (degrees)")
        return ax


def _axes(ax: Axes | None) -> Any:
    if ax is not None:
        return ax
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise ImportError('plots need matplotlib: pip install "gonio[all]"') from None
    return plt.gca()
