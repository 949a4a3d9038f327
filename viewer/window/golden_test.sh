#!/usr/bin/env bash
# Each output mode and each panel, without a screen, must look as in the pictures that are kept in golden/.
#
#   golden_test.sh WHEATSTONE_VIEW WHEATSTONE [--keep]
#
# --keep makes the kept pictures anew; look at them before they are committed.
set -euo pipefail
view=$1 wheatstone=$2 keep=${3-}
kept=$(cd "$(dirname "$0")" && pwd)/golden
if ! command -v oiiotool >/dev/null; then
  echo "golden_test: oiiotool is not installed, so that pictures are not compared"
  exit 0
fi
source "$(dirname "$0")/scratch_folder.sh"

"$wheatstone" synth still --size 64x48 --samples 1 -o still --quiet >made.txt
"$wheatstone" pack still/left.png still/right.png --to quilt --quilt 2x1 -o pair --quiet >made.txt
"$wheatstone" paint still/left.png still/right.png --style impressionist -o painted --quiet >made.txt

printf '%s\n' 'x y z' '0 0 0' '1 0 0' '0 1 0' '0 0 1' '1 1 1' >points.txt

# The modes, of two photographs that nothing draws anew: only how both come onto the screen is seen.
"$view" --mode none --script /dev/null 2>names.txt || true
mapfile -t modes < <(sed 's/.*expected one of: //; s/, /\n/g' names.txt | grep --invert-match --line-regexp page-flip)
[[ ${#modes[@]} -gt 20 ]] || fail "the modes are not known: $(cat names.txt)"
{
  printf '%s\n' 'resize 640 480' wait 'screenshot start.png' 'theme dark' wait 'screenshot start-dark.png' 'theme light' 'resize 64 132' 'display barrier-2' "open $(echo pair_qs*.png)" wait
  for mode in "${modes[@]}"; do
    printf '%s\n' "mode $mode" wait "save-picture $mode.mode.png"
  done
  printf '%s\n' 'resize 640 480' 'mode red-cyan' information wait 'screenshot information.png' information \
    'panel style' wait 'screenshot style.png' 'panel depth' 'depth-mapping 0:-40,0.3:-20,0.6:20,1:50' wait \
    'screenshot depth.png' 'theme dark' wait 'screenshot depth-dark.png' 'panel style' wait 'screenshot style-dark.png' \
    'theme light' 'panel off' 'open painted/painting.wst' wait 'layers-apart 40' wait 'screenshot layers.png' \
    'layers-apart off' 'open points.txt' wait 'panel particles' wait 'screenshot particles.png'
} >tour.txt
"$view" --script tour.txt
oiiotool "${modes[@]/%/.mode.png}" --mosaic 6x$(((${#modes[@]} + 5) / 6)) -o modes.png
# Text is drawn a little differently by other fonts: of panels, a reduced picture is compared.
panels=()
for panel in start start-dark information style style-dark depth depth-dark layers particles; do
  oiiotool "$panel.png" --resize 160x0 -o "$panel-reduced.png"
  panels+=("$panel-reduced")
done

if [[ $keep == --keep ]]; then
  for picture in modes "${panels[@]}"; do cp "$picture.png" "$kept/$picture.png"; done
  exit 0
fi
oiiotool --fail 0.012 --failpercent 0.02 --hardfail 0.012 --diff modes.png "$kept/modes.png" >difference.txt ||
  fail "an output mode looks different: $(cat difference.txt)"
# looks_as PICTURE KEPT: few pixels differ by more than a tenth. Where the strokes of a painting lie may change a little.
looks_as() {
  local percent=2
  if [[ $1 == layers* ]]; then percent=10; fi
  oiiotool --fail 0.1 --failpercent $percent --hardfail 1 --diff "$1.png" "$kept/$2.png" >difference.txt
}
for panel in "${panels[@]}"; do
  looks_as "$panel" "$panel" || fail "${panel%-reduced} looks different: $(cat difference.txt)"
done
if looks_as style-reduced depth-reduced; then fail "another panel does not look different"; fi
