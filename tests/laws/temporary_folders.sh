#!/usr/bin/env bash
# The law of the tests' folders: no test writes beside TemporaryFolder, which removes what it made. Prints the lines
# that break it.
set -euo pipefail
tree=${1:?usage: temporary_folders.sh TREE}
! grep -rnE 'TempDir\(\)|temp_directory_path|tmpnam|mkdtemp' --include='*.cpp' --include='*.h' "$tree" |
  grep -v '/temporary_folder\.h:'
