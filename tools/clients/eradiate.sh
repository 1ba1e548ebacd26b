#!/usr/bin/env bash
# Eradiate builds its particle properties from the exported Aer-Core v2 files: a sphere's four elements, a
# spheroid's six.
source "$(dirname "$0")/common.sh"
environment eradiate 'eradiate[kernel]'
"$gonio" table tools/clients/scenes/drop.toml -o "$work/drop.h5" --no-preview
"$gonio" export "$work/drop.h5" --to eradiate --moments 129 -o "$work/drop.nc"
"$gonio" table tools/clients/scenes/spheroid.toml -o "$work/spheroid.h5" --no-preview
"$gonio" export "$work/spheroid.h5" --to eradiate --moments 129 -o "$work/spheroid.nc"
"$gonio" export "$work/spheroid.h5" --to csv -o "$work/spheroid.csv"
"$python" tools/clients/check_eradiate.py "$work/drop.nc" "$work/spheroid.nc" "$work/spheroid.csv"
