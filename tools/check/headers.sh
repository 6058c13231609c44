#!/usr/bin/env bash
# Each public header compiles alone, without warnings, as C17 and as C++17. Called by tools/check/test.sh.
set -euo pipefail
cd "$(dirname "$0")/../.."
headers=(include/dapple/*.h)
[ -e "${headers[0]}" ] || { echo "headers: none found" >&2; exit 1; }
for header in "${headers[@]}"; do
    for language in "gcc -x c -std=c17" "g++ -x c++ -std=c++17"; do
        # Word splitting is wanted: a compiler and its flags.
        # shellcheck disable=SC2086
        # Twice, for the include guard; then one declaration, since a file of macros alone is no C program.
        name=${header#include/}
        printf '#include <%s>\n#include <%s>\nextern int headers_alone;\n' "$name" "$name" |
            $language -Wall -Wextra -Wpedantic -Werror -fsyntax-only -Iinclude - ||
            { echo "headers: $header does not stand alone under $language" >&2; exit 1; }
    done
done
echo "${#headers[@]} headers, as C17 and C++17"
