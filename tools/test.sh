#!/usr/bin/env bash
# Runs all tests: those of the program, and those that open its files from Python.
set -euo pipefail
cd "$(dirname "$0")/.."
tools/setup.sh
tools/python.sh
GONIO_PYTHON="$PWD/.tools/venv/bin/python" cargo test --release --no-fail-fast "$@"
