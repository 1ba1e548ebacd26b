"""The accessor, and what it shows."""

import numpy as np
import pytest

pytest.importorskip("xarray")

import gonio  # noqa: E402


@pytest.fixture(scope="module")
def table():
    return gonio.table(
        gonio.Sphere(radius_um=100),
        light={"wavelengths_nm": list(range(400, 701, 20))},
        table={"quantity": "mueller", "theta_deg": {"from": 0, "to": 180, "count": 361}},
    )


def test_views(table):
    cut = table.gonio.cut()
    assert cut.dims == ("wavelength_nm", "theta")
    degree = table.gonio.polarisation().sel(wavelength_nm=500).isel(phi=0)
    assert abs(degree).max() <= 1 + 1e-6 and abs(degree[0]) < 1e-3
    # the primary bow is polarised across the scattering plane
    assert degree.sel(theta=slice(138, 142)).mean() > 0.5


def test_the_bow_is_red_outside(table):
    colours = table.gonio.srgb().isel(phi=0)
    assert colours.dtype == np.uint8 and colours.shape == (361, 3)
    bow = colours.sel(theta=slice(135, 145)).astype(int)
    redness = bow.sel(channel="red") - bow.sel(channel="blue")
    assert float(redness.idxmax("theta")) < float(redness.idxmin("theta"))


def test_plots(table):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    axes = plt.figure().subplots(1, 2)
    assert len(table.gonio.plot(ax=axes[0]).lines) == 16
    assert table.gonio.plot_bow(ax=axes[1]).images
    with pytest.raises(ValueError, match="theta_deg"):
        table.gonio.plot_bow((10.1, 10.2))
    plt.close("all")


def test_wrong_views(table):
    with pytest.raises(ValueError, match="quantity"):
        table.drop_vars("mueller").gonio.polarisation()
    with pytest.raises(ValueError, match="phase_function nor mueller"):
        table.drop_vars("mueller").gonio.cut()
    with pytest.raises(ValueError):
        table.isel(wavelength_nm=[0]).gonio.srgb()
