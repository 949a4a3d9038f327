#!/usr/bin/env bash
# Times whole commands on one thread and on two: CPU seconds, seconds, and megabytes at most. Beside them stand programs that
# do the same work without a painting, where they are installed: OpenCV's SGBM, libpng, ffmpeg and dd. The lowest CPU
# time of three runs counts.
#
#   bench/around.sh build/release/bin/wheatstone [DATA]
#
# DATA holds stereo/teddy and stereo/motorcycle; without it they are left out.
set -euo pipefail
wheatstone=$(realpath "$1")
data=${2:+$(realpath --quiet "$2" || true)}
work=$(mktemp --directory)
trap 'rm -rf "$work"' EXIT
cd "$work"

# "cpu wall megabytes" of the best of three runs.
best_of() {
  for _ in 1 2 3; do
    /usr/bin/time --format '%U %S %e %M' --output=one "$@" >/dev/null 2>&1 || { echo "around: failed: $*" >&2; kill $$; }
    tail -1 one
  done | awk '{ cpu = $1 + $2; if (NR == 1 || cpu < least) { least = cpu; wall = $3; kb = $4 } }
              END { printf "%.2f %.2f %.0f", least, wall, kb / 1024 }'
}
row() { # label, command without --threads
  local label=$1 cpu1 wall1 mb1 wall2
  shift
  read -r cpu1 wall1 mb1 <<<"$(best_of "$@" --threads 1)"
  read -r _ wall2 _ <<<"$(best_of "$@" --threads 2)"
  awk -v label="$label" -v cpu="$cpu1" -v one="$wall1" -v two="$wall2" -v mb="$mb1" \
    'BEGIN { printf "%-44s %7.2f %7.2f %7.2f %6.2f x %6d\n", label, cpu, one, two, one / (two > 0 ? two : 0.01), mb }'
}
rival() { # label, command
  local label=$1 cpu wall mb
  shift
  read -r cpu wall mb <<<"$(best_of "$@")"
  awk -v label="  $label" -v cpu="$cpu" -v wall="$wall" -v mb="$mb" \
    'BEGIN { printf "%-44s %7.2f %7.2f %16s %6d\n", label, cpu, wall, "", mb }'
}
has_python_with() { python3 -c "import $1" 2>/dev/null; }

"$wheatstone" --quiet synth still --size 1920x1080 -o hd >/dev/null
"$wheatstone" --quiet synth still --size 4000x3000 -o large >/dev/null
"$wheatstone" --quiet synth still --size 64x64 -o small >/dev/null
"$wheatstone" --quiet pack large/left.png large/right.png --to sbs -o large.jpg >/dev/null
"$wheatstone" --quiet synth universe --particles 1000000 -o universe.hdf5 >/dev/null
for size in hd large; do "$wheatstone" --quiet paint $size/left.png $size/right.png -o painted_$size >/dev/null; done

printf '%-44s %7s %7s %7s %8s %6s\n' "command" "CPU s" "1 thr." "2 thr." "gain" "MB"
row "--version" "$wheatstone" --version
if [[ -n $data ]]; then
  for pair in teddy motorcycle; do
    [[ -d $data/stereo/$pair ]] || { echo "$pair: not here, left out"; continue; }
    files=("$data/stereo/$pair/left.png" "$data/stereo/$pair/right.png")
    row "paint $pair (impressionist)" "$wheatstone" paint "${files[@]}" --style impressionist -o out
    row "match $pair" "$wheatstone" match "${files[@]}" -o out
    has_python_with cv2 && rival "SGBM of OpenCV" python3 -c "
import cv2, sys
left, right = (cv2.imread(name) for name in sys.argv[1:])
cv2.StereoSGBM_create(0, 64, 3, 216, 864, mode=cv2.STEREO_SGBM_MODE_SGBM_3WAY).compute(left, right)" "${files[@]}"
  done
fi
row "paint 64x64" "$wheatstone" paint small/left.png small/right.png -o out
row "paint 1920x1080" "$wheatstone" paint hd/left.png hd/right.png -o out
row "paint 12 megapixels" "$wheatstone" paint large/left.png large/right.png -o out
row "  as JPEG" "$wheatstone" paint large/left.png large/right.png --format jpg -o out
row "quilt of 48 views" "$wheatstone" paint painted_hd/painting.wst --display looking-glass-portrait -o out
row "nine views of 1920x1080" "$wheatstone" pack painted_hd/painting.wst --views 9 -o out
row "nine views of a million particles" "$wheatstone" render universe.hdf5 --views 9 -o out
row "share 2 megapixels" "$wheatstone" share painted_hd/painting.wst -o out.html
row "share 12 megapixels" "$wheatstone" share painted_large/painting.wst -o out.html
row "info of a JPEG of 24 MP that holds two views" "$wheatstone" info large.jpg
has_python_with PIL && rival "PNG of 12 megapixels by zlib (Pillow)" python3 -c "
from PIL import Image
Image.open('large/left.png').save('out_pillow.png')"
command -v ffmpeg >/dev/null && rival "ffmpeg: JPEG to PNG" ffmpeg -y -loglevel error -i large.jpg out_ffmpeg.png
rival "dd of the particles" dd if=universe.hdf5 of=/dev/null bs=1M
