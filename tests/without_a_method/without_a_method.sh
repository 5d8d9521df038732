#!/bin/bash
# A method's folder deleted, everything else builds, lists and runs: in a copy of the tree, whose build folder is kept.
#   tests/without_a_method/without_a_method.sh METHOD
set -euo pipefail
method="${1:-}"
source="$(cd "$(dirname "$0")/../.." && pwd)"
methods="$(cd "$source/methods" && find . -mindepth 2 -maxdepth 2 -name '*.cpp' -printf '%h\n' | sort -u | sed 's#^\./##' | grep --invert-match --line-regexp --extended-regexp 'contract|kit')"
if ! grep --quiet --line-regexp --fixed-strings -- "$method" <<< "$methods"; then
    echo "without: no method '$method'; known: $(paste --serial --delimiters=' ' <<< "$methods")" >&2
    exit 3
fi

work="$source/build/without/$method"
tree="$work/tree"
build="$tree/build/release" # as far below its tree as the real one, so that the compiler cache knows the files
mkdir -p "$tree"
for part in CMakeLists.txt CMakePresets.json methods bench data reports tests; do
    rm -rf "${tree:?}/$part"
    cp --recursive --preserve=timestamps "$source/$part" "$tree/$part"
done
rm -rf "${tree:?}/methods/$method" "$tree/reports/out"

"$source/.ci/drop-stale-builds" "$build"
export CCACHE_BASEDIR="$tree"
unset DUSTBENCH_DATA
cmake -S "$tree" --preset release -DDUSTBENCH_WERROR="${DUSTBENCH_WERROR:-OFF}" > "$work/configure.log" ||
    { cat "$work/configure.log" >&2; exit 1; }
cmake --build "$build" --target dustbench

listed="$("$build/dustbench" list methods --json | sed -n 's/^ *"id": "\(.*\)",$/\1/p')"
expected="$(grep --invert-match --line-regexp --fixed-strings -- "$method" <<< "$methods")"
if [[ "$listed" != "$expected" ]]; then
    printf 'without: listed are\n%s\nexpected\n%s\n' "$listed" "$expected" >&2
    exit 1
fi
"$build/dustbench" list > /dev/null
rm -rf "$work/results"
"$build/dustbench" run --method null_method --frames 2 --size 64x48 -P preroll=0 --out "$work/results" > /dev/null ||
    [[ "$method" == null_method ]]
echo "without $method: $(paste --serial --delimiters=' ' <<< "$listed")"
