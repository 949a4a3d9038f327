#!/usr/bin/env bash
# Installs a build, then configures, builds and runs small projects that know only the installed package.
#
#   run.sh BUILD_FOLDER SCRATCH_FOLDER BUILD_TYPE CXX_FLAGS
set -euo pipefail
build=$1 scratch=$2 build_type=$3 flags=$4
here=$(cd "$(dirname "$0")" && pwd)

rm -rf "$scratch"
mkdir -p "$scratch"
cmake --install "$build" --prefix "$scratch/installed" >"$scratch/install.log"

# Nobody's business outside: a room's own headers and the tests.
if find "$scratch/installed" -name '*_internal.h' -o -name '*_opencv.h' -o -name '*_test*' | grep .; then
  echo "these must not be installed" >&2
  exit 1
fi

# Every public header is in the one that stands for all.
(cd "$scratch/installed/include" && find wheatstone -name '*.h' ! -name wheatstone.h | sort) >"$scratch/headers.txt"
sed -n 's/^#include "\(.*\)"$/\1/p' "$scratch/installed/include/wheatstone/wheatstone.h" | sort |
  diff "$scratch/headers.txt" - || {
  echo "wheatstone.h and the installed headers differ" >&2
  exit 1
}

# build_project SOURCE BUILD_FOLDER CMAKE_OPTION...
build_project() {
  cmake -S "$1" -B "$2" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/installed" \
    -DCMAKE_BUILD_TYPE="$build_type" -DCMAKE_CXX_FLAGS="$flags" "${@:3}" >"$2.log"
  cmake --build "$2"
}

build_project "$here" "$scratch/build"
cd "$scratch" && build/ten_lines
"$scratch/installed/bin/wheatstone" info "$scratch/picture.png"

# The command line needs no window system, neither to be configured nor to run; asked for a window where none is
# installed, it says so in one line.
if ldd "$scratch/installed/bin/wheatstone" | grep libQt; then
  echo "the command line needs these libraries" >&2
  exit 1
fi
cmake -S "$here/../.." -B "$scratch/build-without-window" -G Ninja -DWHEATSTONE_VIEWER=OFF -DWHEATSTONE_TESTS=OFF \
  -DWHEATSTONE_BENCH=OFF -DCMAKE_DISABLE_FIND_PACKAGE_Qt6=ON -DCMAKE_BUILD_TYPE="$build_type" \
  >"$scratch/build-without-window.log"
if ninja -C "$scratch/build-without-window" -t targets all | grep 'wheatstone-view'; then
  echo "without the window it is built all the same" >&2
  exit 1
fi
rm -f "$scratch/installed/bin/wheatstone-view"
code=0
PATH=/usr/bin:/bin "$scratch/installed/bin/wheatstone" view "$scratch/picture.png" 2>"$scratch/view.txt" || code=$?
if [[ $code != 4 || $(wc -l <"$scratch/view.txt") != 1 ]] || ! grep --quiet 'built and installed with' "$scratch/view.txt"; then
  echo "without the window 'wheatstone view' ends with $code: $(cat "$scratch/view.txt")" >&2
  exit 1
fi

# Who draws paintings needs no library that reads pictures, films or particles, nor one that matches: not to configure,
# to link or to run.
build_project "$here/drawing" "$scratch/build-drawing" -DCMAKE_DISABLE_FIND_PACKAGE_OpenImageIO=ON \
  -DCMAKE_DISABLE_FIND_PACKAGE_nanoflann=ON
build-drawing/draw_painting
if ldd build-drawing/draw_painting | grep -E 'opencv_(dnn|calib3d|ximgproc|video)|libav|hdf5|OpenImageIO|heif'; then
  echo "drawing needs these libraries" >&2
  exit 1
fi
