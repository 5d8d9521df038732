#!/bin/bash
# Follows the Containerfile in a bare Debian, where no container image can be had: the same commands in the same order.
#
#   tests/elsewhere/container_file.sh        after `make portable`
#
# Exit code: 0 where all steps pass, 1 where one fails, 3 where the machine cannot do it.
set -euo pipefail
here="$(realpath "$(dirname "$0")")"
cd "$here/../.."
. "$here/bare.sh"

number=0
directory=/  # `folder` belongs to bare.sh
while read -r instruction rest; do
    number=$((number + 1))
    case "$instruction" in
        '' | '#'*) ;;
        FROM) bare "$(sed --quiet 's/.*debian:\([a-z]*\)-slim$/\1/p' <<< "$rest")" build/elsewhere/container ;;
        RUN) step "line-$number" inside "cd $directory && $rest" ;;
        COPY)
            read -r from to <<< "$rest"
            compgen -G "$from" > /dev/null || fail "$from is missing: run make portable first" 3
            # shellcheck disable=SC2086 # a pattern
            cp $from "$root$to"
            ;;
        WORKDIR) directory="$rest" && mkdir --parents "$root$directory" ;;
        ENTRYPOINT) step selfcheck inside "cd $directory && $(tr --delete '[],"' <<< "$rest") selfcheck --out selfcheck" ;;
        *) fail "Containerfile:$number: unknown instruction '$instruction'" ;;
    esac
done < Containerfile
