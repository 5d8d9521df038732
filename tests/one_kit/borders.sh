#!/bin/bash
# What programs and libraries hold, show and load.
#
#   borders.sh shows-ours-alone LIBRARY          shows names of dustbench and no others
#   borders.sh loads-none PROGRAM PATTERN        needs no library of such a name, be it through others
#   borders.sh holds-no-copy PROGRAM LIBRARY     defines nothing that the library shows, and finds it when both are moved
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
        [[ -n $names ]] || fail "$2 shows nothing" ""
        others="$(grep -vE '^((vtable|typeinfo|typeinfo name) for )?dustbench::' <<< "$names" || true)"
        [[ -z $others ]] || fail "$2 shows what is not ours:" "$others"
        ;;
    loads-none)
        found="$(ldd "$2" | grep -E "$3" || true)"
        [[ -z $found ]] || fail "$2 loads:" "$found"
        ;;
    holds-no-copy)
        copies="$(comm -12 <(shown "$3") <(nm --defined-only "$2" | awk '{ print $3 }' | sort -u) | c++filt)"
        [[ -z $copies ]] || fail "$2 holds a copy of what $(basename "$3") shows:" "$copies"
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
