#!/bin/bash
# Checks which symbols programs and libraries define and export, and which libraries they load.
#
#   borders.sh shows-ours-alone LIBRARY          exports only names of dustbench
#   borders.sh loads-none PROGRAM PATTERN        loads no library with a matching name, directly or indirectly
#   borders.sh holds-no-copy PROGRAM LIBRARY     defines nothing that the library exports, and finds it when both are moved
set -euo pipefail
shown() { nm --dynamic --defined-only "$1" | awk '{ print $3 }' | sed 's/@.*//' | sort -u; }

fail() {
    echo "$1"
    echo "$2" | head -n 20
    exit 1
}

case "$1" in
    shows-ours-alone)
        names="$(shown "$2" | c++filt)"
        [[ -n $names ]] || fail "$2 exports nothing" ""
        others="$(grep -vE '^((vtable|typeinfo|typeinfo name) for )?dustbench::' <<< "$names" || true)"
        [[ -z $others ]] || fail "$2 exports foreign names:" "$others"
        ;;
    loads-none)
        found="$(ldd "$2" | grep -E "$3" || true)"
        [[ -z $found ]] || fail "$2 loads:" "$found"
        ;;
    holds-no-copy)
        copies="$(comm -12 <(shown "$3") <(nm --defined-only "$2" | awk '{ print $3 }' | sort -u) | c++filt)"
        [[ -z $copies ]] || fail "$2 contains copies of symbols from $(basename "$3"):" "$copies"
        moved="$(mktemp -d)"
        trap 'rm -r "$moved"' EXIT
        cp "$2" "$3" "$moved"
        found="$(ldd "$moved/$(basename "$2")" | grep "$(basename "$3")")"
        [[ $found == *"=> $moved/"* ]] || fail "moved to $moved, $(basename "$2") loads:" "$found"
        ;;
    *)
        fail "unknown check '$1'" ""
        ;;
esac
