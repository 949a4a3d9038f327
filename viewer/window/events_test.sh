#!/usr/bin/env bash
# The window on a screen, with a mouse and a keyboard: what they do, told by the control socket.
#
#   events_test.sh WHEATSTONE_VIEW WHEATSTONE
set -euo pipefail
view=$1 wheatstone=$2
if ! command -v xvfb-run >/dev/null || ! command -v xdotool >/dev/null; then
  echo "events_test: Xvfb or xdotool is not installed, so that real events are not tested"
  exit 0
fi
folder=$(mktemp -d)
server='' window=''
end() {
  if [[ -n $window ]]; then kill "$window" 2>/dev/null || true; fi
  if [[ -n $server ]]; then kill "$server" 2>/dev/null || true; fi
  exec 8>&-
  wait
  rm -rf "$folder"
}
trap end EXIT
cd "$folder"
unset DISPLAY WAYLAND_DISPLAY QT_QPA_PLATFORM
export XDG_RUNTIME_DIR=$folder

fail() {
  echo "events_test: $1" >&2
  exit 1
}

# say LINE...: has the window do them, and prints the answers. One process asks for all of them: to start takes longer
# than to ask.
cat >say.pl <<'END'
use strict;
use IO::Socket::UNIX;
$SIG{PIPE} = 'IGNORE';
$| = 1;
my $socket;
while (my $line = <STDIN>) {
  my $answer;
  for (1, 2) {  # the window before this one has left a socket that is dead
    $socket //= IO::Socket::UNIX->new(Peer => 'control') or last;
    print $socket $line;
    $socket->flush;
    $answer = <$socket>;
    last if defined $answer;
    undef $socket;
  }
  print $answer // "nobody answers\n";
}
END
mkfifo asked told
perl say.pl <asked >told &
exec 8>asked 9<told
say() {
  local line answer
  for line; do
    printf '%s\n' "$line" >&8
    IFS= read -r answer <&9
    printf '%s\n' "$answer"
    if [[ $answer == 'nobody answers' ]]; then return 1; fi
  done
}
# does LINE...: has the window do them, and none may fail.
does() {
  say "$@" >answers.txt || fail "$* is not answered"
  if grep --quiet '^error' answers.txt; then fail "$* is answered by: $(cat answers.txt)"; fi
}

