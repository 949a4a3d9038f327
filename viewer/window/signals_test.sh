#!/usr/bin/env bash
# Signals that reach the command line alone, the window's program alone, or both: the run ends within a second with code
# 5 and one line, and no process stays.
#
#   signals_test.sh WHEATSTONE_VIEW WHEATSTONE
set -euo pipefail
view=$1 wheatstone=$2
source "$(dirname "$0")/scratch_folder.sh"
started=()
end() {
  for process in "${started[@]}"; do kill -KILL -- "-$process" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$folder"
}
trap end EXIT
export QT_QPA_PLATFORM=offscreen
[[ -x $view ]] || fail "there is no $view"

"$wheatstone" synth still --size 160x120 -o still --quiet >made.txt
cat >small.toml <<'END'
name = "small"
task_label = "paths"
subjects = 2
repetitions = 3
[shown]
nodes = 30
[[factor]]
name = "views_per_10cm"
levels = [0, 8]
END

# Whether a process is there and has not ended.
is_running() { [[ -e /proc/$1/stat ]] && ! grep --quiet ') Z ' "/proc/$1/stat" 2>/dev/null; }

# Whether a process is the window's program, and has a handler for this signal: the shell has, too, before it becomes it.
watches() {
  [[ $(readlink "/proc/$1/exe" 2>/dev/null) == *wheatstone-view* ]] &&
    (((0x$(awk '/^SigCgt/ { print $2 }' "/proc/$1/status" 2>/dev/null || echo 0) >> $(($(kill -l "$2") - 1)) & 1) == 1))
}

# Starts a command in a process group of its own; sets parent and child, once the child has begun.
start() {
  set -m
  "$wheatstone" "$@" >out.txt 2>err.txt &
  parent=$!
  set +m
  started+=("$parent")
  child=
  for _ in {1..1000}; do
    child=$(pgrep --parent "$parent" || true)
    [[ -n $child ]] && watches "$child" HUP && break
    is_running "$parent" || fail "$* ended: $(cat err.txt)"
    sleep 0.02
  done
  [[ -n $child ]] || fail "$* has no window's program"
}

# expect_end WHAT CODE: the process that was started ends within a second with this code, and its child, too.
expect_end() {
  local begun code=0 took_ms
  begun=$(date +%s%N)
  wait "$parent" || code=$?
  took_ms=$((($(date +%s%N) - begun) / 1000000))
  [[ $code == "$2" ]] || fail "$1: ended with $code: $(cat err.txt)"
  ((took_ms < 1000)) || fail "$1: ended $took_ms ms after it was told to"
  for _ in {1..50}; do
    is_running "$child" || break
    sleep 0.02
  done
  if is_running "$child"; then fail "$1: the window's program stays"; fi
}

for signal in INT TERM HUP; do
  for target in parent child group; do
    for command in view run; do
      if [[ $command == view ]]; then
        start view still/left.png still/right.png --control control
      else
        rm -rf data
        start study run small.toml --subject 1 --screen-width 30cm -o data
      fi
      # At first amid the start, and then when the window waits for its user.
      [[ $target == parent && $signal == TERM ]] || sleep 0.5
      case $target in
        parent) kill -"$signal" "$parent" ;;
        child) kill -"$signal" "$child" ;;
        group) kill -"$signal" -- "-$parent" ;;
      esac
      expect_end "$command, $signal to the $target" 5
      [[ $(wc -l <err.txt) == 1 ]] || fail "$command, $signal to the $target: it says $(cat err.txt)"
      if compgen -G '.data.*' >/dev/null; then fail "$command, $signal to the $target: a half-made folder stays"; fi
    done
  done
done

# A parent that is killed ends its child.
start study run small.toml --subject 1 --screen-width 30cm -o data
sleep 0.5
kill -KILL "$parent"
expect_end 'the parent is killed' 137

# While a process of the window's program waits for the library of Looking Glass Bridge, which hangs: a pipe into which
# nobody writes stands for it.
export HOME=$folder XDG_CACHE_HOME=$folder/cache
mkdir -p .lgf/Bridge
mkfifo libbridge_inproc.so
echo '{"install_locations": [{"version": "2.10.0", "path": "'"$folder"'"}]}' >.lgf/Bridge/settings.json
printf '%s\n' 'screen bridge' wait >bridge.txt
for target in parent child group; do
  start view still/left.png still/right.png --script bridge.txt
  for _ in {1..250}; do
    hanging=$(pgrep --parent "$child" || true)
    [[ -n $hanging ]] && break
    sleep 0.02
  done
  [[ -n $hanging ]] || fail 'the window does not ask for the calibration of Bridge'
  sleep 0.2
  case $target in
    parent) kill -TERM "$parent" ;;
    child) kill -TERM "$child" ;;
    group) kill -TERM -- "-$parent" ;;
  esac
  expect_end "view that waits for Bridge, TERM to the $target" 5
  [[ $(wc -l <err.txt) == 1 ]] || fail "view that waits for Bridge, TERM to the $target: it says $(cat err.txt)"
  sleep 0.1
  if is_running "$hanging"; then fail "view that waits for Bridge, TERM to the $target: a process stays"; fi
done
"$view" --bridge-calibration screen.json 2>err.txt &
parent=$!
for _ in {1..1000}; do
  watches "$parent" ALRM && break
  sleep 0.02
done
kill -ALRM "$parent"
code=0
wait "$parent" || code=$?
[[ $code == 4 && $(cat err.txt) == 'wheatstone: Looking Glass Bridge does not answer' ]] || fail "Bridge that hangs ends with $code: $(cat err.txt)"

# Where no window can start, no folder is begun.
code=0
env -u DISPLAY -u WAYLAND_DISPLAY -u QT_QPA_PLATFORM "$wheatstone" study run small.toml -o unseen 2>err.txt || code=$?
[[ $code == 4 && ! -e unseen ]] || fail "a session without a screen ends with $code: $(ls -d unseen* 2>/dev/null) $(cat err.txt)"
code=0
"$wheatstone" study run small.toml -o unseen --subject 3 2>err.txt || code=$?
[[ $code == 3 && ! -e unseen ]] || fail "a subject that the design does not have ends with $code: $(cat err.txt)"

# A subject that is being tested is held.
start study run small.toml --subject 1 --screen-width 30cm -o held
for _ in {1..250}; do
  [[ -e held/sub-01/beh/sub-01_task-paths_beh.tsv ]] && break
  sleep 0.02
done
code=0
"$wheatstone" study run small.toml --subject 1 --screen-width 30cm -o held 2>second.txt >second_out.txt || code=$?
[[ $code == 2 ]] && grep --quiet 'another session writes it' second.txt || fail "a second session ends with $code: $(cat second.txt)"
is_running "$child" || fail 'the first session ended'
kill -TERM "$parent"
expect_end 'the first of two sessions' 5
