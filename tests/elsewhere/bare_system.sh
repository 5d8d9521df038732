#!/bin/bash
# Runs both commands of the README in a bare Debian of another release, from nothing installed.
#
#   tests/elsewhere/bare_system.sh [RELEASE [FOLDER]]        default: trixie build/elsewhere
#
# Needs root. The system comes from debootstrap and the package source that this machine uses; it keeps its own /tmp, /proc and
# process table, and sees this tree only as a clone of the last commit. FOLDER/RELEASE.STEP.log has the output of each step.
# Exit code: 0 where all steps pass, 1 where one fails, 3 where the machine cannot do it.
set -euo pipefail
release="${1:-trixie}"
folder="$(realpath --canonicalize-missing "${2:-build/elsewhere}")"
tree="$(realpath "$(dirname "$0")/../..")"
root="$folder/$release"

fail() { echo "elsewhere: $1" >&2; exit "${2:-1}"; }
((EUID == 0)) || fail "needs root: debootstrap and chroot" 3

mirror="$(grep --no-filename --only-matching --extended-regexp 'https?://[^ ]+/debian/?( |$)' /etc/apt/sources.list /etc/apt/sources.list.d/* 2> /dev/null |
    head --lines 1 | tr --delete ' ')" || true
[[ "$mirror" ]] || fail "no source of Debian packages in /etc/apt" 3
command -v debootstrap > /dev/null || { apt-get --quiet --quiet update && apt-get --quiet --quiet install --yes debootstrap; } > /dev/null

# Runs a shell command within the bare system, in namespaces of its own: whatever it mounts or starts ends with it.
inside() {
    unshare --mount --pid --fork --kill-child bash -c '
        set -e
        mount --rbind /dev "$0/dev"; mount --rbind /sys "$0/sys"
        mount --types proc proc "$0/proc"; mount --types tmpfs tmpfs "$0/tmp"
        exec chroot "$0" /usr/bin/env --ignore-environment PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 TERM=dumb /bin/bash -euc "$1"
        ' "$root" "$1" < /dev/null
}

# NAME COMMAND…: prints how long it took; the first step that fails ends the script with the end of its log.
step() {
    local name="$1" begin="$SECONDS" log="$folder/$release.$1.log"
    shift
    if "$@" > "$log" 2>&1; then
        printf '== %s, %s: %d s\n' "$release" "$name" "$((SECONDS - begin))"
    else
        tail --lines 30 "$log" >&2
        fail "$release, $name failed after $((SECONDS - begin)) s; all of its output is in $log"
    fi
}

mkdir --parents "$folder"
rm --recursive --force "${root:?}"
step system debootstrap --variant=minbase "$release" "$root" "$mirror"
step tools inside 'apt-get --quiet update && apt-get --quiet install --yes --no-install-recommends make git ca-certificates'
step clone git clone --quiet --no-hardlinks "$tree" "$root/root/dustbench"
step test inside 'cd /root/dustbench && make test'
step reproduce inside 'cd /root/dustbench && make reproduce && test -s reports/out/carr2006/index.html'
