#!/usr/bin/env bash
# Builds the page of bindings/web into bindings/web/dist, holds its engine's size and its numbers against the native
# ones, and with --test tries it in a headless Chromium, if there is one (GONIO_CHROMIUM names another).
#   tools/web.sh            the page
#   tools/web.sh --test     and its tests
#   tools/web.sh --quick    without link-time optimisation, for daily work
# Where the WebAssembly target, node or npm cannot be had it says so and ends well.
set -euo pipefail
cd "$(dirname "$0")/.."
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}
target=wasm32-unknown-unknown
# a little above what was measured: who adds what the page cannot reach is to notice
largest=2800000 largest_packed=750000

skip() { echo "web: $1: the page is not built here" >&2; exit 0; }
profile=dist test=
for argument in "$@"; do
  case $argument in
    --quick) profile=quick ;;
    --test) test=yes ;;
    *) echo "web: $argument is not known; accepted: --quick, --test" >&2; exit 2 ;;
  esac
done
command -v node >/dev/null && command -v npm >/dev/null || skip "node and npm are not here"
[ "$(node -p 'process.versions.node.split(".")[0]')" -ge 20 ] || skip "node is older than 20"
sysroot=$(rustc --print sysroot)
if [ ! -d "$sysroot/lib/rustlib/$target" ]; then
  rustup target add "$target" >/dev/null 2>&1 || skip "the Rust target $target cannot be had"
fi
(cd bindings/web && npm ci --no-audit --no-fund --silent) || skip "npm cannot get what package-lock.json names"

engine=bindings/web/engine/Cargo.toml
echo "web: building the engine (some minutes at first: the library without HDF5)" >&2
RUSTFLAGS="-C target-feature=+simd128" cargo build --quiet --locked --profile $profile --target $target --manifest-path $engine
cargo build --quiet --locked --profile quick --examples --manifest-path $engine
native=$CARGO_TARGET_DIR/quick/examples
wasm=$CARGO_TARGET_DIR/$target/$profile/gonio_web.wasm

cd bindings/web
npx tsc --noEmit
node build.mjs "$wasm"
if [ $profile = dist ]; then
  node -e '
    const bytes = require("fs").readFileSync(process.argv[1]);
    const packed = require("zlib").brotliCompressSync(bytes).length;
    console.log(`web: engine ${bytes.length} bytes, ${packed} by brotli`);
    if (bytes.length > Number(process.argv[2]) || packed > Number(process.argv[3])) {
      console.error("web: the engine is larger than it may be");
      process.exit(1);
    }' "$wasm" $largest $largest_packed
fi
node tests/parity.mjs "$wasm" "$native/answer" "$native/answer_alike"
[ -z "$test" ] || GONIO_REFERENCE=$native/reference node --test --test-concurrency=1 tests/*.test.mjs
echo "web: open bindings/web/dist/index.html" >&2
