#!/usr/bin/env python3
"""Checks the direction of flow between the modules, and the size of their files.

Each module may include itself and those above it in LAYERS, and never another module's private
headers, except that sources of all may include those of SHARED_PRIVATE: vectors and aligned
memory of base serve the kernels of several modules, and installed they would tie users to
instruction sets; the parts of pages in report and of files in io serve sweep and paper. Module
NOT_PUBLIC has no public headers: the program alone uses it. A header include/slalom/X.hpp gathers
those of module X and belongs to it. Public headers keep the libraries of FORBIDDEN_IN_PUBLIC to the
sources. Files of every language, those of tests too, have MOST_LINES lines at the most.

usage: check_layers.py [ROOT]
"""

import pathlib
import re
import sys

LAYERS = ["base", "expr", "kkt", "nlp", "ocp", "problems", "vehicle", "world", "planner",
          "sim", "report", "io", "sweep", "paper", "apps"]
SHARED_PRIVATE = ("base", "report", "io")
NOT_PUBLIC = "paper"
FORBIDDEN_IN_PUBLIC = {"CLI": "CLI11", "yaml-cpp": "yaml-cpp"}
MOST_LINES = 400
SOURCES = ("include", "src", "apps", "tests", "python", "benchmarks", "examples", "tools", "viewer", "docs",
           "cmake")
SUFFIXES = (".hpp", ".cpp", ".py", ".js", ".mjs", ".css", ".html", ".sh", ".cmake")
NAMES = ("CMakeLists.txt", "Makefile")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def module_of(path):
    """The module of a file given relative to the root; None for a file outside the modules."""
    parts = path.parts
    if parts[:2] == ("include", "slalom"):
        return parts[2] if len(parts) > 3 else path.stem
    if parts[0] == "src" and len(parts) > 2:
        return parts[1]
    return "apps" if parts[0] == "apps" else None


def includes(text):
    """Pairs (line number, quoted?, path) of the #include lines of a source."""
    for number, line in enumerate(text.splitlines(), start=1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1) == '"', match.group(2)


def included_module(root, path, quoted, target):
    """The module whose header `path` includes, and whether the header is private."""
    if target.startswith("slalom/"):
        return module_of(pathlib.Path("include", target)), False
    if quoted:
        near = (root / path.parent / target).resolve()
        if near.is_relative_to(root.resolve()):
            return module_of(near.relative_to(root.resolve())), True
    return None, False


def check_include(root, path, number, quoted, target):
    """Messages about one #include line."""
    module = module_of(path)
    where = f"{path}:{number}"
    library = FORBIDDEN_IN_PUBLIC.get(target.split("/")[0])
    if path.parts[0] == "include" and library:
        yield f"{where}: public header includes {library} ({target}); keep it in src/{module}"
    other, private = included_module(root, path, quoted, target)
    if other is None or other == module:
        return
    if other not in LAYERS:
        yield f"{where}: {target} is of no known module"
    elif private and (other not in SHARED_PRIVATE or path.parts[0] == "include") and not (
            other == NOT_PUBLIC and module == "apps"):
        yield f"{where}: {module} includes a private header of {other} ({target})"
    elif LAYERS.index(other) > LAYERS.index(module):
        yield f"{where}: {module} includes {target}, but {other} stands below it"


def check_design(root):
    """Messages where the table of folders in docs/design.md differs from LAYERS."""
    page = root / "docs/design.md"
    if not page.exists():
        return
    told = re.findall(r"^\| `(\w+)` \|", page.read_text(encoding="utf-8"), flags=re.MULTILINE)
    if told != LAYERS:
        yield f"docs/design.md: its folders are {', '.join(told)}, not {', '.join(LAYERS)}"


def check_lengths(root):
    """Messages about sources that are too long; those that other tools brought are none of ours."""
    files = [root / name for name in NAMES if (root / name).exists()]
    for folder in SOURCES:
        files += sorted((root / folder).rglob("*"))
    for file in files:
        if (file.suffix not in SUFFIXES and file.name not in NAMES) or "node_modules" in file.parts:
            continue
        lines = file.read_text(encoding="utf-8").count("\n")
        if lines > MOST_LINES:
            yield f"{file.relative_to(root)}: {lines} lines, more than {MOST_LINES}"


def check(root):
    """Errors about the tree at `root`, and how many files were read."""
    errors = list(check_lengths(root))
    count = 0
    for folder in ("include", "src", "apps"):
        for file in sorted((root / folder).rglob("*.[ch]pp")):
            path = file.relative_to(root)
            text = file.read_text(encoding="utf-8")
            count += 1
            if module_of(path) not in LAYERS:
                errors.append(f"{path}: in no known module ({', '.join(LAYERS)})")
                continue
            if folder == "include" and module_of(path) == NOT_PUBLIC:
                errors.append(f"{path}: {NOT_PUBLIC} has no public headers")
            for line in includes(text):
                errors.extend(check_include(root, path, *line))
    errors.extend(check_design(root))
    if count == 0:
        errors.append(f"{root}: no sources found")
    return errors, count


def main(arguments):
    default = pathlib.Path(__file__).resolve().parent.parent
    errors, count = check(pathlib.Path(arguments[0]) if arguments else default)
    for error in errors:
        print(f"error: {error}")
    print(f"layers: {count} files, {len(errors)} errors")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
