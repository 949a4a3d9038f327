#!/usr/bin/env bash
# The window's program, without a screen and, where Xvfb is installed, with one: the same picture, one line of error,
# the exit code of what went wrong.
#
#   window_test.sh WHEATSTONE_VIEW WHEATSTONE FOLDER_OF_A_BRIDGE
set -euo pipefail
view=$1 wheatstone=$2 bridge=$3
source "$(dirname "$0")/scratch_folder.sh"
unset DISPLAY WAYLAND_DISPLAY

"$wheatstone" synth still --size 160x120 --samples 1 -o still --quiet >made.txt
"$wheatstone" paint still/left.png still/right.png -o painted --quiet >made.txt

cat >tour.txt <<'END'
resize 480 400
wait
mode left-right
save-picture ignored.png
wait
screenshot WINDOW
print
END
sed 's/WINDOW/offscreen.png/' tour.txt >offscreen.txt
"$view" painted/painting.wst --script offscreen.txt >state.json
grep --quiet '"mode":"left-right"' state.json || fail "the state does not tell the mode: $(cat state.json)"
[[ -s offscreen.png ]] || fail "there is no picture of the window"


# Numbers are written as in English, whatever the user's language.
printf '%s\n' 'resize 900 700' wait 'panel style' wait 'screenshot PANEL' >panel.txt
for language in C de_DE.UTF-8; do
  sed "s/PANEL/panel-$language.png/" panel.txt >panel-$language.txt
  LANG=$language LC_ALL=$language "$view" painted/painting.wst --script panel-$language.txt >out.txt
done
cmp panel-C.png panel-de_DE.UTF-8.png || fail "the panel is another one in German"

if "$view" painted/missing.wst --script offscreen.txt >out.txt 2>err.txt; then fail "a missing file is no error"; fi
echo 'fly' >bad.txt
code=0
"$wheatstone" view painted/painting.wst --script bad.txt 2>err.txt || code=$?
[[ $code == 2 ]] || fail "a script that fails ends with $code"
[[ $(wc -l <err.txt) == 1 ]] && grep --quiet "bad.txt:1: 'fly' is no command" err.txt || fail "the error is: $(cat err.txt)"
code=0
"$wheatstone" view painted/painting.wst 2>err.txt || code=$?
[[ $code == 4 ]] && grep --quiet 'there is no screen' err.txt || fail "without a screen it ends with $code: $(cat err.txt)"
code=0
DISPLAY=:54321 "$wheatstone" view painted/painting.wst 2>err.txt || code=$?
[[ $code == 4 && $(wc -l <err.txt) == 1 ]] && grep --quiet "the screen ':54321' cannot be opened" err.txt ||
  fail "where the screen cannot be opened it ends with $code: $(cat err.txt)"

# The calibration of a Looking Glass comes from Bridge where that is installed.
export HOME=$folder XDG_CACHE_HOME=$folder/cache
code=0
"$view" --bridge-calibration screen.json 2>err.txt || code=$?
[[ $code == 4 && ! -e screen.json && $(wc -l <err.txt) == 1 ]] && grep --quiet 'Looking Glass Bridge cannot be loaded' err.txt ||
  fail "without Bridge it ends with $code: $(cat err.txt)"
mkdir -p .lgf/Bridge
cat >.lgf/Bridge/settings.json <<END
{"install_locations": [{"version": "2.9.1", "path": "/nowhere"}, {"version": "2.10.0", "path": "$bridge"}]}
END
"$wheatstone" view --bridge-calibration screen.json
"$wheatstone" pack still/left.png still/right.png --to lenticular --screen screen.json -o packed.png --quiet >made.txt
"$wheatstone" info packed.png | grep --quiet "^width: 320$" || fail "the calibration is not Bridge's: $(cat screen.json)"
for number in '"pitch": 50.5' '"slope": -6.5' '"center": 0.25' '"DPI": 128.0' '"flipSubp": true' '"invView": true'; do
  grep --quiet --fixed-strings -- "$number" screen.json || fail "$number is not in $(cat screen.json)"
done
printf '%s\n' 'screen bridge' wait 'mode lenticular' wait >bridge.txt
"$view" painted/painting.wst --script bridge.txt
cmp screen.json cache/wheatstone/looking-glass.json || fail "the window takes another calibration"

# The window ends at once, whatever is painted in it.
"$wheatstone" synth still --size 1200x900 --samples 1 -o large --quiet >made.txt
"$view" large/left.png large/right.png --control control 2>err.txt &
window=$!
for _ in {1..500}; do
  [[ -S control ]] && break
  sleep 0.01
done
[[ -S control ]] || fail "the window does not begin while a large photograph is read: $(cat err.txt)"
sleep 0.5
begun=$(date +%s%N)
kill -TERM "$window"
code=0
wait "$window" || code=$?
ended_ms=$((($(date +%s%N) - begun) / 1000000))
[[ $code == 5 && ! -e control ]] || fail "a signal ends the window with $code"
((ended_ms < 1000)) || fail "the window ended $ended_ms ms after it was asked to"

if ! command -v xvfb-run >/dev/null; then
  echo "window_test: Xvfb is not installed, so that the window on a screen is not tested"
  exit 0
fi
sed 's/WINDOW/onscreen.png/' tour.txt >onscreen.txt
xvfb-run --auto-servernum --server-args='-screen 0 1024x768x24' "$view" painted/painting.wst --script onscreen.txt >state.json
"$wheatstone" measure views offscreen.png --against onscreen.png --noticeable 8 >difference.txt
# Text may be drawn a little differently, the picture may not.
grep --quiet --extended-regexp '^offscreen.png +(equal|[3-9][0-9]\.)' difference.txt ||
  fail "the window on a screen looks different: $(cat difference.txt)"
