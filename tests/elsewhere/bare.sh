# A bare Debian of another release, for the scripts here; sourced by them. Needs root.
#
# The system comes from debootstrap and the package source that this machine uses. It has its own /tmp, /proc and process table,
# and sees nothing of this machine but its devices. FOLDER/RELEASE.STEP.log has the output of each step.

fail() { echo "elsewhere: $1" >&2; exit "${2:-1}"; }

# bare RELEASE FOLDER: makes the system FOLDER/RELEASE anew.
bare() {
    release="$1"
    folder="$(realpath --canonicalize-missing "$2")"
    root="$folder/$release"
    ((EUID == 0)) || fail "needs root: debootstrap and chroot" 3
    local mirror
    mirror="$(grep --no-filename --only-matching --extended-regexp 'https?://[^ ]+/debian/?( |$)' /etc/apt/sources.list /etc/apt/sources.list.d/* 2> /dev/null |
        head --lines 1 | tr --delete ' ')" || true
    [[ "$mirror" ]] || fail "no source of Debian packages in /etc/apt" 3
    command -v debootstrap > /dev/null || { apt-get --quiet --quiet update && apt-get --quiet --quiet install --yes debootstrap; } > /dev/null
    mkdir --parents "$folder"
    rm --recursive --force "${root:?}"
    step system debootstrap --variant=minbase "$release" "$root" "$mirror"
}

# inside 'COMMANDS': runs them in the system, in namespaces of their own: whatever they mount or start ends with them.
inside() {
    unshare --mount --pid --fork --kill-child bash -c '
        set -e
        mount --rbind /dev "$0/dev"; mount --rbind /sys "$0/sys"
        mount --types proc proc "$0/proc"; mount --types tmpfs tmpfs "$0/tmp"
        exec chroot "$0" /usr/bin/env --ignore-environment PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 TERM=dumb /bin/bash -euc "$1"
        ' "$root" "$1" < /dev/null
}

installed() { inside "apt-get --quiet update && DEBIAN_FRONTEND=noninteractive apt-get --quiet install --yes --no-install-recommends $*"; }

# step NAME COMMAND…: prints how long it took; the first that fails ends the script with the end of its log.
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
