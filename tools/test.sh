#!/usr/bin/env bash
# Runs all tests: those of the program, those that open its files from Python, and those of the Python package.
# Arguments go to cargo test; with any, the Python package is left out.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh
tools/python.sh
GONIO_PYTHON="$PWD/.tools/venv/bin/python" cargo test --release --no-fail-fast "$@"
if [ $# -eq 0 ]; then tools/wheel.sh; fi
