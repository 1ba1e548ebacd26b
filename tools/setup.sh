#!/usr/bin/env bash
# Brings what the build needs and a bare machine lacks: a cmake for the static HDF5 library.
# A cmake that is already installed is used; otherwise the PyPI wheel is put under .tools/.
set -euo pipefail
cd "$(dirname "$0")/.."
mkdir -p .tools/bin
if [ ! -x .tools/bin/cmake ]; then
  if system=$(command -v cmake); then
    ln -sfn "$system" .tools/bin/cmake
  else
    echo "setup: no cmake found, installing one under .tools/ (PyPI wheel)" >&2
    python3 -m pip install --quiet --disable-pip-version-check --root-user-action=ignore \
      --target .tools/python "cmake>=3.29,<5"
    ln -sfn ../python/cmake/data/bin/cmake .tools/bin/cmake
  fi
fi
.tools/bin/cmake --version >/dev/null
