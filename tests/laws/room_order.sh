#!/usr/bin/env bash
# A room includes only what stands above it, in programs of a graphics processor, too; and an installed header only the standard library and our own headers.
# A header that ends in _internal.h is its own room's alone. One that ends in _opencv.h is for all rooms, and is not
# installed, because it shows OpenCV's types.
# What plans and draws marks does not see the measures that judge it, although they stand above it.
# Tests are free: they use scenes with exact truth and measures that stand below what they test.
# The order is the list of rooms in CMakeLists.txt of the folder given.
#
#   room_order.sh src/wheatstone
set -euo pipefail
cd "$1"

mapfile -t rooms < <(sed -n 's/^add_subdirectory(\([a-z]*\)).*/\1/p' CMakeLists.txt)
if ((${#rooms[@]} == 0)); then
  echo "room_order: no rooms in $1/CMakeLists.txt" >&2
  exit 1
fi

find . -name '*.h' -o -name '*.cpp' -o -name '*.comp' -o -name '*.glsl' | sort | xargs awk -v rooms="${rooms[*]}" '
  BEGIN {
    count = split(rooms, names, " ")
    for (i = 1; i <= count; i++) floor[names[i]] = i
    count = split("marks drawing strokes regions curves painting", names, " ")
    for (i = 1; i <= count; i++) judged[names[i]] = 1
  }
  function complain(why) {
    printf "%s:%d: %s\n", FILENAME, FNR, why
    failed = 1
  }
  # Files of no room (errors, progress) stand above all rooms.
  function floor_of(path, parts, depth) {
    depth = split(path, parts, "/")
    if (depth == 1) return 0
    return parts[1] in floor ? floor[parts[1]] : -1
  }
  FNR == 1 {
    file = substr(FILENAME, 3)
    here = floor_of(file)
    is_judged = substr(file, 1, index(file, "/") - 1) in judged
    if (here < 0) complain("is in a folder that is no room")
    installed = file ~ /\.h$/ && file !~ /_(internal|opencv)\.h$/
    room = substr(file, 1, index(file, "/"))
  }
  match($0, /^[ \t]*#[ \t]*include[ \t]*"wheatstone\/[^"]*"/) {
    path = $0
    sub(/^[^"]*"wheatstone\//, "", path)
    sub(/".*/, "", path)
    there = floor_of(path)
    if (there < 0) complain("includes " path ", which is in no room")
    if (there > here && file !~ /_test\.cpp$/) complain("includes " path ", which stands below it")
    if (is_judged && path ~ /^measures\// && file !~ /_test\.cpp$/) complain("includes " path ", which judges it")
    if (installed && path ~ /_(internal|opencv)\.h$/) complain("is installed, but includes " path)
    if (path ~ /_internal\.h$/ && index(path, room) != 1 && file !~ /_test\.cpp$/) complain("includes " path ", which is another room'\''s own")
    next
  }
  installed && match($0, /^[ \t]*#[ \t]*include[ \t]*[<"]/) && $0 !~ /<[a-z_]+>/ {
    complain("is installed, but includes what is neither ours nor the standard library'\''s: " $0)
  }
  END { exit failed }
'
