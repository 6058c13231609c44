#!/usr/bin/env -S python3 -B
"""Which files belong to the repository: those git knows or would add. Imported by the checks of this folder;
as a command, prints the files with the extensions it is given (repository.py c h), one a line."""
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
NOT_SOURCE = ("build", "out", ".git")


def files_by_git():
    command = ["git", "-C", ROOT, "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    found = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True)
    return found.stdout.decode("utf-8").split("\0")


def files_by_walk():
    """Without git, or in a clone that git will not touch because another user owns it."""
    for folder, children, names in os.walk(ROOT):
        if folder == ROOT:
            children[:] = [c for c in children if not c.startswith(NOT_SOURCE)]
        children[:] = [c for c in children if c != "__pycache__"]
        for name in names:
            yield os.path.relpath(os.path.join(folder, name), ROOT)


def files():
    """Sorted paths relative to the root, of plain files that exist."""
    try:
        found = files_by_git()
    except (OSError, subprocess.CalledProcessError):
        found = files_by_walk()
    plain = {f for f in found if f and os.path.isfile(os.path.join(ROOT, f))}
    return sorted(f for f in plain if not os.path.islink(os.path.join(ROOT, f)))


def text_of(path):
    """Text of a file, or None where it is not text."""
    with open(os.path.join(ROOT, path), "rb") as file:
        data = file.read()
    if b"\0" in data:
        return None
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return None


if __name__ == "__main__":
    endings = tuple("." + extension for extension in sys.argv[1:])
    print("\n".join(f for f in files() if f.endswith(endings)))
