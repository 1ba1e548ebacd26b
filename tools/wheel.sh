#!/usr/bin/env bash
# Builds the wheel of bindings/python, installs it into a virtual environment of its own under .tools/wheel, and
# runs its tests beside the program. Arguments go to pytest. With GONIO_PEERS=1 the numbers of miepython, scatrs and
# so on are compared, too.
set -euo pipefail
cd "$(dirname "$0")/.."
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}
venv=$PWD/.tools/wheel
python=${PYTHON:-python3}
if ! "$venv/bin/python" -c "import maturin, pytest, mypy, xarray, h5netcdf, matplotlib, tqdm" 2>/dev/null; then
  echo "wheel: installing maturin, pytest, mypy, xarray, h5netcdf, matplotlib, tqdm under $venv" >&2
  "$python" -m venv "$venv"
  "$venv/bin/python" -m pip install --quiet --disable-pip-version-check \
    "maturin>=1.7,<2" pytest mypy numpy xarray h5netcdf h5py matplotlib tqdm
fi
if [ -n "${GONIO_PEERS:-}" ]; then
  "$venv/bin/python" -m pip install --quiet --disable-pip-version-check miepython "scatrs==0.3.*" PyMieScatt pytmatrix ||
    echo "wheel: not all peers could be installed; those missing are skipped" >&2
fi
echo "wheel: building (some minutes at first: the library without HDF5)" >&2
rm -rf "$CARGO_TARGET_DIR/wheels"
"$venv/bin/maturin" build --quiet --locked --profile release --manifest-path bindings/python/Cargo.toml \
  --out "$CARGO_TARGET_DIR/wheels"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps --force-reinstall \
  "$CARGO_TARGET_DIR"/wheels/gonio-*.whl
cd bindings/python
exec "$venv/bin/python" -m pytest "$@"
