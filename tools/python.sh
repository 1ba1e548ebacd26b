#!/usr/bin/env bash
# Brings the Python packages that the tests open files with, under .tools/venv.
set -euo pipefail
cd "$(dirname "$0")/.."
venv=.tools/venv
if ! "$venv/bin/python" -c "import numpy, h5py, xarray, h5netcdf, netCDF4" 2>/dev/null; then
  echo "setup: installing numpy, h5py, xarray, h5netcdf, netCDF4 under $venv" >&2
  if ! python3 -m venv "$venv" 2>/dev/null; then
    # Some systems ship Python without ensurepip.
    rm -rf "$venv"
    python3 -m pip install --quiet --disable-pip-version-check --root-user-action=ignore \
      --target .tools/virtualenv virtualenv
    PYTHONPATH=.tools/virtualenv python3 -m virtualenv --quiet "$venv"
  fi
  "$venv/bin/python" -m pip install --quiet --disable-pip-version-check \
    numpy h5py xarray h5netcdf netCDF4
fi
