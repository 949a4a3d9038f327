#!/usr/bin/env bash
# Runs the program that the documentation shows on a small pair, and reads what it writes.
#
#   run_library_example.sh PROGRAM WHEATSTONE SCRATCH_FOLDER
set -euo pipefail
program=$1 wheatstone=$2 scratch=$3
rm -rf "$scratch"
"$wheatstone" synth still -o "$scratch" --size 96x64 --quiet
cd "$scratch"
"$program"
for result in left_painted.png right_painted.png painting.wst; do
  "$wheatstone" info "$result"
done
