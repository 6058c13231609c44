#!/usr/bin/env -S python3 -B
"""Which room may include which: the table of docs/architecture.md, enforced. Called by tools/check/test.sh.

    layering.py              checks the repository; FILE:LINE: what, for each arrow that runs the wrong way
    layering.py --self-test  proves on made-up includes that wrong arrows are found and right ones are not

A room is a folder. An include is looked up as the compiler would: beside the including file, then in the
folders that targets have on their include path. A room that the table does not know is an error, so a new
room starts with its row here."""
import os
import re
import sys

import repository

# Room -> rooms it may include besides itself and the public headers.
BELOW_SOLVERS = {"src/base", "src/os", "src/job", "src/kernel"}
SOLVER = BELOW_SOLVERS | {"src/field", "src/solver"}
ROOMS = {
    "include/dapple": set(),
    "src/base": set(),
    "src/os": {"src/base"},
    "src/job": {"src/os", "src/base"},
    "src/kernel": {"src/os", "src/base"},
    "src/field": BELOW_SOLVERS,
    # What every solver shares: its table of functions, its counters.
    "src/solver": BELOW_SOLVERS | {"src/field"},
    "src/cascade": SOLVER,
    "src/holographic": SOLVER,
    "src/reference": SOLVER,
    "src/holographic": SOLVER,
    "src/shadow": SOLVER | {"src/bvh", "src/mesh"},
    # A world of its own: neither the field nor the solvers.
    "src/flood": {"src/base", "src/os", "src/kernel"},
    # Hierarchies of boxes, and rays against the triangles and shapes in them.
    "src/bvh": BELOW_SOLVERS,
    "src/mesh": BELOW_SOLVERS | {"src/bvh"},
    "src/tracer": BELOW_SOLVERS | {"src/field", "src/bvh"},
    "src/metric": BELOW_SOLVERS,
    # The second backend shares the world with the CPU solver and nothing else.
    "src/vulkan": {"src/base", "src/os", "src/job", "src/field", "src/solver"},
}
# The front end sees every room of the library; nobody sees it.
ROOMS["src/api"] = {room for room in ROOMS if room.startswith("src/")}
# Outside the library: public headers and each other, in this order.
ROOMS["image"] = set()
ROOMS["meshes"] = {"image"}
ROOMS["scenes"] = {"image", "meshes"}
for outer in ("tools", "bench", "viewer", "web"):
    ROOMS[outer] = {"image", "meshes", "scenes"}
# What measures: the benchmarks share it, and so does the command that measures.
ROOMS["bench/common"] = {"image", "scenes"}
ROOMS["bench"].add("bench/common")
ROOMS["tools"].add("bench/common")
# The page's benchmark is the command's study, not another one.
ROOMS["web"] |= {"tools", "bench/common"}
# Tests alone may reach into the library.
ROOMS["test"] = set(ROOMS) - {"tools", "bench", "viewer", "web"}

INCLUDE_PATH = ("src", "include", "", "image", "meshes", "scenes", "test")
C_HEADERS = set("""assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdalign
    stdarg stdatomic stdbool stddef stdint stdio stdlib stdnoreturn string tgmath time uchar wchar wctype""".split())
# What the library may include from the system besides the headers of C.
SYSTEM = {
    "src/os": re.compile(r"(pthread|sched|unistd|cpuid|windows)\.h|sys/\w+\.h|mach/\w+\.h"),
    "src/kernel": re.compile(r"\w*intrin\.h|arm_neon\.h|wasm_simd128\.h"),
    "src/vulkan": re.compile(r"volk\.h|vulkan/\w+\.h"),
}
NOTHING = re.compile(r"(?!)")
STRING_OR_COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|//[^\n]*|/\*.*?\*/', re.DOTALL)
INCLUDE = re.compile(r"^[ \t]*#[ \t]*include\b[ \t]*(.*?)[ \t]*$", re.MULTILINE)
SOURCE = (".c", ".h", ".inc", ".cpp", ".hpp", ".cc")


def room_of(path):
    """The longest room that holds the path; None for a file outside all rooms."""
    folder = os.path.dirname(path)
    while folder and folder not in ROOMS:
        folder = os.path.dirname(folder)
    return folder or None


