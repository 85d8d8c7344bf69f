#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The library as two files: amalgamate.py OUTPUT_FOLDER SOURCE.c... [--kinds KINDS.h]

Writes accel.c, which is all sources one after the other, and accel.h, the interface. What a source
keeps to itself gets the source's name as a prefix, as all of them share one file now: functions and
variables that are static, types, constants, and its macros, which end with it.

It rests on how the sources are laid out (.clang-format): what belongs to a file begins in the
first column. A name that is missed is a compiler's error, not another meaning.
"""
import argparse
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent
TOKEN = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|[A-Za-z_]\w*'
                   r'|->|\s+|\d[\w.]*|.', re.S)
INCLUDE = re.compile(r'^#include\s+(?:"([^"]+)"|(ACCEL_KINDS_FILE))[^\n]*\n', re.M)
GUARD = re.compile(r'^#ifndef (ACCEL_\w+_H)\n#define \1\n', re.M)
TYPES = ("struct", "enum", "union")
TOP = """/* SPDX-License-Identifier: Apache-2.0
 *
 * accel {version}: the library in one file, made from its sources by accel/amalgamate.py.
 * Compile it as C11 with -ffp-contract=off, or accel_build refuses; link libm and pthreads.
 */
#if !defined(_GNU_SOURCE)
#define _GNU_SOURCE
#endif
"""


def without_license(text):
    """A file without the line that names its license, which its first comment begins with."""
    return re.sub(r"\A/\* SPDX-License-Identifier: Apache-2.0(?: \*/\n|\n( \*\n)?)",
                  lambda m: "" if "*/" in m.group() else "/*\n", text)


class Library:
    """All sources, as one text."""

    def __init__(self, kinds):
        self.kinds = kinds
        self.seen = set()
        self.headers = []

    def find(self, name, base):
        for folder in (base, ROOT / "include"):
            path = (folder / name).resolve()
            if path.exists():
                return path
        raise SystemExit(f"amalgamate.py: {base}: no {name} there")

    def expand(self, path):
        """The text of a file with what it includes; guarded headers go to self.headers instead."""
        text = without_license(path.read_text())

        def included(match):
            if match.group(2):
                return self.kinds.read_text()
            inner = self.find(match.group(1), path.parent)
            if inner == ROOT / "include/accel/accel.h":
                return ""
            if not GUARD.search(inner.read_text()):
                return self.expand(inner)
            if inner not in self.seen:
                self.seen.add(inner)
                self.headers.append(self.expand(inner))
            return ""

        return INCLUDE.sub(included, text)

    def add(self, path):
        text = re.sub(r"^#define _(?:GNU|POSIX_C|DEFAULT)_SOURCE[^\n]*\n", "", self.expand(path), flags=re.M)
        return own(text, f"{path.parent.name}_{path.stem}_")


def names_of(text):
    """What a file declares for itself: (types, values, macros)."""
    bare = re.sub(r"/\*.*?\*/", lambda m: "\n" * m.group().count("\n"), text, flags=re.S)
    macros = set(re.findall(r"^#\s*define (\w+)", bare, re.M))
    code = re.sub(r"^#(?:\\\n|[^\n])*\n", "", bare, flags=re.M)
    types, values = set(), set()
    for begin in re.finditer(r"^(?=[A-Za-z_])", code, re.M):
        head = re.match(r"[^{;=]*", code[begin.start():]).group()
        rest = code[begin.start() + len(head):]
        head = re.sub(r"__attribute__\(\((?:[^()]|\([^()]*\))*\)\)", "", head).strip()
        tag = re.match(r"(?:typedef |static |const )*(struct|enum|union)\s*(\w*)\s*$", head)
        if tag and rest.startswith("{"):
            if tag.group(2):
                types.add(tag.group(2))
            if tag.group(1) == "enum":
                values |= set(re.findall(r"(\w+)\s*(?=[,=}])", rest[1:rest.index("}") + 1]))
        name = (re.match(r"[A-Z_]+\((\w+)\)", head) or re.search(r"(\w+)\s*\(", head) or
                re.search(r"(\w+)(?:\[[^\]]*\])*\s*$", head))
        if not (tag and rest.startswith("{")) and name and not head.startswith("extern"):
            values.add(name.group(1))
    values |= set(re.findall(r"^(?:typedef [^;{]*?|\} )(\w+);", code, re.M))
    values = {v for v in values if not v.startswith(("accel_", "_Static", "KIND")) and not v.isdigit()}
    return types, values - macros, macros


def members(text):
    """The places of the bodies of structs and unions."""
    return [(m.start(), m.end()) for m in
            re.finditer(r"^(?:static |const |typedef )*(?:struct|union)[ \w]*\{.*?^\}", text, re.M | re.S)]


def own(text, prefix):
    types, values, macros = names_of(text)
    bodies = members(text)
    out, at, before = [], 0, [""] * 4
    for token in TOKEN.findall(text):
        word = token
        member = before[-1] in (".", "->") or before[0] == "offsetof" or (
            any(a <= at < z for a, z in bodies) and declares(text, at + len(token)))
        if before[-1] in TYPES:
            word = prefix + token if token in types else token
        elif token in values and not member:
            word = prefix + token
        out.append(word)
        at += len(token)
        if not token.isspace() and not token.startswith("/*"):
            before = before[1:] + [token]
    ends = "".join(f"#undef {m}\n" for m in sorted(macros))
    return "".join(out) + ends


def declares(text, end):
    """Is the word that ends there, in a struct, the name of a member, not a type or constant?"""
    return re.match(r"\s*(?:\[[^\]]*\]\s*)*[;,)]", text[end:]) is not None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("sources", nargs="+", type=pathlib.Path)
    parser.add_argument("--kinds", type=pathlib.Path, default=ROOT / "src/kinds/kinds.h")
    args = parser.parse_args()
    library = Library(args.kinds)
    bodies = [library.add(source.resolve()) for source in args.sources]
    header = (ROOT / "include/accel/accel.h").read_text()
    version = ".".join(re.findall(r"#define ACCEL_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header))
    args.folder.mkdir(parents=True, exist_ok=True)
    text = TOP.replace("{version}", version) + '#include "accel.h"\n' + "".join(library.headers + bodies)
    (args.folder / "accel.c").write_text(text)
    (args.folder / "accel.h").write_text(header)


if __name__ == "__main__":
    main()
