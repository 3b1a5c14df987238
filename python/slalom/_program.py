"""The command line `slalom`: the C++ program that lies in this package takes the place of Python."""

import os
import pathlib
import sys


def main() -> None:
    os.environ.setdefault("SLALOM_PYTHON", sys.executable)  # for what it does by this package
    program = pathlib.Path(__file__).parent / "bin" / "slalom"
    os.execv(program, [program, *sys.argv[1:]])