def without_comments(text):
    """Comments become blanks; line numbers stay."""

    def blank(match):
        found = match.group(0)
        return re.sub(r"[^\n]", " ", found) if found.startswith("/") else found

    return STRING_OR_COMMENT.sub(blank, text)


def resolve(name, path, exists):
    """The file of this repository that an include means, or None."""
    for folder in (os.path.dirname(path),) + INCLUDE_PATH:
        candidate = os.path.normpath(os.path.join(folder, name))
        if exists(candidate):
            return candidate
    return None


def system_complaint(room, name):
    stem = name[:-2] if name.endswith(".h") else name
    in_library = room.startswith(("src/", "include/"))
    if not in_library or stem in C_HEADERS or SYSTEM.get(room, NOTHING).fullmatch(name):
        return None
    return f"{room} may not include <{name}>: the library stands on the C library alone"


def complaint_about(argument, path, exists):
    """What is wrong with `#include ARGUMENT` in this file; None when nothing is."""
    room = room_of(path)
    quoted = re.fullmatch(r'"([^"]+)"', argument)
    angled = re.fullmatch(r"<([^>]+)>", argument)
    if not quoted and not angled:
        return f"#include {argument}: by a macro, which nobody can check"
    name = (quoted or angled).group(1)
    target = resolve(name, path, exists)
    if target is None:
        return system_complaint(room, name) if angled else f'"{name}" is not a file of this repository'
    public = target.startswith("include/dapple/")
    if public and not argument.startswith("<dapple/"):
        return f"public headers are included as <dapple/{os.path.basename(target)}>"
    other = room_of(target)
    if public or other == room or other in ROOMS[room]:
        return None
    if other is None:
        return f"{target} is in no room of the table in tools/check/layering.py"
    return f"{room} -> {other}: {room} may include {', '.join(sorted(ROOMS[room])) or 'no other room'}"


def complaints_about(path, text, exists):
    if room_of(path) is None:
        yield f"{path}:1: this folder is no room of the table in tools/check/layering.py"
        return
    clean = without_comments(text)
    for match in INCLUDE.finditer(clean):
        complaint = complaint_about(match.group(1), path, exists)
        if complaint:
            line = clean.count("\n", 0, match.start()) + 1
            yield f"{path}:{line}: {complaint}"


def cycle_in(rooms):
    """Rooms that are left when rooms which include nobody are taken away again and again."""
    left = {room: set(below) - {room} for room, below in rooms.items()}
    while True:
        bottom = {room for room, below in left.items() if not below & set(left)}
        if not bottom:
            return sorted(left)
        left = {room: below for room, below in left.items() if room not in bottom}
        if not left:
            return []


def check_repository():
    paths = [p for p in repository.files() if p.endswith(SOURCE)]
    known = set(paths)
    found = []
    for path in paths:
        found += complaints_about(path, repository.text_of(path) or "", known.__contains__)
    for complaint in found:
        print(complaint)
    if not found:
        print(len(paths), "files in", len({room_of(p) for p in paths}), "rooms, every arrow runs downwards")
    return 1 if found or not paths else 0


