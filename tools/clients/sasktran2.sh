#!/usr/bin/env bash
# sasktran2 loads the exported databases and computes radiances. The sign of polarisation is checked
# with a sphere far smaller than the wavelength (Rayleigh scattering, b1[2] = +sqrt(1.5)) against
# sasktran2's own air; a drop's radiances against its phase function.
source "$(dirname "$0")/common.sh"
environment sasktran2 numpy xarray netCDF4 sasktran2
"$gonio" table tools/clients/scenes/rayleigh.toml -o "$work/rayleigh.h5" --no-preview
"$gonio" export "$work/rayleigh.h5" --to sasktran2 --cap-deg 0 --moments 16 -o "$work/rayleigh.nc"
"$gonio" table tools/clients/scenes/drop.toml -o "$work/drop.h5" --no-preview
"$gonio" export "$work/drop.h5" --to sasktran2 --cap-deg 0 --moments 800 -o "$work/drop.nc"
"$python" tools/clients/check_sasktran2.py "$work/rayleigh.nc" "$work/drop.nc" "$work/drop.h5"
