#!/usr/bin/env bash
# A subject's session in the window, with real keys: killed, resumed, data complete. With `long`, all 78 trials of the
# built-in design, killed twice.
#
#   study_test.sh WHEATSTONE [long]
set -euo pipefail
wheatstone=$1 length=${2:-short}
if ! command -v Xvfb >/dev/null || ! command -v xdotool >/dev/null; then
  echo "study_test: Xvfb or xdotool is not installed, so that a session is not tested"
  exit 0
fi
source "$(dirname "$0")/scratch_folder.sh"
server='' session=''
end() {
  if [[ -n $session ]]; then kill -KILL "$session" 2>/dev/null || true; fi
  if [[ -n $server ]]; then kill "$server" 2>/dev/null || true; fi
  wait 2>/dev/null || true
  rm -rf "$folder"
}
trap end EXIT

# Without -noreset the server begins anew, and ends new connections, whenever its last program leaves: xdotool does so
# while the window opens.
Xvfb -displayfd 3 -noreset -screen 0 480x360x24 -nolisten tcp 3>display.txt 2>xvfb.txt &
server=$!
for _ in {1..200}; do
  [[ -s display.txt ]] && break
  sleep 0.02
done
[[ -s display.txt ]] || fail "there is no screen: $(cat xvfb.txt)"
DISPLAY=:$(cat display.txt)
export DISPLAY

if [[ $length == long ]]; then
  design=path-searching-1 trials=78 kills='20 50'
else
  design=small.toml trials=6 kills=3
  cat >small.toml <<'END'
name = "small"
task_label = "paths"
subjects = 2
repetitions = 3
practice = 1
break_every = 4
[shown]
nodes = 30
[[factor]]
name = "views_per_10cm"
levels = [0, 8]
[texts]
instruction = "Is there a path of two tubes between the red balls?"
[[question]]
name = "tired"
text = "Are you tired?"
END
fi
table=data/sub-02/beh/sub-02_task-paths_beh.tsv

begin() {
  "$wheatstone" study run "$design" --subject 2 --screen-width 30cm -o data >>told.txt 2>err.txt &
  session=$!
  for _ in {1..500}; do
    window=$(xdotool search --onlyvisible --name '^Wheatstone$' 2>/dev/null | head -1 || true)
    [[ -n $window ]] && break
    kill -0 "$session" 2>/dev/null || fail "the session ended: $(cat err.txt)"
    sleep 0.02
  done
  [[ -n $window ]] || fail "there is no window: $(cat err.txt)"
  xdotool windowfocus --sync "$window" 2>/dev/null || xdotool windowfocus "$window"
}
done_trials() { if [[ -e $table ]]; then echo $(($(wc -l <"$table") - 1)); else echo 0; fi; }
# Presses keys, of which each page takes its own, until there are so many trials.
answer_until() {
  for _ in {1..2000}; do
    (($(done_trials) >= $1)) && return
    kill -0 "$session" 2>/dev/null || fail "the session ended after $(done_trials) trials: $(cat err.txt)"
    xdotool key --delay 4 space Right y
  done
  fail "only $(done_trials) trials of $1 were done"
}

for at in $kills; do
  begin
  answer_until "$at"
  # The window's program is the child of the one that was started.
  kill -KILL "$(pgrep --parent "$session")" || fail "there is no window's program"
  wait "$session" 2>/dev/null || true
done
printf 'half a li' >>"$table"
begin
answer_until "$trials"
for _ in {1..500}; do
  kill -0 "$session" 2>/dev/null || break
  xdotool key --delay 4 space 3 2>/dev/null || true
done
code=0
wait "$session" || code=$?
session=''
[[ $code == 0 ]] || fail "the session ended with $code: $(cat err.txt)"

[[ $(done_trials) == "$trials" ]] || fail "there are $(done_trials) trials: $(cat "$table")"
[[ $(tail -n +2 "$table" | cut -f 5 | sort -u | wc -l) == "$trials" ]] || fail "an item came twice: $(cat "$table")"
[[ $(tail -n +2 "$table" | cut -f 4 | tr '\n' ' ') == "$(seq -s ' ' 1 "$trials") " ]] || fail "trials are not counted through: $(cat "$table")"
if grep --quiet 'half a li' "$table"; then fail "a broken line stayed: $(cat "$table")"; fi
# Columns: response_time is the second, log_delay the last but one. A frame of this screen takes 1/60 s.
tail -n +2 "$table" | awk -F '\t' '$2 <= 0 || $2 > 60 { exit 1 }' || fail "a time cannot be: $(cat "$table")"
tail -n +2 "$table" | awk -F '\t' '{ print $(NF - 1) }' | sort -g >delays.txt
awk '{ d[NR] = $1 } END { exit !(d[int((NR + 1) / 2)] <= 1 / 60) }' delays.txt ||
  fail "the key comes to the log after: $(tr '\n' ' ' <delays.txt)"
grep --quiet "$trials trials done" told.txt || grep --quiet 'finished' told.txt || fail "the experimenter is told: $(cat told.txt)"
if grep --quiet -E 'yes|true|correct' told.txt; then fail "the experimenter sees answers: $(cat told.txt)"; fi
[[ $(awk -F '\t' 'END { print $2 }' data/phenotype/questionnaire.tsv) == 3 ]] || fail "the question's answer is missing"
"$wheatstone" study analyse data -o analysis --quiet >analysed.txt || fail "the data cannot be analysed"

code=0
"$wheatstone" study run painting-comfort -o data 2>err.txt || code=$?
[[ $code == 3 && $(wc -l <err.txt) == 1 ]] && grep --quiet 'another design' err.txt || fail "another design's data: $(cat err.txt)"
code=0
"$wheatstone" study run painting-comfort -o pictures 2>err.txt || code=$?
[[ $code == 3 && $(wc -l <err.txt) == 1 ]] && grep --quiet 'this stimulus is missing' err.txt || fail "a missing stimulus: $(cat err.txt)"
code=0
"$wheatstone" study run "$design" -o data --mode left-right 2>err.txt || code=$?
[[ $code == 2 ]] && grep --quiet 'fills the screen' err.txt || fail "a mode of small pictures: $(cat err.txt)"
