#!/usr/bin/env bash
# Runs all tests: those of the program, those that open its files from Python, and those of the Python package, whose
# wheel is built for them (some minutes; GONIO_WHEEL=0 leaves it out). Arguments go to cargo test, and then it is all.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh
tools/python.sh
GONIO_PYTHON="$PWD/.tools/venv/bin/python" cargo test --release --no-fail-fast "$@"
if [ "${GONIO_WHEEL:-1}" = 0 ] || [ $# -gt 0 ]; then exit; fi
if python3 -c "import sys; sys.exit(sys.version_info < (3, 11))"; then
  tools/wheel.sh
else
  echo "test: the Python package needs Python 3.11 or newer: its tests are skipped" >&2
fi
