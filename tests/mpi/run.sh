#!/usr/bin/env bash
# Processes that mpirun starts give the same bytes as one process, end with one error, and leave nothing half-written.
# Ends with 77 where there is no mpirun.
#
#   run.sh WHEATSTONE some|all     with a few numbers of ranks and threads, or with all
set -euo pipefail
wheatstone=$(realpath "$1")
if ! command -v mpirun >/dev/null; then
  echo "mpi: skipped, mpirun is not installed"
  exit 77
fi
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

folder=$(mktemp --directory)
trap 'rm --recursive --force "$folder"' EXIT
cd "$folder"
on_ranks() { mpirun --oversubscribe --bind-to none -n "$1" "$wheatstone" "${@:2}"; }
complain() {
  echo "mpi: $*" >&2
  exit 1
}

"$wheatstone" --quiet synth universe --particles 20000 -o universe.hdf5
render=(render universe.hdf5 --size 160x120 --views 3 --projection orthographic --stream --chunk 3000)
pictures=("${render[@]}" --method layered)
numbers=("${render[@]}" --method exact)
"$wheatstone" "${pictures[@]}" -o one --save-slices one.exr >/dev/null
"$wheatstone" "${numbers[@]}" -o exact --values exact.npy >/dev/null

# A film of three scenes, from cut to cut, of three frames each.
mkdir film
for scene in still-life beams; do
  "$wheatstone" --quiet synth film --scene "$scene" --size 96x64 --frames 3 --cut 0 --samples 1 -o "$scene"
done
for eye in left right; do
  for i in 0 1 2; do
    cp "still-life/${eye}_000$i.png" "film/${eye}_000$i.png"
    cp "beams/${eye}_000$i.png" "film/${eye}_000$((3 + i)).png"
    cp "still-life/${eye}_000$i.png" "film/${eye}_000$((6 + i)).png"
  done
done
film=(rotoscope film --preset ultrafast --checkpoint 4)
"$wheatstone" "${film[@]}" --json -o one.mp4 --save-marks one_%d.wst >one.json
grep --quiet '"scenes": 3' one.json || complain "the film of three scenes has others: $(cat one.json)"

cases=("2 1" "3 2")
if [[ $2 == all ]]; then cases=("1 1" "1 2" "2 1" "2 2" "3 1" "3 2" "4 1" "4 2"); fi
for case in "${cases[@]}"; do
  read -r ranks threads <<<"$case"
  on_ranks "$ranks" "${pictures[@]}" --threads "$threads" --json -o many --save-slices many.exr >many.json
  [[ $(grep --count "\"ranks\": $ranks" many.json) == 1 ]] || complain "--json does not tell of $ranks ranks"
  diff --recursive one many || complain "pictures of $ranks ranks with $threads threads differ"
  cmp one.exr many.exr || complain "slices of $ranks ranks with $threads threads differ"
  on_ranks "$ranks" "${numbers[@]}" --threads "$threads" -o many --values many.npy >/dev/null
  diff --recursive exact many || complain "exact pictures of $ranks ranks with $threads threads differ"
  for view in 000 001 002; do
    cmp "exact_$view.npy" "many_$view.npy" || complain "numbers of $ranks ranks with $threads threads differ"
  done
  rm --recursive many many*.exr many_*.npy
  on_ranks "$ranks" "${film[@]}" --threads "$threads" --json -o many.mp4 --save-marks many_%d.wst >many.json
  cmp one.mp4 many.mp4 || complain "the film of $ranks ranks with $threads threads differs"
  for frame in {1..9}; do cmp "one_$frame.wst" "many_$frame.wst" || complain "marks of $ranks ranks differ"; done
  for fact in scenes strokes_a_frame worst_bare_share survival moved_frames notes; do
    [[ $(grep "\"$fact\"" one.json) == "$(grep "\"$fact\"" many.json)" ]] || complain "$ranks ranks tell another $fact"
  done
  [[ $(grep --count "\"ranks\": $ranks" many.json) == 1 ]] || complain "--json does not tell of $ranks ranks"
  rm many.mp4 many_*.wst
done

# What only one of the ranks can know is told once, with the code of a single process.
{
  echo "x y z"
  for ((i = 0; i < 5000; i++)); do echo "1 2 $((i % 7))"; done
  echo "1 2 here"
} >damaged.txt
code=0
on_ranks 2 render damaged.txt --stream --chunk 3000 -o damaged >said 2>&1 || code=$?
[[ $code == 3 ]] || complain "a damaged file ends with $code, expected 3"
[[ $(grep --count "^wheatstone: damaged.txt" said) == 1 ]] || complain "a damaged file is not told of once: $(cat said)"
[[ ! -e damaged ]] || complain "a damaged file leaves an output"

# Another command works in one process and says so.
code=0
on_ranks 2 info universe.hdf5 >said 2>&1 || code=$?
[[ $code == 2 && $(grep --count "^wheatstone: mpirun started 2 processes" said) == 1 ]] ||
  complain "info under mpirun ends with $code: $(cat said)"

# Whether a process has come so far that it ends itself when it is told to.
catches_term() {
  local caught
  caught=$(sed --quiet 's/^SigCgt:\s*//p' "/proc/$1/status" 2>/dev/null) && ((16#$caught & 1 << 14))
}

# A run that is told to end does, says so once, and leaves nothing.
#   stop WHOM SIGNAL ARGUMENTS...     WHOM: mpirun, or the first or the last rank; the exit code is left in `code`
stop() {
  mpirun --oversubscribe --bind-to none -n 2 "$wheatstone" "${@:3}" -o killed.mp4 >said 2>&1 &
  local run=$! ranks=()
  for ((i = 0; i < 300 && ${#ranks[@]} < 2; i++)); do
    sleep 0.1
    mapfile -t ranks < <(pgrep --parent "$run" --exact wheatstone | while read -r rank; do
      catches_term "$rank" && echo "$rank"
    done)
  done
  [[ ${#ranks[@]} == 2 ]] || complain "no two ranks were started: $(cat said)"
  sleep 0.2
  case $1 in
    mpirun) kill "-$2" "$run" ;;
    first) kill "-$2" "${ranks[0]}" ;;
    last) kill "-$2" "${ranks[1]}" ;;
  esac || complain "the run had ended: $(cat said)"
  code=0
  wait "$run" || code=$?
  [[ $code != 0 ]] || complain "a run that was stopped ($1, $2) ends with 0"
  [[ $(grep --count "^wheatstone: interrupted; nothing half-written is left" said) == 1 ]] ||
    complain "a run that was stopped ($1, $2) does not say so once: $(cat said)"
  sleep 0.5
  [[ -z $(find . -name '*killed*') ]] || complain "a run that was stopped ($1, $2) leaves $(find . -name '*killed*')"
}
slow_views=(render universe.hdf5 --method exact --views 900 --size 640x360)
stop last KILL "${slow_views[@]}"
if [[ $2 == all ]]; then
  for i in {9..40}; do for eye in left right; do cp "film/${eye}_0000.png" "film/$(printf '%s_%04d' "$eye" "$i").png"; done; done
  for run in "${slow_views[*]}" "rotoscope film --save-marks killed_%d.wst"; do
    read -ra words <<<"$run"
    stop last KILL "${words[@]}"
    for rank in first last; do
      stop "$rank" TERM "${words[@]}"
      [[ $code == 5 ]] || complain "a run whose $rank rank is told to end ends with $code, expected 5"
    done
    for signal in INT TERM HUP; do stop mpirun "$signal" "${words[@]}"; done
  done
fi
echo "mpi: as one process"
