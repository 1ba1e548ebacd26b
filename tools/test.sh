#!/usr/bin/env bash
# Runs all tests: those of the program, and those that open its files from Python. With GONIO_WHEEL=1 the wheel of the
# Python package is built, too, and its tests run (some minutes). Arguments go to cargo test.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh
tools/python.sh
GONIO_PYTHON="$PWD/.tools/venv/bin/python" cargo test --release --no-fail-fast "$@"
if [ -n "${GONIO_WHEEL:-}" ]; then tools/wheel.sh; fi
