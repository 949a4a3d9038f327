#!/usr/bin/env bash
# Installs a build, then configures, builds and runs a small project that knows only the installed package.
#
#   run.sh BUILD_FOLDER SCRATCH_FOLDER BUILD_TYPE CXX_FLAGS
set -euo pipefail
build=$1 scratch=$2 build_type=$3 flags=$4
here=$(cd "$(dirname "$0")" && pwd)

rm -rf "$scratch"
mkdir -p "$scratch"
cmake --install "$build" --prefix "$scratch/installed" >"$scratch/install.log"

# Nobody's business outside: a room's own headers and the tests.
if find "$scratch/installed" -name '*_internal.h' -o -name '*_test*' | grep .; then
  echo "these must not be installed" >&2
  exit 1
fi

cmake -S "$here" -B "$scratch/build" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/installed" \
  -DCMAKE_BUILD_TYPE="$build_type" -DCMAKE_CXX_FLAGS="$flags" >"$scratch/configure.log"
cmake --build "$scratch/build"
cd "$scratch" && build/ten_lines
"$scratch/installed/bin/wheatstone" info "$scratch/picture.png"
