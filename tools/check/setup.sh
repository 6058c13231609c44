#!/usr/bin/env bash
# Installs the packages of packages.txt that are missing. Nothing is asked of the network when all are there.
# Called by the Makefile: setup.sh demo | setup.sh web | setup.sh test (the default; includes the others).
set -euo pipefail
cd "$(dirname "$0")"
tier=${1:-test}

fail() {
    echo "setup: $*" >&2
    exit 1
}

case $tier in
demo) mapfile -t wanted < <(awk '!/^#/ && $2 == "demo" { print $1 }' packages.txt) ;;
web) mapfile -t wanted < <(awk '!/^#/ && $2 == "web" { print $1 }' packages.txt) ;;
test) mapfile -t wanted < <(awk '!/^#/ && NF { print $1 }' packages.txt) ;;
*) fail "usage: setup.sh [demo|web|test]" ;;
esac
# Whoever has node and npm from elsewhere keeps them: Debian's would stand beside them or drive them out.
if command -v node >/dev/null && command -v npm >/dev/null; then
    mapfile -t wanted < <(printf '%s\n' "${wanted[@]}" | grep -vx -e nodejs -e npm)
fi
[ ${#wanted[@]} -gt 0 ] || fail "packages.txt lists nothing"

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    fail "this is not Debian; install what these packages hold by hand, then run tools/check/$tier.sh: ${wanted[*]}"
fi

# dpkg-query exits 1 when a name is unknown, which is an answer and not an error here.
installed=$({ dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null || true; } |
    awk '$2 == "installed" { print $1 }')
mapfile -t missing < <(comm -23 <(printf '%s\n' "${wanted[@]}" | sort -u) <(sort -u <<<"$installed"))
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
        fail "neither root nor sudo; as root, run: apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
fi
as_root+=(env DEBIAN_FRONTEND=noninteractive)
# A machine that has just started may still be updating itself: wait for its lock.
apt=("${as_root[@]}" apt-get -qq -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0)

echo "setup: installing ${missing[*]}"
"${apt[@]}" update || fail "apt-get update failed; still missing: ${missing[*]}"
"${apt[@]}" install -y --no-install-recommends "${missing[@]}" >/dev/null ||
    fail "apt-get install failed; still missing: ${missing[*]}"
