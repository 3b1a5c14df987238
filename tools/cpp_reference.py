#!/usr/bin/env python3
"""Writes the reference of the public headers as Markdown, one page a module and an index.

usage: cpp_reference.py --out FOLDER INCLUDE      INCLUDE: include/slalom
"""

import argparse
import pathlib
import re
import textwrap

import headers


def signature(entry):
    """The declaration without comments and body."""
    lines = [re.sub(r"\s*//.*$", "", line) for line in entry.code]
    text = textwrap.dedent("\n".join(lines)).strip()
    if entry.kind:
        return text.split("{")[0].strip()
    # A body or initialisers end a function's declaration; a member's value is part of it.
    match = re.match(r"(?s)(.*\)(?: const)?(?: noexcept)?(?: override)?)\s*(?::[^:].*|\{.*)$", text)
    return (match.group(1) + ";") if match and "(" in text else text


def prose(comment):
    """A comment as Markdown: what is indented stands as it is."""
    out, formula = [], False
    for line in comment:
        if line.startswith("  ") != formula and line.strip():
            formula = not formula
            out.append("```text" if formula else "```")
        out.append(line)
    return "\n".join(out + ["```"] * formula)


def sections(entries):
    """Each declaration with its comment, a heading before a type; neighbours without comment in one
    block."""
    block = []

    def flush():
        if block:
            yield "```cpp\n" + "\n".join(block) + "\n```\n"
        block.clear()

    for entry in entries:
        if entry.kind == "namespace" or (entry.kind and not entry.comment):
            continue
        if entry.kind:
            yield from flush()
            name = "::".join((*entry.scope, *entry.names[:1])).removeprefix("slalom::")
            yield f"### {name}\n"
        elif entry.comment:
            yield from flush()
        block.append(signature(entry))
        if entry.comment:
            yield from flush()
            yield prose(entry.comment) + "\n"
    yield from flush()


def page(module, files, root):
    parts = [f"# {module}\n"]
    for header in files:
        parts.append(f"## slalom/{header.relative_to(root)}\n")
        parts.extend(sections(headers.read(header)))
    return "\n".join(parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("include", type=pathlib.Path)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    modules = sorted(folder.name for folder in arguments.include.iterdir() if folder.is_dir())
    index = ["# C++", "", "The public headers, folder by folder; each folder knows only those above it "
             "([design](../design.md)).", "", "```{toctree}"]
    for module in modules:
        files = sorted((arguments.include / module).glob("*.hpp"))
        (arguments.out / f"{module}.md").write_text(page(module, files, arguments.include),
                                                    encoding="utf-8")
        index.append(module)
    (arguments.out / "index.md").write_text("\n".join(index + ["```", ""]), encoding="utf-8")


if __name__ == "__main__":
    main()