# (file, its text, line that must be complained about or None)
EXAMPLES = [
    ("src/base/a.c", '#include "base/context.h"\n#include <stdio.h>\n', None),
    ("src/base/a.c", "/* why */\n\n#include \"job/jobs.h\"\n", 3),
    ("src/os/a.c", '#include <pthread.h>\n#include <sys/mman.h>\n#include "base/context.h"\n', None),
    ("src/job/a.c", '#include "os/thread.h"\n#include <dapple/context.h>\n', None),
    ("src/job/a.c", "#include <pthread.h>\n", 1),
    ("src/job/a.c", '#include "field/field.h"\n', 1),
    ("src/job/a.c", "  #  include <field/field.h>\n", 1),
    ("src/kernel/a.c", "#include <immintrin.h>\n", None),
    ("src/kernel/a.c", '#include "field/field.h"\n', 1),
    ("src/field/a.c", '#include "field.h"\n#include "kernel/kernel.h"\n#include "os/machine.h"\n', None),
    ("src/field/a.c", '#include "cascade/level.h"\n', 1),
    ("src/field/a.c", "#include <immintrin.h>\n", 1),
    ("src/cascade/a.c", '#include "field/field.h"\n#include "../reference/trace.h"\n', 2),
    ("src/cascade/a.c", '#include "vulkan/device.h"\n', 1),
    ("src/cascade/a.c", '#include "solver/solver.h"\n', None),
    ("src/solver/a.c", '#include "field/field.h"\n#include "cascade/level.h"\n', 2),
    ("src/field/a.c", '#include "solver/solver.h"\n', 1),
    ("src/api/a.c", '#include "attic/attic.h"\n', 1),
    ("src/vulkan/a.c", '#include "cascade/level.h"\n', 1),
    ("src/metric/a.c", "#include <jansson.h>\n", 1),
    ("src/metric/a.c", '#include "field/field.h"\n', 1),
    ("src/api/a.c", '#include "cascade/level.h"\n#include "vulkan/device.h"\n', None),
    ("src/cascade/a.c", '#include "api/handles.h"\n', 1),
    ("src/api/a.c", '#include "../../image/picture.h"\n', 1),
    ("src/attic/a.c", "int dpl_attic;\n", 1),
    ("include/dapple/a.h", "#include <dapple/context.h>\n#include <stdint.h>\n", None),
    ("include/dapple/a.h", '#include "context.h"\n', 1),
    ("include/dapple/a.h", "#include <base/context.h>\n", 1),
    ("include/dapple/a.h", "#include <png.h>\n", 1),
    ("image/a.c", '#include "picture.h"\n#include <dapple/context.h>\n#include <png.h>\n', None),
    ("image/a.c", '#include "../scenes/scene.h"\n', 1),
    ("scenes/a.c", '#include "../image/picture.h"\n#include "scene.h"\n', None),
    ("tools/dapple/a.c", '#include "../../scenes/scene.h"\n#include "command.h"\n', None),
    ("tools/dapple/a.c", '#include "scene.h"\n#include "job/jobs.h"\n', 2),
    ("tools/dapple/a.c", '#include "../../src/base/context.h"\n', 1),
    ("bench/a.c", '#include "../tools/dapple/command.h"\n', 1),
    ("test/unit/test_a.c", '#include "testing.h"\n#include "job/jobs.h"\n#include "scenes/scene.h"\n', None),
    ("test/unit/test_a.c", '#include "../../tools/dapple/command.h"\n', 1),
    ("src/job/a.c", "#include JOB_HEADER\n", 1),
    ("src/job/a.c", '#include "job/missing.h"\n', 1),
    ("src/base/a.c", '/*\n#include "job/jobs.h"\n*/\n// #include "job/jobs.h"\n', None),
    ("src/base/a.c", 'const char *a = "/*";\n#include "job/jobs.h"\nconst char *b = "*/";\n', 2),
]
EXAMPLE_FILES = {
    "include/dapple/context.h", "src/base/context.h", "src/os/thread.h", "src/os/machine.h", "src/job/jobs.h",
    "src/kernel/kernel.h", "src/field/field.h", "src/solver/solver.h", "src/cascade/level.h",
    "src/reference/trace.h", "src/vulkan/device.h", "src/api/handles.h", "src/attic/attic.h",
    "image/picture.h", "scenes/scene.h", "tools/dapple/command.h", "test/testing.h",
}


def self_test():
    wrong = []
    for path, text, line in EXAMPLES:
        found = list(complaints_about(path, text, EXAMPLE_FILES.__contains__))
        lines = [int(f.split(":")[1]) for f in found]
        if lines != ([line] if line else []):
            wrong.append(f"{path} {text!r}: expected {line or 'nothing'}, got {found or 'nothing'}")
    if cycle_in(ROOMS):
        wrong.append(f"the table runs in a circle: {cycle_in(ROOMS)}")
    if cycle_in({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": set()}) != ["a", "b", "c"]:
        wrong.append("a circle was not found")
    for complaint in wrong:
        print("self-test:", complaint)
    if not wrong:
        print(len(EXAMPLES), "made-up files judged rightly, the table has no circle")
    return 1 if wrong else 0


if __name__ == "__main__":
    if sys.argv[1:] not in ([], ["--self-test"]):
        sys.exit("usage: layering.py [--self-test]")
    sys.exit(self_test() if sys.argv[1:] else check_repository())
