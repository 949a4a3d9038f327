#!/usr/bin/env bash
# Tests shared pages in a browser without a window. Ends with 77, after a line that says why, where there is none.
#
#   run.sh WHEATSTONE FOLDER [all]    the program, a folder for what is made, and whether tests that take long run, too
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
if ! command -v chromium-headless-shell >/dev/null || ! command -v node >/dev/null; then
  echo "page: skipped, chromium-headless-shell or node is not installed (scripts/install-deps)"
  exit 77
fi
if [[ ! -d $here/node_modules/playwright-core ]]; then
  echo "page: skipped, page/test/node_modules is not there (scripts/install-deps)"
  exit 77
fi
rm -rf "$2" && mkdir -p "$2"
exec node "$here/browser_test.mjs" "$(realpath "$1")" "$(realpath "$2")" "${3:-some}"
