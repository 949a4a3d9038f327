#!/usr/bin/env bash
# The law of the rooms must be able to fail: each of these small trees breaks it in one way.
set -euo pipefail
law=$(cd "$(dirname "$0")" && pwd)/room_order.sh
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch"/{image,stereo,measures,strokes,app}
printf 'add_subdirectory(%s)\n' image stereo measures strokes app >"$scratch/CMakeLists.txt"

expect() {  # expect holds|breaks FILE LINE
  printf '%s\n' "$3" >"$scratch/$2"
  if "$law" "$scratch" >/dev/null; then found=holds; else found=breaks; fi
  rm "$scratch/$2"
  if [[ $found != "$1" ]]; then
    echo "room_order: $2 with '$3' $found the law, expected: $1" >&2
    exit 1
  fi
}

expect holds stereo/warp.h '#include "wheatstone/image/image.h"'
expect holds image/image.h '#include "wheatstone/error.h"'
expect holds image/image.h '#include <vector>'
expect holds image/read.cpp '#include <opencv2/core.hpp>'
expect holds image/mat_opencv.h '#include <opencv2/core.hpp>'
expect holds image/read_test.cpp '#include "wheatstone/stereo/warp.h"'
expect breaks image/image.h '#include "wheatstone/stereo/warp.h"'
expect breaks image/read.cpp '#include "wheatstone/stereo/warp.h"'
expect breaks error.h '#include "wheatstone/image/image.h"'
expect breaks stereo/warp.h '#include <opencv2/core.hpp>'
expect breaks stereo/warp.h '#include <fmt/format.h>'
expect breaks stereo/warp.h '#include "wheatstone/image/mat_opencv.h"'
expect holds stereo/warp.cpp '#include "wheatstone/image/mat_opencv.h"'
expect holds stereo/warp.cpp '#include "wheatstone/stereo/rows_internal.h"'
expect breaks stereo/warp.cpp '#include "wheatstone/image/rows_internal.h"'
expect breaks stereo/warp.cpp '#include "wheatstone/cellar/wine.h"'
expect holds app/report.cpp '#include "wheatstone/measures/wrong_spots.h"'
expect holds strokes/plan_test.cpp '#include "wheatstone/measures/wrong_spots.h"'
expect breaks strokes/plan.cpp '#include "wheatstone/measures/wrong_spots.h"'
expect breaks strokes/plan_internal.h '#include "wheatstone/measures/wrong_spots.h"'
