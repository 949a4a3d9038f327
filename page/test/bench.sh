#!/usr/bin/env bash
# Pages of pictures of each kind, 640 pixels wide, and a table of what they need in a browser that draws with the
# processor. What is there from the last time is used again.
#
#   bench.sh WHEATSTONE FOLDER    the program, and a folder for what is made
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
wheatstone=$(realpath "$1")
mkdir -p "$2" && cd "$2"

run() { "$wheatstone" --quiet "$@" >/dev/null; }

# make FILE WORDS...: runs the program unless the file is there
make() {
  local file=$1
  shift
  [[ -e $file ]] || run "$@"
}

make still synth still --size 640x480 -o still
photographs=(still/left.png still/right.png --disparity still/left_disparity.pfm)
styles=(oil impressionist expressionist colorist-wash pointillist psychedelic dual posterise mosaic diffusion)
for style in "${styles[@]}"; do
  make "$style/painting.wst" paint "${photographs[@]}" --style "$style" -o "$style"
  run share "$style/painting.wst" -o "$style.html"
done
run share "${photographs[@]}" -o photograph.html
make fruit_qs5x4a1.33.png pack impressionist/painting.wst --to quilt --quilt 5x4 -o fruit
run share fruit_qs5x4a*.png -o quilt.html
make universe.hdf5 synth universe -o universe.hdf5
make slices.exr render universe.hdf5 --size 640x480 --save-slices slices.exr -o views
run share slices.exr -o slices.html
make film synth film --size 640x360 --frames 12 --samples 1 -o film
make film.mp4 rotoscope film --style posterise -o film.mp4
run share film.mp4 -o film.html
node "$here/bench.mjs" "${styles[@]/%/.html}" {photograph,quilt,slices,film}.html
