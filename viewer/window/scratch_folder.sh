# For tests of the window that source it: an empty folder to work in, which is removed at the end; no screen; and `fail`.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
unset DISPLAY WAYLAND_DISPLAY QT_QPA_PLATFORM
export XDG_RUNTIME_DIR=$folder

fail() {
  echo "$(basename "$0" .sh): $1" >&2
  exit 1
}
