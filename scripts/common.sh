# Shell functions that the scripts share; source it, it does nothing by itself.
# shellcheck shell=bash

footprint_root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)

# Prints the next step.
step() { printf '\n==> %s\n' "$*"; }

# Ends the script with a message: the fault and its remedy.
die() {
  printf '%s: %s\n' "$(basename -- "$0")" "$*" >&2
  exit 3
}

# Runs a command as root, by sudo if the user is not root.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    die "installing packages needs root: run \`scripts/setup\` as root once, then this script again"
  fi
}

# configure PRESET [ARGUMENT...]: configures a preset of CMakePresets.json. CMake reads its own cache, so a second run
# takes a moment.
configure() {
  step "Configuring: $1"
  cmake --preset "$@" -S "$footprint_root"
}

# first_command NAME...: prints the first that is installed.
first_command() {
  local name
  for name in "$@"; do
    if command -v "$name" >/dev/null; then
      printf '%s\n' "$name"
      return
    fi
  done
  die "none of these is installed: $*"
}

# list_sources [PATH...]: the C++ sources that git tracks, or all without a git checkout, each followed by a zero byte;
# of all folders, or of the files and folders named, relative to the root.
list_sources() {
  (
    cd -- "$footprint_root" || exit
    [ $# -gt 0 ] || set -- app bench experiments methods renderer results scenes scripts tests
    if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
      git ls-files -z -- "$@"
    else
      find "$@" -type f -print0
    fi | sed -nz '/\.[ch]pp$/p'
  )
}

# check_format [PATH...]: fails, naming files and lines, if a source is not formatted by .clang-format. Versions of
# clang-format differ in details: the layout is that of Debian 12's, 14, and others are not asked.
check_format() {
  if ! clang-format --version | grep -q 'version 14\.'; then
    step "The layout of the sources is not checked: it is that of clang-format 14, and this is $(clang-format --version)"
    return
  fi
  step "Checking the layout of the sources with clang-format"
  (cd -- "$footprint_root" && list_sources "$@" | xargs -0 -r clang-format --dry-run -Werror)
}

# expect_output FOLDER PROGRAM: dies unless the folder has all files of a comparison at distance 1.
expect_output() {
  local file
  for file in results.json results.csv table.md index.html images/d1_all.png; do
    [ -s "$1/$file" ] || die "$2 left no $file"
  done
}
