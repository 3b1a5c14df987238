"""Reads public headers: what they declare, with the `///` comments.

A comment holds for the one declaration that follows it, or stands behind it as `///<`. What is
private is left out, and so are the bodies of functions.
"""

import dataclasses
import pathlib
import re

COMMENT = re.compile(r"^\s*///(?!<) ?(.*)$")
TRAILING = re.compile(r"///< ?(.*)$")
SCOPE = re.compile(r"^\s*(?:template <.*>\s*)?(namespace|class|struct|enum class)\s+([\w:]+)")
ACCESS = re.compile(r"^\s*(public|protected|private):")
NAME = re.compile(r"([A-Za-z_]\w*)\s*\(")
OPERATOR = re.compile(r"operator\s*\S+?\s*\(")
MEMBER = re.compile(r"([A-Za-z_]\w*)\s*(?:\[\w*\])*(?:=[^=]*|\{.*\})?[;,]")
SPECIFIERS = {"operator", "alignas", "noexcept", "decltype", "explicit"}


@dataclasses.dataclass
class Entry:
    """A declaration: of a scope (namespace, class, struct, enum) or of names in one."""

    scope: tuple  # names of what is around it, without anonymous ones
    kind: str  # namespace, class, struct, enum class, or "" for all else
    names: list
    code: list  # lines, without the comments and the body
    comment: list  # lines


def names_of(code):
    """The names one line of code declares; none for a line that goes on or calls."""
    code = code.strip()
    if not code or code.startswith(("#", "}", ")", ":", "return", "using", "friend")):
        return []
    call = NAME.search(code)
    if call and call.group(1) not in SPECIFIERS:
        return [call.group(1)] if " " in code[:call.start()] or code.startswith("explicit") else []
    flat = re.sub(r"<[^<>]*>", "", re.sub(r"\{[^{}]*\}", "", code))
    return [match.group(1) for match in MEMBER.finditer(flat)]


def bare(line):
    """A line of code without its comment, strings emptied."""
    return re.sub(r'"(\\.|[^"\\])*"', '""', re.sub(r"//.*$", "", line))


class Reader:
    """Goes through a header line by line and keeps what it declares."""

    def __init__(self):
        self.entries, self.scopes = [], []  # scopes: (name, depth, whether private by now)
        self.depth = self.parentheses = 0
        self.comment, self.fresh, self.open = [], False, None

    def read(self, text):
        for line in text.splitlines():
            held = COMMENT.match(line)
            if held:
                if self.parentheses == 0:
                    self.comment = self.comment + [held.group(1)] if self.fresh else [held.group(1)]
                    self.fresh = True
                continue
            self.fresh = False
            code, trailing = bare(line), TRAILING.search(line)
            if code.strip():
                self.take(line, code, trailing)
            elif not trailing:
                self.comment, self.open = [], None
            elif self.open:
                self.open.comment.append(trailing.group(1))
        return self.entries

    def take(self, line, code, trailing):
        access, scope = ACCESS.match(code), SCOPE.match(code)
        if access and self.scopes:
            name, depth, _ = self.scopes[-1]
            self.scopes[-1] = (name, depth, access.group(1) != "public")
        opens = scope and not code.rstrip().endswith(";")
        if opens:
            self.add(scope.group(1), [scope.group(2)], line, trailing)
        elif self.parentheses == 0 and self.direct():
            names = names_of(code)
            if names or OPERATOR.search(code):
                self.add("", names, line, trailing)
            else:
                self.open = None
        elif self.parentheses > 0 and self.open:
            self.open.code.append(line)
        self.count(code, scope)

    def direct(self):
        return not self.scopes or self.depth == self.scopes[-1][1] + 1

    def add(self, kind, names, line, trailing):
        self.open = Entry(tuple(n for n, _, _ in self.scopes if n), kind, names, [line],
                          [trailing.group(1)] if trailing else self.comment)
        if not any(private for _, _, private in self.scopes):
            self.entries.append(self.open)
        if names:
            self.comment = []

    def count(self, code, scope):
        if scope and "{" in code:
            self.scopes.append((scope.group(2), self.depth, scope.group(1) == "class"))
            self.comment = []
        self.parentheses += code.count("(") - code.count(")")
        self.depth += code.count("{") - code.count("}")
        while self.scopes and self.depth <= self.scopes[-1][1]:
            self.scopes.pop()


def read(header: pathlib.Path):
    return Reader().read(header.read_text(encoding="utf-8"))
