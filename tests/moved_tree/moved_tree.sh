#!/bin/bash
# `make build` in a tree that was moved after a build: configures again, and creates nothing at the old place.
# The tree consists of the real Makefile, presets and .ci, and a CMakeLists.txt with one target.
#   tests/moved_tree/moved_tree.sh WORK
set -euo pipefail
work="${1:?WORK}"
source="$(cd "$(dirname "$0")/../.." && pwd)"
rm -rf "$work"
mkdir -p "$work/old"
cp -r "$source/Makefile" "$source/CMakePresets.json" "$source/.ci" "$work/old/"
printf 'exit 0\n' > "$work/old/.ci/install" # packages are not part of this test
cat > "$work/old/CMakeLists.txt" << 'END'
cmake_minimum_required(VERSION 3.25)
project(moved NONE)
add_custom_target(dustbench COMMAND ${CMAKE_COMMAND} -E echo ${CMAKE_SOURCE_DIR} > ${CMAKE_BINARY_DIR}/dustbench)
END
unset MAKEFLAGS MAKELEVEL MFLAGS

built() { # PLACE: checks that the program there names it
    make --directory "$work/$1" build > "$work/log" 2>&1 || { cat "$work/log" >&2; exit 1; }
    local place
    place="$(cat "$work/$1/build/release/dustbench")"
    [[ $place == "$work/$1" ]] || { echo "moved_tree: in $work/$1 the program was built for $place" >&2; exit 1; }
}
built old
mv "$work/old" "$work/new"
built new
grep --quiet "configured at $work/old" "$work/log" || { echo "moved_tree: make did not report the move" >&2; exit 1; }
[[ ! -e $work/old ]] || { echo "moved_tree: the old place was created again: $(find "$work/old")" >&2; exit 1; }
cp -r "$work/new" "$work/copy"
built copy
built new
! grep "configured" "$work/log" || { echo "moved_tree: a tree that was not moved was configured again" >&2; exit 1; }
