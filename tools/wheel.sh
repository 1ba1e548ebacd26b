#!/usr/bin/env bash
# Builds the wheel of bindings/python, installs it into a virtual environment of its own under .tools, and runs its
# tests beside the program. Other arguments go to pytest.
#   tools/wheel.sh --build      the wheel alone, in target/wheels
#   tools/wheel.sh --fresh      into an empty environment: what it pulls, its size, how long its import takes
#   PYTHON=python3.13 tools/wheel.sh        the same wheel and its tests on another Python
#   GONIO_PEERS=1 tools/wheel.sh            compares the numbers of miepython, scatrs and so on, too
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$root/target}
python=${PYTHON:-python3}
venv=$root/.tools/wheel-$("$python" -c "import sys; print('%d.%d' % sys.version_info[:2])")
pip() { "$venv/bin/python" -m pip "$1" --quiet --disable-pip-version-check "${@:2}"; }

needed=("maturin>=1.7,<2" pytest mypy numpy xarray h5netcdf h5py matplotlib tqdm)
if [ "$(cat "$venv/.ready" 2>/dev/null)" != "${needed[*]}" ]; then
  echo "wheel: installing ${needed[*]} under $venv" >&2
  "$python" -m venv --clear "$venv"
  pip install "${needed[@]}"
  echo "${needed[*]}" > "$venv/.ready"
fi
if [ -n "${GONIO_PEERS:-}" ]; then
  # one by one: what cannot be installed here is skipped
  for peer in miepython "scatrs==0.3.*" PyMieScatt pytmatrix pyright; do
    pip install "$peer" >/dev/null 2>&1 || echo "wheel: $peer cannot be installed here: its comparison is skipped" >&2
  done
fi

# The time is that of the library without HDF5 and of pyo3: what the program depends on, too, is taken from its build.
echo "wheel: building (some minutes at first: the library without HDF5)" >&2
rm -rf "$CARGO_TARGET_DIR/wheels"
"$venv/bin/maturin" build --quiet --locked --profile release --manifest-path bindings/python/Cargo.toml \
  --out "$CARGO_TARGET_DIR/wheels"
wheel=$(ls "$CARGO_TARGET_DIR"/wheels/gonio-*.whl)
case ${1:-} in
  --build) echo "$wheel"; exit ;;
  --fresh)
    fresh=$(mktemp -d)
    trap 'rm -rf "$fresh"' EXIT
    "$python" -m venv "$fresh/venv"
    "$fresh/venv/bin/python" -m pip install --quiet --disable-pip-version-check "$wheel"
    exec "$fresh/venv/bin/python" "$root/tools/check_wheel.py" "$wheel" ;;
esac
pip install --no-deps --force-reinstall "$wheel"
cd bindings/python
exec "$venv/bin/python" -m pytest "$@"
