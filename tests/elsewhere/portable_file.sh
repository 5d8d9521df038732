#!/bin/bash
# Runs the portable file (`make portable`) in bare Debian systems that have nothing but Mesa, and in Debian 11, whose C library is too old.
#
#   tests/elsewhere/portable_file.sh ARCHIVE [RELEASE…]        default: bookworm trixie
#
# Exit code: 0 where all steps pass, 1 where one fails, 3 where the machine cannot do it.
set -euo pipefail
archive="$(realpath "${1:?the archive}")"
shift
here="$(realpath "$(dirname "$0")")"
. "$here/bare.sh"
(($#)) || set -- bookworm trixie

# As run by a user who has unpacked the archive somewhere and is somewhere else.
program() { inside "cd /srv && /opt/*/bin/dustbench $*"; }

withoutMesa() {
    local said
    if said="$(program env 2>&1)"; then return 1; fi
    echo "$said"
    [[ "$(wc --lines <<< "$said")" == 1 && "$said" == *libEGL* ]]
}

tooOld() {
    local said code=0
    said="$(program env 2>&1)" || code=$?
    echo "$said"
    [[ "$code" == 3 && "$(wc --lines <<< "$said")" == 1 && "$said" == *'glibc 2.31'*'2.36'* ]]
}

# The window stays open until it is closed: ten seconds later.
window() {
    inside 'cd /srv && code=0; timeout 10 xvfb-run --auto-servernum /opt/*/bin/dustbench view || code=$?; test "$code" = 124'
}

unpacked() {
    bare "$1" build/elsewhere
    step unpack bash -c "zstd --quiet --decompress --stdout '$archive' | tar --extract --directory '$root/opt'"
}

for each in "$@"; do
    unpacked "$each"
    step without-mesa withoutMesa
    step mesa installed libegl1 libegl-mesa0 libgl1 libgl1-mesa-dri
    step env program env
    step selfcheck program selfcheck --out selfcheck
    step run program run --method octree_search --frames 10 --images 5 --metrics --out run -P preroll=1
    step compare program compare billboard octree_search --repetitions 1 --frames 5 --size 160x120 -P preroll=1 --out compare
    step report program report compare
    step export program export --method grid_fluid --frames 0:1:1 --format vti,vdb --out volumes -P preroll=0.5
    step reproduce program reproduce --paper bergeron --quick --out paper
    step display installed xvfb xauth
    step view window
done

unpacked bullseye
step old-glibc tooOld
