#!/bin/bash
# Runs both commands of the README in a bare Debian of another release, from nothing installed, on a clone of the last commit.
#
#   tests/elsewhere/readme_commands.sh [RELEASE [FOLDER]]        default: trixie build/elsewhere
#
# Exit code: 0 where all steps pass, 1 where one fails, 3 where the machine cannot do it.
set -euo pipefail
here="$(realpath "$(dirname "$0")")"
. "$here/bare.sh"
bare "${1:-trixie}" "${2:-build/elsewhere}"
step tools installed make git ca-certificates
step clone git clone --quiet --no-hardlinks "$here/../.." "$root/root/dustbench"
step test inside 'cd /root/dustbench && make test'
step reproduce inside 'cd /root/dustbench && make reproduce && test -s reports/out/carr2006/index.html'
