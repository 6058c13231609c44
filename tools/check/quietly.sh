# Sourced by the scripts of this folder: quietly COMMAND… shows a command's output only when it fails.
quietly() {
    local log status=0
    log=$(mktemp)
    "$@" >"$log" 2>&1 || status=$?
    if [ "$status" -ne 0 ]; then
        cat "$log"
        echo "failed with status $status: $*"
    fi
    rm -f "$log"
    return "$status"
}
