#!/usr/bin/env bash
# Builds gonio and tabulates a scene: by default the built-in raindrop, into raindrop.h5 with a
# picture beside it. Anything given here goes to `gonio table`, for example
#   tools/run.sh data/scenes/large_drop.toml -o large_drop.h5
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/tools/setup.sh"
if [ ! -x "$root/target/release/gonio" ]; then
  echo "run: building gonio and its HDF5; the first time this takes some minutes, cargo says how far it is" >&2
fi
(cd "$root" && cargo build --release)
echo "run: gonio table ${*:--o raindrop.h5 --overwrite}" >&2
if [ $# -eq 0 ]; then
  # The default result may be made again; any other file is replaced only on request.
  set -- -o raindrop.h5 --overwrite
fi
exec "$root/target/release/gonio" table "$@"
