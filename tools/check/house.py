#!/usr/bin/env -S python3 -B
"""House rules that a machine can see: files have a size a reader can hold, say first what they are for, name no
folder of anyone's machine, and public headers are guarded by their own name. Called by tools/check/test.sh."""
import os
import re
import sys

import repository

LISTED_FROM = 500  # lines: a file above this is at home only with a reason
REFUSED_FROM = 800
CODE = (".c", ".h", ".inc", ".cpp", ".py", ".sh", ".js", ".wgsl", ".glsl", ".comp", ".cmake", "CMakeLists.txt")
# Folders of a person or a workplace, at the start of a path.
OWN_FOLDER = re.compile(r"(?<![\w.$}/:-])/(?:home|root|work|Users)/[\w.]")
GUARD = re.compile(r"^#ifndef (\w+)\n#define (\w+)\n", re.MULTILINE)


def size_complaint(path, text):
    lines = text.count("\n")
    if path.endswith(CODE) and lines > REFUSED_FROM:
        return f"{path}:{lines}: {lines} lines; split it by object, {REFUSED_FROM} is the most"
    return None


def comment_complaint(path, text):
    if path.endswith((".c", ".h")) and not text.startswith("/*"):
        return f"{path}:1: the file does not begin with a comment that says what it is for"
    return None


def folder_complaint(path, text):
    found = OWN_FOLDER.search(text)
    if found:
        line = text.count("\n", 0, found.start()) + 1
        return f"{path}:{line}: names a folder of one machine"
    return None


def guard_complaint(path, text):
    if not path.startswith("include/"):
        return None
    wanted = "DAPPLE_" + re.sub(r"\W", "_", os.path.basename(path)).upper()
    found = GUARD.search(text)
    if not found or found.groups() != (wanted, wanted):
        return f"{path}:1: the include guard must be {wanted}"
    return None


RULES = (size_complaint, comment_complaint, folder_complaint, guard_complaint)


def main():
    complaints, long_files, count = [], [], 0
    for path in repository.files():
        text = repository.text_of(path)
        if text is None:
            continue
        count += 1
        complaints += [c for c in (rule(path, text) for rule in RULES) if c]
        if path.endswith(CODE) and text.count("\n") > LISTED_FROM:
            long_files.append(f"note: {path} has {text.count(chr(10))} lines")
    for line in long_files + complaints:
        print(line)
    if not complaints:
        print(count, "text files keep the house rules")
    return 1 if complaints or not count else 0


if __name__ == "__main__":
    sys.exit(main())
