#!/usr/bin/env bash
# libRadtran's layout and the OpenEXR map by independent readers (netCDF4, OpenEXR), their numbers by
# other codes (miepython; colours added up in Python).
source "$(dirname "$0")/common.sh"
environment formats numpy netCDF4 OpenEXR miepython
"$gonio" table tools/clients/scenes/drop.toml -o "$work/drop.h5" --no-preview
"$gonio" export "$work/drop.h5" --to libradtran --cap-deg 0 --moments 800 -o "$work/drop.cdf"
"$gonio" table tools/clients/scenes/bow.toml -o "$work/bow.h5" --no-preview
"$gonio" export "$work/bow.h5" --to exr --size 512 --radius-deg 60 -o "$work/bow.exr"
"$python" tools/clients/check_formats.py "$work/drop.cdf" "$work/bow.h5" "$work/bow.exr" 60 data
