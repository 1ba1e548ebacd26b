#!/usr/bin/env bash
# Runs the commands, files and Python of docs/tutorials.md in an empty folder.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
"$root/tools/setup.sh"
"$root/tools/python.sh"
# with the examples, so that what the checks have built is taken as it is
(cd "$root" && cargo build --release --bins --examples)
target=${CARGO_TARGET_DIR:-$root/target}
export PATH="$target/release:$PATH" GONIO_PYTHON="${GONIO_PYTHON:-$root/.tools/venv/bin/python}"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 "$root/tools/docs.py" "$root/docs/tutorials.md" > "$folder/run.sh"
cd "$folder"
bash run.sh
