#!/usr/bin/env bash
# Writes the one C++ program that a page of the documentation shows to a file of its own.
#
#   cpp_program.sh PAGE OUTPUT
set -euo pipefail
programs=$(grep -c '^```cpp$' "$1" || true)
if [ "$programs" != 1 ]; then
  echo "$1: shows $programs C++ programs, expected one" >&2
  exit 1
fi
awk '/^```$/ { shown = 0 } shown { print } /^```cpp$/ { shown = 1 }' "$1" >"$2"
