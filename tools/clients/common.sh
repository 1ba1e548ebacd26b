# Sourced by the client scripts: an environment of its own for each program, the gonio binary.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
gonio=${GONIO:-target/release/gonio}
environments=${GONIO_CLIENTS:-target/clients}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# environment NAME PACKAGE…: python of a virtual environment that has the packages.
environment() {
  local name=$1; shift
  local folder=$environments/$name
  if [ ! -x "$folder/bin/python" ]; then
    if ! python3 -m venv "$folder" 2>/dev/null; then
      # Some systems ship Python without ensurepip.
      rm -rf "$folder"
      python3 -m pip install --quiet --disable-pip-version-check --root-user-action=ignore \
        --target "$environments/virtualenv" virtualenv
      PYTHONPATH=$environments/virtualenv python3 -m virtualenv --quiet "$folder"
    fi
    "$folder/bin/pip" install --quiet --disable-pip-version-check "$@"
  fi
  python=$folder/bin/python
}
