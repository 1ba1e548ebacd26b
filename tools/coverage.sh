#!/usr/bin/env bash
# Line coverage of the rooms of the physics, by the unit tests and the tests of physics together; a few tens of
# minutes. Arguments choose modules of tests/physics (default: all): tools/coverage.sh farfield_orders:: stress::
set -euo pipefail
cd "$(dirname "$0")/.."
rustup component add llvm-tools >/dev/null
host=$(rustc -vV | sed -n 's/^host: //p')
tools="$(rustc --print sysroot)/lib/rustlib/$host/bin"
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}/coverage
raw=$CARGO_TARGET_DIR/raw
mkdir -p "$CARGO_TARGET_DIR"
rm -rf "$raw"

# Only the code of this crate counts.
wrapper=$CARGO_TARGET_DIR/rustc.sh
printf '#!/bin/sh\nexec "$@" -C instrument-coverage -C opt-level=1\n' > "$wrapper"
chmod +x "$wrapper"
export RUSTC_WORKSPACE_WRAPPER=$wrapper LLVM_PROFILE_FILE=$raw/%m-%p.profraw

options=(--release --no-default-features --features tmatrix)
cargo test "${options[@]}" --lib -- --quiet
cargo test "${options[@]}" --test physics -- --quiet "$@"
binaries=$(cargo test "${options[@]}" --lib --test physics --no-run --message-format=json |
  python3 -c 'import json, sys
rows = map(json.loads, sys.stdin)
print("\n".join(row["executable"] for row in rows if row.get("executable")))')

"$tools/llvm-profdata" merge --sparse "$raw"/*.profraw -o "$CARGO_TARGET_DIR/all.profdata"
objects=()
for binary in $binaries; do objects+=(--object "$binary"); done
"$tools/llvm-cov" export --summary-only --instr-profile "$CARGO_TARGET_DIR/all.profdata" "${objects[@]}" \
  > "$CARGO_TARGET_DIR/all.json"
python3 - "$CARGO_TARGET_DIR/all.json" <<'END'
import json
import sys

rooms, least = {}, []
for file in json.load(open(sys.argv[1], encoding="utf-8"))["data"][0]["files"]:
    if "/src/" not in file["filename"] or "/registry/" in file["filename"]:
        continue
    name = file["filename"].split("/src/", 1)[1]
    lines = file["summary"]["lines"]
    room = rooms.setdefault(name.split("/")[0], [0, 0])
    room[0] += lines["count"]
    room[1] += lines["covered"]
    if name.startswith(("farfield/", "trace/", "series/")):
        least.append((lines["count"] - lines["covered"], lines["percent"], name))
for room in ("farfield", "trace", "series", "math", "optics", "shape", "medium", "tabulate"):
    count, covered = rooms[room]
    print(f"{room:10} {covered:5} of {count:5} lines: {100 * covered / count:.1f} %")
print("most lines without a test:")
for missing, percent, name in sorted(least, reverse=True)[:12]:
    print(f"  {missing:4} ({percent:.0f} % covered) {name}")
END
