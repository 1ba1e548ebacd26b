#!/usr/bin/env bash
# Mitsuba 3 renders a double bow from the exported folder; the order of hues along the radius is
# checked. Needs LLVM 19 beside the wheel (apt-get install libllvm19; 14 and 15 abort).
#   tools/clients/mitsuba.sh [BOW.exr] [SAMPLES]     also keeps the picture, and a PNG beside it
source "$(dirname "$0")/common.sh"
environment mitsuba numpy mitsuba
"$gonio" table tools/clients/scenes/bow.toml -o "$work/bow.h5" --no-preview
"$gonio" export "$work/bow.h5" --to mitsuba -o "$work/bow"
library=$(ls /usr/lib/*/libLLVM-19.so* /usr/lib/*/libLLVM.so.19* 2>/dev/null | head -1 || true)
[ -z "$library" ] || export DRJIT_LIBLLVM_PATH=$library
picture=${1:-$work/bow.exr}
"$python" "$work/bow/scene.py" --out "$picture" --spp "${2:-64}"
"$python" tools/clients/check_mitsuba.py "$picture"
