#!/usr/bin/env bash
# Installs a build folder under a prefix, moves it, and uses it as whoever unpacked it would: from another folder, with
# the scenes that lie in it, its manual page and completions, and a method built against it.
#   installed_test.sh BUILD_FOLDER CMAKE [CMAKE_ARGUMENT ...]
set -euo pipefail

build_folder=$1 cmake=$2
shift 2
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
prefix=$work/moved
program=$prefix/bin/footprint

fail() {
  printf 'FAILED: %s\n' "$*" >&2
  exit 1
}

# Fails unless FILE contains TEXT.
expect() {
  grep -qF -- "$2" "$1" || fail "no \`$2\` in: $(head -c 2000 -- "$1")"
}

install_and_move() {
  "$cmake" --install "$build_folder" --prefix "$work/prefix" >"$work/log" 2>&1 || fail "$(tail -n 5 -- "$work/log")"
  mv -- "$work/prefix" "$prefix"
  cd /
}

# It lists what is next to it: a scene that is removed disappears.
run_program() {
  "$program" list scenes >"$work/scenes"
  expect "$work/scenes" "  ribbed_plane"
  expect "$work/scenes" "  carved_disk"
  rm -r -- "$prefix/share/footprint/scenes/carved_disk"
  "$program" list scenes >"$work/scenes"
  if grep -qF carved_disk "$work/scenes"; then fail "scenes are not those of the installed tree"; fi
  "$program" list experiments >"$work/experiments"
  expect "$work/experiments" "  tan2005_fig4"
  "$program" render ribbed_plane --method direct --size 32x32 -o "$work/picture.exr" >"$work/log"
  [ -s "$work/picture.exr" ] || fail "no picture"
}

# Manual pages, completions and documents are complete.
look_at_texts() {
  if command -v help2man >/dev/null; then
    expect "$prefix/share/man/man1/footprint.1" 'compare'
    expect "$prefix/share/man/man1/footprint-compare.1" '\-\-methods'
  fi
  expect "$prefix/share/bash-completion/completions/footprint" 'footprint completions offer'
  expect "$prefix/share/zsh/vendor-completions/_footprint" 'footprint completions offer'
  expect "$prefix/share/fish/vendor_completions.d/footprint.fish" 'footprint completions offer'
  "$program" completions offer -- compare bumps --method >"$work/offered"
  expect "$work/offered" '--methods'
  [ -s "$prefix/share/doc/footprint/README.md" ] || fail "no README.md"
  [ -s "$prefix/share/doc/footprint/docs/reference/metrics.md" ] || fail "no documents where README.md looks for them"
  [ -s "$prefix/share/doc/footprint/copyright" ] || fail "no licence"
  [ -s "$prefix/lib/python3/dist-packages/footprint/__init__.py" ] || fail "no Python package"
}

build_method() {
  cp -r -- "$prefix/share/footprint/development/methods/template" "$work/sparkle"
  cd -- "$work/sparkle"
  for file in template*; do mv -- "$file" "sparkle${file#template}"; done
  sed -i "s/template/sparkle/g" -- *
  {
    "$cmake" -S . -B build -DCMAKE_PREFIX_PATH="$prefix" "$@" && "$cmake" --build build --target footprint_with_sparkle
  } >"$work/log" 2>&1 || fail "a method does not build against it: $(tail -n 20 -- "$work/log")"
  build/footprint_with_sparkle list methods >"$work/methods"
  for method in direct toksvig sparkle; do expect "$work/methods" "  $method"; done
}

install_and_move
run_program
look_at_texts
build_method "$@"
