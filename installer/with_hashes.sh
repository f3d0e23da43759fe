#!/usr/bin/env bash
# Prints the pins of a lock with the hashes that what is installed must have: installer/with_hashes.sh LOCK...
# A pin without hashes is an error, so that nothing is installed that nobody has pinned.
set -euo pipefail
hashes=$(dirname "${BASH_SOURCE[0]}")/hashes.lock
awk '
    FNR == 1 { file++ }
    file == 1 { if ($1 ~ /==/) name = $1; block[name] = block[name] $0 "\n"; next }
    /^[^#]/ && /==/ {
        pin = $1
        sub(/\[.*\]/, "", pin)
        if (seen[pin]++) next
        if (pin in block) printf "%s", block[pin]
        else { print "no hashes are known for " pin ": run make hashes" > "/dev/stderr"; bad = 1 }
    }
    END { exit bad }
' "$hashes" "$@"
