#!/usr/bin/env bash
# Who answers for the packages: what the build takes for the maintainer, and that the placeholder is never passed on.
#
#   maintainer_test.sh CMAKE
set -euo pipefail
cmake=$1
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp --directory)
trap 'rm -rf "$scratch"' EXIT
unset DEBFULLNAME DEBEMAIL

printf 'include("%s/maintainer.cmake")\nmessage("${WHEATSTONE_MAINTAINER}")\n' "$here" >"$scratch/tell.cmake"

# expect WANTED GOT: GOT contains WANTED.
expect() {
  grep --quiet --fixed-strings -- "$1" <<<"$2" && return
  echo "maintainer_test: got '$2', expected '$1' in it" >&2
  exit 1
}
tell() { env "$@" "$cmake" -P "$scratch/tell.cmake" 2>&1 || true; }

expect 'Wheatstone authors <wheatstone@example.org>' "$(tell A=)"
expect 'Some Name <some@mail.net>' "$(tell DEBFULLNAME='Some Name' DEBEMAIL=some@mail.net)"
expect 'Some Name <some@mail.net>' "$(tell DEBEMAIL='Some Name <some@mail.net>')"
expect 'Some Name <some@mail.net>' "$(tell DEBFULLNAME='Some Name' DEBEMAIL='Other Name <some@mail.net>')"
expect 'Wheatstone authors <wheatstone@example.org>' "$(tell DEBEMAIL=some@mail.net)"
chosen=-DWHEATSTONE_MAINTAINER='Chosen Name <chosen@mail.net>'
expect 'Chosen Name <chosen@mail.net>' \
  "$(DEBFULLNAME='Some Name' DEBEMAIL=some@mail.net "$cmake" "$chosen" -P "$scratch/tell.cmake" 2>&1)"
expect 'WHEATSTONE_MAINTAINER is "Name", expected "Name <mail>"' \
  "$("$cmake" -DWHEATSTONE_MAINTAINER=Name -P "$scratch/tell.cmake" 2>&1 || true)"

if ! command -v dpkg-deb >/dev/null; then exit 77; fi

# What check-packages says of a package. The first of the tools that it runs is replaced: it tells that it was reached.
mkdir -p "$scratch/tree/DEBIAN" "$scratch/tools" "$scratch/packages"
printf '#!/bin/sh\necho reached\nexit 1\n' >"$scratch/tools/lintian"
chmod +x "$scratch/tools/lintian"
check() {
  printf 'Package: small\nVersion: 1\nArchitecture: all\nMaintainer: %s\nDescription: small\n' "$1" >"$scratch/tree/DEBIAN/control"
  dpkg-deb --root-owner-group --build "$scratch/tree" "$scratch/packages/small.deb" >/dev/null
  PATH=$scratch/tools:$PATH "$here/../scripts/check-packages" "$scratch/packages" 2>&1 || echo "status $?"
}
accepted=$(check 'Some Name <some@mail.net>')
if [[ $accepted != $'reached\nstatus 1' ]]; then
  echo "maintainer_test: got '$accepted', expected that check-packages begins" >&2
  exit 1
fi
refused=$(check 'Wheatstone authors <wheatstone@example.org>')
expect 'small.deb: its maintainer is the placeholder "Wheatstone authors <wheatstone@example.org>"' "$refused"
expect '-DWHEATSTONE_MAINTAINER="Name <mail>"' "$refused"
expect 'status 1' "$refused"
if grep --quiet reached <<<"$refused" || (($(wc --lines <<<"$refused") != 2)); then
  echo "maintainer_test: got '$refused', expected one line and the status" >&2
  exit 1
fi
rm "$scratch/packages/small.deb"
expect 'holds no Debian packages' "$(PATH=$scratch/tools:$PATH "$here/../scripts/check-packages" "$scratch/packages" 2>&1 || true)"
