#!/usr/bin/env python3
"""Runs the Python blocks of Markdown pages, and compares what each prints with the text block after it.

The blocks of a page share their names, from top to bottom. A block that prints something must have a
text block after it, and that must be what it prints. Pages without Python blocks are passed over.
Needs the package slalom with its extras.

usage: doc_blocks.py [--write] PAGE...      --write puts what was printed into the pages
"""

import argparse
import contextlib
import io
import pathlib
import re
import sys
import traceback

# A block, and the text block that may follow it.
BLOCK = re.compile(r"^```python\n(?P<code>.*?)^```\n(?:\n^```text\n(?P<text>.*?)^```\n)?", re.S | re.M)


def run(code, names, where):
    """What one block prints; lines of a traceback are those of the page."""
    name, line = where
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile("\n" * line + code, name, "exec"), names)
    return printed.getvalue()


def check(page, write):
    """Messages about a page, and how many blocks it has."""
    text, names, messages, count = page.read_text(encoding="utf-8"), {}, [], 0

    def replace(match):
        nonlocal count
        count += 1
        line = text.count("\n", 0, match.start()) + 1
        printed = run(match["code"], names, (str(page), line))
        if printed != (match["text"] or ""):
            messages.append(f"{page}:{line}: prints\n{printed}not\n{match['text'] or ''}")
        shown = f"\n```text\n{printed}```\n" if printed else ""
        return f"```python\n{match['code']}```\n{shown}"

    try:
        new = BLOCK.sub(replace, text)
    except Exception:
        return [traceback.format_exc(limit=-2)], count
    if write and new != text:
        page.write_text(new, encoding="utf-8")
        return [], count
    return messages, count


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true")
    parser.add_argument("pages", nargs="+", type=pathlib.Path)
    arguments = parser.parse_args()
    with contextlib.suppress(ImportError):
        import matplotlib
        matplotlib.use("Agg")
    failed = total = 0
    for page in arguments.pages:
        messages, count = check(page, arguments.write)
        print("\n".join(messages), end="\n" if messages else "")
        failed += bool(messages)
        total += count
    print(f"doc_blocks: {total} blocks, {failed} pages that are wrong")
    return 1 if failed or total == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
