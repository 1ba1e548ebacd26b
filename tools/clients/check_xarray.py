"""Named coordinates with units, and the sum of P times solid angle, by every reader."""

import sys

import h5py
import matplotlib
import netCDF4
import numpy as np
import xarray as xr

matplotlib.use("Agg")
path = sys.argv[1]
units = {"wavelength_nm": "nm", "theta": "degree", "phi": "degree"}
for engine in ("h5netcdf", "netcdf4"):
    table = xr.open_dataset(path, engine=engine)
    values = table["phase_function"] if "phase_function" in table \
        else table["mueller"].sel(mueller_element="11")
    assert set(units) <= set(values.dims), values.dims
    for name, unit in units.items():
        assert table[name].attrs["units"] == unit, (engine, name)
    assert values.attrs["units"] == "sr-1"
    total = (values.astype("f8") * table["solid_angle"]).sum(["theta", "phi"])
    assert np.all(abs(total - 1) < 1e-3), total.values
    print(f"{engine}: dims {dict(table.sizes)}, sum P dOmega {total.values}")
    table.close()
with netCDF4.Dataset(path) as file:
    assert set(units) <= set(file.dimensions), file.dimensions.keys()
with h5py.File(path) as file:
    name = "phase_function" if "phase_function" in file else "mueller"
    labels = [file[name].dims[i].keys() for i in range(file[name].ndim)]
    print("h5py: scales", labels)
    assert labels[0] == ["wavelength_nm"] and labels[-1] == ["phi"]

# A plot by xarray alone labels its axes with our names and units.
with xr.open_dataset(path, engine="h5netcdf") as table:
    values = table["phase_function"] if "phase_function" in table \
        else table["mueller"].sel(mueller_element="11")
    lines = values.isel(phi=0).plot.line(x="theta", yscale="log")
    axes = lines[0].axes
    print("xarray plot:", axes.get_xlabel().replace("\n", " "), "|", axes.get_ylabel().replace("\n", " "))
    assert "degree" in axes.get_xlabel() and "sr-1" in axes.get_ylabel()
    assert len(lines) == table.sizes["wavelength_nm"]
    axes.figure.savefig(path + ".png")
