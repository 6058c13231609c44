#!/usr/bin/env -S python3 -B
"""What libdapple shows to a linker: exactly the functions that the public headers declare, all named dpl_, and
no library needed but those of C. Called by tools/check/test.sh: symbols.py FOLDER-OF-THE-LIBRARIES."""
import os
import re
import subprocess
import sys

import repository

# Everything else would have to be installed along with libdapple.so.
MAY_NEED = re.compile(r"^(libc|libm|libpthread|ld-linux-[a-z0-9-]+)\.so\.\d+$")
DECLARATION = re.compile(r"^DPL_API\b[^;(]*?\b(\w+)\s*\(", re.MULTILINE)


def output_of(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, check=True, universal_newlines=True).stdout


def symbols_of(*options_and_file):
    """External, defined symbols, without versions. Lines of other shapes name the members of an archive."""
    lines = output_of("nm", "--format=posix", "--defined-only", *options_and_file).splitlines()
    return {line.split()[0].split("@")[0] for line in lines if len(line.split()) >= 3}


def declared_functions():
    declared = set()
    for path in repository.files():
        if path.startswith("include/dapple/") and path.endswith(".h"):
            declared |= set(DECLARATION.findall(repository.text_of(path)))
    return declared


def complaints(folder):
    shared = os.path.join(folder, "libdapple.so")
    exported = symbols_of("-D", shared)
    declared = declared_functions()
    if not exported or not declared:
        yield "no exported symbols or no declared functions were found"
    for name in sorted(exported - declared):
        yield f"{name} is exported but no public header declares it"
    for name in sorted(declared - exported):
        yield f"{name} is declared in a public header but libdapple.so does not define it"
    for name in sorted(symbols_of("-g", os.path.join(folder, "libdapple.a"))):
        if not name.startswith("dpl_"):
            yield f"{name} has external linkage but no dpl_ prefix"
    for name in re.findall(r"\(NEEDED\).*\[(.*)\]", output_of("readelf", "-d", shared)):
        if not MAY_NEED.match(name):
            yield f"libdapple.so needs {name}"


def main():
    found = list(complaints(sys.argv[1]))
    for complaint in found:
        print("symbols:", complaint)
    if not found:
        print(len(declared_functions()), "public functions, all exported, nothing else is")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
