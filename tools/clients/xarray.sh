#!/usr/bin/env bash
# xarray (both engines), h5py and netCDF4 read our tables: names, units, the integral; xarray plots.
source "$(dirname "$0")/common.sh"
environment xarray numpy h5py xarray h5netcdf netCDF4 matplotlib
"$gonio" table tools/clients/scenes/small.toml -o "$work/t.h5" --no-preview
"$python" tools/clients/check_xarray.py "$work/t.h5"
