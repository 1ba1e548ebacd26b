#!/usr/bin/env bash
# Eradiate builds its particle properties from the exported Aer-Core v2 file.
source "$(dirname "$0")/common.sh"
environment eradiate eradiate
"$gonio" table tools/clients/scenes/drop.toml -o "$work/drop.h5" --no-preview
"$gonio" export "$work/drop.h5" --to eradiate --moments 129 -o "$work/drop.nc"
"$python" tools/clients/check_eradiate.py "$work/drop.nc"
