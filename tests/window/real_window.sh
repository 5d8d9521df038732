#!/bin/bash
# The window on a separate display, controlled like a user would: it opens, drives, switches, saves and closes.
#
#   real_window.sh PROGRAM WORK      77: skipped, with the reason
#
# Everything is in the folder WORK, including the user's settings. All processes are stopped at the end.
set -euo pipefail
program="$(realpath "$1")"
work="$2"

skip() {
    echo "skipped: $*"
    # In CI, everything is installed: a missing tool is an error.
    [[ ${CI:-} != true ]] || exit 1
    exit 77
}
for tool in Xvfb xdotool; do
    command -v "$tool" > /dev/null || skip "$tool is not installed (.ci/install display)"
done
rm -rf "$work"
mkdir -p "$work"
work="$(realpath "$work")"
cd "$work"
export HOME="$work/home" XDG_CONFIG_HOME="$work/config" LIBGL_ALWAYS_SOFTWARE=1
unset WAYLAND_DISPLAY DUSTBENCH_ADAPTER
settings="$XDG_CONFIG_HOME/dustbench/view.toml"
mkdir -p "$HOME"
started=()

finish() {
    local -r status=$?
    trap - EXIT
    ((status == 0 || status == 77)) || tail -n 20 ./*.log
    for process in "${started[@]}"; do kill -KILL "$process" 2> /dev/null || true; done
    wait "${started[@]}" 2> /dev/null || true
    exit "$status"
}
trap finish EXIT

fail() {
    echo "FAILED: $*"
    exit 1
}
# within SECONDS what command…: until the command succeeds
within() {
    local -r end=$((SECONDS + $1)) what="$2"
    shift 2
    until "$@"; do
        ((SECONDS < end)) || fail "$what"
        sleep 0.1
    done
}

# --- a display -----------------------------------------------------------------------------------------------------
setpriv --pdeathsig KILL Xvfb -displayfd 3 -screen 0 1400x900x24 -nolisten tcp -noreset -fbdir "$work" \
    3> display > xvfb.log 2>&1 &
started+=($!)
within 30 "Xvfb does not come up" test -s display
DISPLAY=":$(cat display)"
export DISPLAY

# Without a window manager, nothing gives the keyboard focus to the window.
focus() {
    xdotool windowfocus "$window"
    sleep 0.2
}
# openWindow ARGUMENTS…: sets `window` and `viewer`
openWindow() {
    setpriv --pdeathsig KILL "$program" view "$@" > view.out 2> view.log &
    viewer=$!
    started+=("$viewer")
    local -r end=$((SECONDS + 60))
    until window="$(xdotool search --onlyvisible --name '^dustbench view$' 2> /dev/null)" && [[ -n $window ]]; do
        if ! kill -0 "$viewer" 2> /dev/null; then
            grep -q "built without" view.log && skip "$(cat view.log)"
            fail "view ended: $(cat view.log)"
        fi
        ((SECONDS < end)) || fail "no window after 60 s"
        sleep 0.1
    done
    focus
}
closeWindow() {
    xdotool key ctrl+q
    local status=0
    wait "$viewer" || status=$?
    ((status == 0)) || fail "Ctrl+Q: exit code $status: $(cat view.log)"
    unset 'started[-1]'
    ! grep '^dustbench' view.log || fail "view printed messages"
}
# press KEY what command…: until the command succeeds; the key may come before the window listens
press() {
    local -r key="$1" what="$2" end=$((SECONDS + 60))
    shift 2
    until "$@"; do
        ((SECONDS < end)) || fail "$what"
        xdotool key "$key"
        for ((i = 0; i < 10; ++i)); do
            "$@" && break
            sleep 0.1
        done
    done
}

world=(--size 160x120 -P particles=300 -P preroll=0.2 --out "$work/saved")

# --- drive, switch, save, close ------------------------------------------------------------------------------------
openWindow --method billboard --with octree_search --drive keyboard "${world[@]}"
echo "a window after $SECONDS s"
hasPicture() { compgen -G "$work/saved/f*.png" > /dev/null; }
press p "P saves no picture" hasPicture
xdotool keydown Up
sleep 2
xdotool keyup Up
hasDriven() { [[ -s saved/drive.csv ]] && awk -F, 'NR > 1 && $2 > 0 { found = 1 } END { exit !found }' saved/drive.csv; }
press r "R saves no drive with its throttle" hasDriven
xdotool key v # side by side
for size in "320 200" "1 1" "1000 700"; do
    # shellcheck disable=SC2086 # two numbers
    xdotool windowsize "$window" $size
    sleep 0.3
done
xdotool windowunmap "$window"
sleep 0.3
xdotool windowmap --sync "$window"
focus
hasState() { grep -q 'method = "octree_search"' saved/state.toml 2> /dev/null; }
press ctrl+s "Ctrl+S saves no state" hasState
cp Xvfb_screen0 seen.xwd
closeWindow
grep -q '^shown = "beside"$' "$settings" || fail "the settings do not say 'beside': $(cat "$settings")"
grep -q '^size = "1000x700"$' "$settings" || fail "the settings do not contain the size: $(cat "$settings")"
echo "driven, resized and closed after $SECONDS s"

# --- the drive and the state are valid, the settings are used ---------------------------------------------------------
"$program" run --method null_method --drive saved/drive.csv --frames 30 --size 64x48 -P particles=300 -P preroll=0.2 \
    --out run > run.log 2>&1 || fail "the recorded drive cannot be run"
openWindow --state saved/state.toml --out "$work/again"
hasAgain() { compgen -G "$work/again/f*.png" > /dev/null; }
press p "P saves no picture of the state" hasAgain
[[ $(xdotool getwindowgeometry "$window" | grep -o '[0-9]*x[0-9]*$') == 1000x700 ]] || fail "the window does not have its size"
closeWindow
grep -q '^shown = "beside"$' "$settings" || fail "the view was not restored"

# --- errors are one line ---------------------------------------------------------------------------------------------
rm -rf saved
echo "divider = wrong" > "$settings"
before="$(sha256sum < "$settings")"
openWindow --method billboard "${world[@]}"
press p "P saves no picture" hasPicture
xdotool key h # changes the settings
sleep 0.5
closeWindow
[[ $(sha256sum < "$settings") == "$before" ]] || fail "broken settings were overwritten"
rm "$settings"

# --- adapters ------------------------------------------------------------------------------------------------------
rm -rf saved
openWindow --adapter 0 --method billboard "${world[@]}"
press p "P saves no picture drawn by adapter 0" hasPicture
closeWindow
status=0
"$program" view --adapter nothing "${world[@]}" > view.out 2> view.log || status=$?
((status == 3)) || fail "an unknown adapter: exit code $status, expected 3"
(($(grep -c '^dustbench' view.log) == 1)) || fail "an unknown adapter: expected one line: $(cat view.log)"
echo "passed after $SECONDS s"
