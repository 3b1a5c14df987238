#!/usr/bin/env python3
"""Puts sources into batches that compile as one: headers are then read once a batch, not once a file.

Names of an unnamed namespace are a file's own. Two files share a batch only if neither mentions,
in any sense, a name the other keeps to itself, nor includes a header of the project that declares
it, and both use the same namespaces; so a batch means what its files mean alone. Kernels (*_avx512.cpp, *_avx2.cpp,
*_baseline.cpp) are compiled by themselves.

usage: batches.py FILE...     one batch a line, its files with '|' between them
"""

import functools
import pathlib
import re
import sys

INCLUDE_FOLDERS = [pathlib.Path(__file__).resolve().parent.parent / name
                   for name in ("include", "tests")]
MOST_FILES = 8
ALONE = re.compile(r"_(avx512|avx2|baseline)\.cpp$")
COMMENTS_AND_STRINGS = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"', re.DOTALL)
INCLUDE = re.compile(r'^#include "(.+)"', re.MULTILINE)
WORD = re.compile(r"[A-Za-z_]\w*")
TYPE = re.compile(r"^(?:template <.*> )?(?:struct|class|union|enum class|enum) (?:\[\[.*\]\] )?(\w+)")
ALIAS = re.compile(r"^(?:using|namespace) (\w+) =|^using .*::(\w+);")
DIRECTIVE = re.compile(r"^using namespace ([\w:]+)", re.MULTILINE)
ASSIGNED = re.compile(r"(\w+)(?:\[[^\]]*\])* =")
VARIABLE = re.compile(r"(\w+)(?:\[[^\]]*\])*[{;,]")
MACROS = ("TEST", "INSTANTIATE_TEST_SUITE_P")
FUNCTION = re.compile(r"(\w*[a-z]\w*)\(")  # but no macro


class Source:
    """What a file mentions, and what it keeps to itself: names, and aliases with their lines."""

    def __init__(self, path):
        self.path = path
        whole = pathlib.Path(path).read_text(encoding="utf-8")
        text = COMMENTS_AND_STRINGS.sub('""', whole)
        self.included = included(pathlib.Path(path).parent.resolve(), whole)
        self.alone = bool(ALONE.search(str(path)))
        self.directives = set(DIRECTIVE.findall(text))
        self.words = set(WORD.findall(text))
        self.own = set(re.findall(r"^#\s*define (\w+)", text, re.MULTILINE))
        self.aliases = {}
        unnamed = False
        # The format puts what stands in a namespace, and nothing else, at the start of a line.
        for line in text.splitlines():
            if line == "namespace {":
                unnamed = True
            elif line.startswith('}  ""'):  # the comment that names the namespace
                unnamed = False
            elif alias := ALIAS.match(line):
                self.aliases[alias[1] or alias[2]] = line
            elif WORD.match(line) and not DIRECTIVE.match(line) and (unnamed or line.startswith(("static ", "inline "))):
                self.own.update(declared(line))

    def clashes(self, other):
        return (self.alone or other.alone or self.directives != other.directives or
                self.disturbs(other) or other.disturbs(self))

    def disturbs(self, other):
        """Whether a name this file gives a meaning could be found where `other` means another."""
        return bool(self.own & (other.words | (other.included - self.included))) or any(
            name in other.words and other.aliases.get(name) != line
            for name, line in self.aliases.items())


def included(folder, text):
    """The names that the headers included by a text in `folder` declare outside classes."""
    candidates = [[near / name for near in (folder, *INCLUDE_FOLDERS)]
                  for name in INCLUDE.findall(text)]
    found = [next((path.resolve() for path in paths if path.exists()), None) for paths in candidates]
    return frozenset().union(*(offered(path) for path in found if path))


@functools.cache
def offered(header):
    """The names that a header and those it includes declare outside classes."""
    whole = header.read_text(encoding="utf-8")
    text = COMMENTS_AND_STRINGS.sub('""', whole)
    own = {name for line in text.splitlines() if WORD.match(line) for name in declared(line)}
    return included(header.parent, whole) | own


def declared(line):
    """The names that a declaration's first line declares."""
    if match := TYPE.match(line):
        return [match[1]]
    if line.startswith(MACROS):
        return []
    if (match := FUNCTION.search(line)) and "=" not in line[:match.start()]:
        return [match[1]]
    return ASSIGNED.findall(line) or VARIABLE.findall(line)


def batches(paths):
    """Lists of paths; each file goes into the first batch with room where nothing clashes."""
    made = []
    for source in map(Source, paths):
        fitting = (batch for batch in made if len(batch) < MOST_FILES and
                   not any(source.clashes(file) for file in batch))
        batch = next(fitting, None)
        if batch is None:
            made.append(batch := [])
        batch.append(source)
    return [[source.path for source in batch] for batch in made]


if __name__ == "__main__":
    for files in batches(sys.argv[1:]):
        print("|".join(files))
