#!/usr/bin/env bash
# A newcomer's first method: copies methods/template out of the tree under a new name, as docs/contributing/adding-a-method.md says,
# builds it against this build folder, runs its tests and the program with it; then breaks its shader, which must fail.
#   out_of_tree_test.sh SOURCE_FOLDER BUILD_FOLDER CMAKE [CMAKE_ARGUMENT ...]
set -euo pipefail

source_folder=$1 build_folder=$2 cmake=$3
shift 3
name=sparkle
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

fail() {
  printf 'FAILED: %s\n' "$*" >&2
  exit 1
}

# Fails unless FILE contains TEXT.
expect() {
  grep -qF -- "$2" "$1" || fail "no \`$2\` in: $(cat -- "$1")"
}

copy_template() {
  cp -r -- "$source_folder/methods/template" "$work/$name"
  cd -- "$work/$name"
  for file in template*; do mv -- "$file" "$name${file#template}"; done
  sed -i "s/template/$name/g" -- *
}

build() {
  {
    "$cmake" -S "$work/$name" -B "$work/build" -DFootprint_DIR="$build_folder" "$@" && "$cmake" --build "$work/build"
  } >"$work/log" 2>&1 || fail "it does not build: $(cat -- "$work/log")"
}

run_tests() {
  ctest --test-dir "$work/build" --output-on-failure >"$work/log" 2>&1 || fail "its tests: $(cat -- "$work/log")"
  expect "$work/log" "footprint_${name}_test"
}

program=$work/build/footprint_with_$name

run_program() {
  "$program" list methods >"$work/methods"
  for method in direct naive_mip toksvig "$name"; do expect "$work/methods" "  $method"; done
  "$program" render ribbed_plane --method "$name:share=0.5" --size 64x64 -o "$work/picture.exr" >"$work/log"
  [ -s "$work/picture.exr" ] || fail "no picture"
  "$program" compare clear_coat --methods "direct,$name" --spp 4 --size 64x64 --distance 2 --repeats 2 \
    -o "$work/out" >"$work/table"
  expect "$work/table" "$name"
  tr -d ' \n' <"$work/out/results.json" >"$work/results"
  expect "$work/results" '"left_out":["roughness_variation"]'
}

# The error names the method's file and line, and shows that line.
run_broken_shader() {
  sed -i 's/float size = length(texel.xyz);/float size = lenght(texel.xyz);/' -- "$work/$name/$name.glsl"
  build
  local line code=0
  line=$(grep -n lenght -- "$work/$name/$name.glsl" | cut -d: -f1)
  "$program" render ribbed_plane --method "$name" --size 64x64 -o "$work/broken.exr" 2>"$work/error" || code=$?
  [ "$code" -eq 3 ] || fail "exit code $code for a broken shader"
  expect "$work/error" "$name.glsl"
  expect "$work/error" " $line |   float size = lenght(texel.xyz);"
  [ ! -e "$work/broken.exr" ] || fail "a broken shader left a picture"
}

copy_template
build "$@"
run_tests
run_program
run_broken_shader
