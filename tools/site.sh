#!/usr/bin/env bash
# Builds the documentation as one site: notebooks (run anew, with pictures), Python's reference, the pages of docs/ and
# the program's commands. Any warning fails it. The result is target/site/html/index.html.
set -euo pipefail
cd "$(dirname "$0")/.."
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}
venv=$PWD/.tools/site
source=$CARGO_TARGET_DIR/site/source html=$CARGO_TARGET_DIR/site/html
program=$CARGO_TARGET_DIR/release/gonio
[ -x "$program" ] || { tools/setup.sh && cargo build --release; }
tools/wheel.sh --build
if [ ! -e "$venv/.ready" ] || [ docs/site/requirements.txt -nt "$venv/.ready" ]; then
  echo "site: installing Sphinx under $venv" >&2
  python3 -m venv "$venv"
  "$venv/bin/python" -m pip install --quiet --disable-pip-version-check -r docs/site/requirements.txt
  touch "$venv/.ready"
fi
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall \
  "$CARGO_TARGET_DIR"/wheels/gonio-*.whl
rm -rf "$source"
mkdir -p "$source/_static"
cp docs/*.md docs/*.svg docs/site/*.md docs/site/conf.py bindings/python/docs/from_elsewhere.md "$source"
cp docs/site/site.css "$source/_static"
cp validation/gallery/double.png "$source"
cp -r bindings/python/notebooks "$source"
python3 tools/commands_page.py "$program" > "$source/commands.md"
"$venv/bin/python" -m sphinx -b html -W --keep-going -q "$source" "$html"
echo "$html/index.html"
