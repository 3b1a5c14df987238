#!/usr/bin/env python3
"""Finishes the generated type stub: what nanobind cannot know of the extension.

Where an expression is taken, a number does as well, and arrays where sequences of numbers are;
other arguments that are options are objects; exceptions have attributes, the module a version.

usage: stub.py GENERATED OUT
"""

import pathlib
import re
import sys

# Parameters that name a symbol: a number cannot.
SYMBOLS = r"(?!state\b|parameter\b)"


INVALID = r'(class InvalidValue\(Error, ValueError\):\n    """.*?"""\n)'
ATTRIBUTES = "".join(f"    {name}: str\n" for name in ("where", "found", "expected"))


def finish(text: str) -> str:
    text = re.sub(rf"\b{SYMBOLS}(\w+): Expr(?=[,)])", r"\1: Expr | float", text)
    text = re.sub(r"(?<!list\[)Sequence\[float\]", "Sequence[float] | NDArray[numpy.float64]", text)
    text, found = re.subn(INVALID, r"\1" + ATTRIBUTES, text, flags=re.S)
    assert found == 1, "no InvalidValue in the stub"
    text = re.sub(r"(\*\*?\w+)(?=[,)])", r"\1: object", text)
    text = re.sub(r"\bPathLike\b(?!\[)", "PathLike[str]", text)
    text = text.replace("def __str__(self, /):", "def __str__(self, /) -> str:")
    text = re.sub(r"^(\w+_names: tuple)\b.*$", r"\1[str, ...]", text, flags=re.M)
    return text + "\n__version__: str\n"


def main() -> None:
    generated, out = map(pathlib.Path, sys.argv[1:])
    out.write_text(finish(generated.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
