# Shell functions that the scripts share; source it, it does nothing by itself.
# shellcheck shell=bash

footprint_root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)

# Says what is done next.
step() { printf '\n==> %s\n' "$*"; }

# Ends the script: what is wrong, and how to mend it.
die() {
  printf '%s: %s\n' "$(basename -- "$0")" "$*" >&2
  exit 3
}

# Runs a command as root: with sudo only where the user is not root.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    die "installing packages needs root: run \`scripts/setup\` as root once, then this script again"
  fi
}

# Configures a preset into build/PRESET. CMake reads its own cache, so a second run takes a moment.
configure() {
  step "Configuring build/$1"
  cmake --preset "$1" -S "$footprint_root"
}

# The C++ sources that git tracks, each with a trailing zero byte; all in the tree where there is no git checkout.
list_sources() {
  (
    cd -- "$footprint_root" || exit
    if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
      git ls-files -z -- '*.cpp' '*.hpp'
    else
      find app bench experiments methods renderer results tests \( -name '*.cpp' -o -name '*.hpp' \) -print0
    fi
  )
}

# Fails, naming files and lines, if a source is not laid out as .clang-format says.
check_format() {
  step "Checking the layout of the sources with clang-format"
  (cd -- "$footprint_root" && list_sources | xargs -0 -r clang-format --dry-run -Werror)
}
