#!/usr/bin/env bash
# Has zsh and fish themselves read their completions and complete words. Skips a shell that is not installed.
#
#   completions_test.sh FOLDER_OF_COMPLETIONS
set -euo pipefail
described=$1
export HOME
HOME=$(mktemp --directory)
trap 'rm -rf "$HOME"' EXIT

# expect SHELL TYPED EXPECTED COMPLETIONS...
expect() {
  local shell=$1 typed=$2 expected=$3
  shift 3
  grep --quiet --fixed-strings -- "$expected" <<<"$*" && return
  echo "$shell completes '$typed' by '$*', expected '$expected' among it" >&2
  exit 1
}

# What fish offers behind a beginning.
in_fish() {
  fish --no-config --command "source '$described/fish/wheatstone.fish'; complete --do-complete '$1'"
}

# What zsh makes of a beginning when somebody types it and presses the tabulator: a terminal is needed for that.
in_zsh() {
  timeout 20 zsh -f -c '
    zmodload zsh/zpty
    zpty shell zsh -f -i
    zpty -w shell "PS1= RPS1= TERM=dumb; fpath=($1 \$fpath); autoload -U compinit; compinit -u -D; bindkey \"^I\" complete-word"
    zpty -w shell "LISTMAX=0; zle_bracketed_paste=(); setopt no_beep; print re\"ady\""
    while zpty -r shell line; do [[ $line == ready* ]] && break; done
    zpty -w -n shell "wheatstone $2"$'"'\\t'"'
    zpty -r -m shell line "*$3*"
    zpty -d shell
    print -r -- "$line"' zsh "$described/zsh" "$1" "$2"
}

ran=0
if command -v fish >/dev/null; then
  ran=1
  fish --no-execute "$described/fish/wheatstone.fish"
  expect fish 'wheatstone pai' paint "$(in_fish 'wheatstone pai')"
  expect fish 'wheatstone measure ' stereo "$(in_fish 'wheatstone measure ')"
  expect fish 'wheatstone paint --sty' --style "$(in_fish 'wheatstone paint --sty')"
fi
if command -v zsh >/dev/null; then
  ran=1
  zsh -n "$described/zsh/_wheatstone"
  expect zsh "wheatstone pai" "wheatstone paint" "$(in_zsh pai "wheatstone paint" || true)"
  expect zsh "wheatstone paint --styl" "paint --style" "$(in_zsh "paint --styl" "paint --style" || true)"
fi
if ((ran == 0)); then exit 77; fi
