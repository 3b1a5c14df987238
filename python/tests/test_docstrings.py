"""Docstrings, most of which are comments of C++ headers, say what Python has."""

import inspect
import re

from slalom import _core

CPP = re.compile(r"\w*::\w*|\b[Tt]hrow(?:s|n)?\b|\bsolved\(\)")


def test_no_docstring_speaks_cpp():
    things = dict(inspect.getmembers(_core))
    for name, thing in list(things.items()):
        if inspect.isclass(thing):
            things |= {f"{name}.{member}": value for member, value in vars(thing).items()}
    texts = {name: inspect.getdoc(thing) or "" for name, thing in things.items()}
    assert sum(map(bool, texts.values())) > 200
    assert {name: words for name, text in texts.items() if (words := CPP.findall(text))} == {}