# is NAME VALUE: the state says so, at once or soon.
is() {
  local told=''
  for _ in {1..100}; do
    told=$(say print)
    if [[ $told =~ \"$1\":\"?([^,\"}]*) && ${BASH_REMATCH[1]} == "$2" ]]; then return; fi
    sleep 0.02
  done
  fail "$3: expected $1 to be $2: $told"
}
value() {
  local told
  told=$(say print)
  [[ $told =~ \"$1\":\"?([^,\"}]*) ]] || fail "$1 is not told: $told"
  echo "${BASH_REMATCH[1]}"
}
# start ARGUMENT...: the window with the painting, waited for.
start() {
  "$view" painted/painting.wst --control control --size 480x400 "$@" 2>errors.txt &
  window=$!
  for _ in {1..500}; do
    [[ -S control ]] && break
    sleep 0.02
  done
  say wait >answers.txt || fail "the window does not answer: $(cat errors.txt)"
}

"$wheatstone" synth still --size 160x120 --samples 1 -o still --quiet >made.txt
"$wheatstone" paint still/left.png still/right.png -o painted --quiet >made.txt

# A screen of its own, whose number the server chooses.
mkfifo number
# Without -noreset the server begins anew, and ends new connections, whenever its last program leaves: xdotool does so
# while the window opens.
Xvfb -displayfd 3 -noreset -screen 0 1280x800x24 -nolisten tcp 3>number 2>server.txt &
server=$!
read -r number <number
export DISPLAY=:$number

# Stereo by the graphics card is not guessed: it is there, or one line says that it is not.
code=0
"$view" painted/painting.wst --stereo --mode page-flip --script /dev/null 2>errors.txt || code=$?
[[ $code == 4 && $(wc -l <errors.txt) == 1 ]] && grep --quiet 'has no stereo' errors.txt ||
  fail "without stereo it ends with $code: $(cat errors.txt)"

start --opengl
is opengl 1.0 "OpenGL is used"
x=$(value screen_x) y=$(value screen_y)
x=${x%.*} y=${y%.*}
xdotool search --sync --class wheatstone windowfocus >found.txt 2>&1 || xdotool search --class '' >found.txt 2>&1 || true

# point X Y: moves the pointer to that pixel of the picture.
point() { xdotool mousemove $((x + $1)) $((y + $2)); }

# A click is what zero-parallax-at does there.
does 'zero-parallax 0' wait 'zero-parallax-at 240 150' wait
expected=$(value zero_parallax_px)
does 'zero-parallax 0' wait
point 240 150
xdotool click 1
is zero_parallax_px "$expected" "a click sets zero parallax"

# Dragging moves the picture with the pointer.
does actual-size wait
point 200 150
xdotool mousedown 1
point 210 150
point 230 160
xdotool mouseup 1
is pan_x -30.0 "dragging moves the picture"
is pan_y -10.0 "dragging moves the picture"
is zero_parallax_px "$expected" "dragging is no click"

# The wheel zooms, and so do keys.
point 100 100
xdotool click 4
is zoom 1.25 "the wheel zooms in"
xdotool click 5
is zoom 1.0 "the wheel zooms out"
xdotool key 0
is zoom 0.0 "0 fits the picture in"
xdotool key 1
is zoom 1.0 "1 shows the picture as large as it is"
xdotool key 0

xdotool key w
is swap true "W swaps the eyes"
xdotool key w
is swap false "W swaps them again"
mode=$(value mode)
xdotool key t
[[ $(value mode) != "$mode" ]] || sleep 0.2
[[ $(value mode) != "$mode" ]] || fail "T does not change the mode"
xdotool key shift+t
is mode "$mode" "Shift+T changes the mode back"
xdotool key i
is information true "I tells of what is open"
xdotool key i
is information false "I ends that"
xdotool key question
is help true "? shows all keys"
xdotool key question
is help false "? hides them"
xdotool keydown c
is compare photograph "C shows the photograph"
xdotool keyup c
is compare painting "C shows it as long as it is held"
xdotool key f
is full_screen true "F shows the full screen"
is width 1280.0 "the full screen is as wide as the screen"
xdotool key Escape
is full_screen false "Esc leaves it"
is width 480.0 "the window is as wide as before"
[[ $(say 'full-screen-on 2') == 'error: full-screen-on: there is no screen 2, expected 1 to 1' ]] || fail "there is a second screen"
[[ $(say 'mode page-flip') == error:*--stereo* ]] || fail "page-flip works without --stereo"

# What OpenGL shows is what is shown without a screen, but for the text below it.
does 'mode left-right' 'resize 480 400' wait copy-command 'screenshot onscreen.png'
printf '%s\n' 'resize 480 400' wait 'mode left-right' "zero-parallax $expected" wait copy-command 'screenshot offscreen.png' >tour.txt
(unset DISPLAY && "$view" painted/painting.wst --script tour.txt) || fail "the window without a screen fails"
for place in offscreen onscreen; do oiiotool "$place.png" --cut 480x290+0+60 -o "$place-picture.png"; done
"$wheatstone" measure views offscreen-picture.png --against onscreen-picture.png --noticeable 8 >difference.txt
grep --quiet --extended-regexp '^offscreen-picture.png +equal' difference.txt ||
  fail "OpenGL shows something else: $(cat difference.txt)"

# A brush that is dragged touches all along, and is undone as a whole.
does 'open still/left.png still/right.png' 'mode left' 'retouch nearer' 'brush-radius 10' wait
point 150 120
xdotool mousedown 1
for step in 170 190 210 230 250; do point "$step" 130; done
xdotool mouseup 1
does wait
touches=$(value touches)
((${touches%.*} > 1)) || fail "a dragged brush makes $touches touches"
is pan_x 0.0 "the brush moves no picture"
xdotool key ctrl+z
is touches 0 "undo takes back the whole stroke"
does 'retouch off' 'open painted/painting.wst' wait "zero-parallax $expected"

# Each row of the screen stays the same eye's when the window is moved by a pixel.
does 'mode left' wait 'save-picture left.png' 'mode right' wait 'save-picture right.png' 'mode even-odd-rows'
"$wheatstone" pack left.png right.png --to even-odd-rows -o even.png --quiet >made.txt
"$wheatstone" pack right.png left.png --to even-odd-rows -o odd.png --quiet >made.txt
id=$(xdotool search --pid "$window" --onlyvisible | head -1)
for top in 40 41; do
  before=$(value screen_y)
  xdotool windowmove --sync "$id" 30 "$top"
  for _ in {1..30}; do  # the window learns of it a little later
    [[ $(value screen_y) != "$before" ]] && break
    sleep 0.1
  done
  top_of_picture=$(value screen_y)
  does wait "save-picture moved-$top.png"
  rows=even
  if ((${top_of_picture%.*} % 2 != 0)); then rows=odd; fi
  "$wheatstone" measure views "moved-$top.png" --against "$rows.png" >difference.txt
  grep --quiet --extended-regexp "^moved-$top.png +equal" difference.txt ||
    fail "at row $top_of_picture of the screen the rows are not the eyes' they were: $(cat difference.txt)"
  echo "${top_of_picture%.*}" >>tops.txt
done
[[ $(uniq tops.txt | wc -l) == 2 ]] || fail "the window has not moved: $(cat tops.txt)"

xdotool key Escape
say print >answers.txt || fail "Esc ends the window"

xdotool key q
code=0
wait "$window" || code=$?
window=''
[[ $code == 0 ]] || fail "Q ends the window with $code: $(cat errors.txt)"
[[ ! -e control ]] || fail "the socket is left behind"

# Where the processor computes OpenGL, pictures are shown without it. No handler then blocks the window for more than
# 50 ms: never by its own work, and by the clock not at three quarters of the times, because the machine may do
# something else.
"$wheatstone" synth still --size 320x240 --samples 1 -o photograph --quiet >made.txt
start
is opengl 0.0 "OpenGL by the processor is not used"
for line in 'open photograph/left.png photograph/right.png' full-screen 'mode left-right' full-screen 'panel depth' \
  'depth-mapping 0:-40,1:60' 'zero-parallax-at 200 150' 'gaze 300 200' 'panel style' 'style mosaic' 'panel off' \
  'head 0.3' 'zoom-at 3 240 200' 'open painted/painting.wst' 'layers-apart 30'; do
  does "$line" wait
  echo "$line $(say print)" >>blocked.txt
done
sed --regexp-extended 's/^(.*) \{.*"worst_gap_ms":([0-9.]+),"worst_busy_ms":([0-9.]+).*/\2 \3 \1/' blocked.txt |
  sort --general-numeric-sort >sorted.txt
most_ms=50
if ldd "$view" | grep --quiet libasan; then most_ms=200; fi  # checks of memory slow the work
awk -v most_ms="$most_ms" '{ gap[NR] = $1; if ($2 > most_ms) { print $0; failed = 1 } }
  END { gap_ms = gap[int(0.75 * NR)]; print gap_ms; exit failed || gap_ms > most_ms }' sorted.txt >worst.txt ||
  fail "the window was blocked (by the clock, by its own work, by what): $(cat worst.txt sorted.txt)"
kill -TERM "$window"
wait "$window" || true
window=''

# The mode and the files stay from one session to the next, but for scripts. The title tells when a file is open.
export XDG_CONFIG_HOME=$folder/kept
kept_file=$XDG_CONFIG_HOME/Wheatstone/wheatstone-view.conf
for _ in 1 2; do
  "$view" painted/painting.wst --size 480x400 2>errors.txt &
  window=$!
  xdotool search --sync --onlyvisible --all --pid "$window" --name '^painting.wst ' >found.txt
  xdotool windowfocus --sync "$(head -1 found.txt)" key t key q
  wait "$window" || fail "a session without a script ends with $?: $(cat errors.txt)"
  window=''
  grep '^mode=' "$kept_file" >>modes.txt || fail "the mode is not kept: $(cat "$kept_file")"
  grep --quiet "^recent=$folder/painted/painting.wst$" "$kept_file" || fail "the file is not kept: $(cat "$kept_file")"
done
[[ $(uniq modes.txt | wc -l) == 2 ]] || fail "the mode that was kept is not brought back: $(cat modes.txt)"

# Without any OpenGL the window says so; a signal ends the window in order.
export QT_XCB_GL_INTEGRATION=none
start
is opengl 0.0 "OpenGL is not used"
[[ $(value message) == *'the processor draws instead' ]] || fail "it is not told why: $(value message)"
does 'mode left-right' "zero-parallax $expected" 'resize 480 400' wait copy-command 'screenshot painted.png'
oiiotool painted.png --cut 480x290+0+60 -o painted-picture.png
"$wheatstone" measure views painted-picture.png --against onscreen-picture.png --noticeable 8 >difference.txt
grep --quiet --extended-regexp '^painted-picture.png +equal' difference.txt ||
  fail "without OpenGL something else is shown: $(cat difference.txt)"
kill -TERM "$window"
code=0
wait "$window" || code=$?
window=''
[[ $code == 5 && ! -e control ]] || fail "a signal ends the window with $code"
