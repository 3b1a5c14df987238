"""The command line `slalom`: the C++ program that lies in this package takes the place of Python."""

import os
import pathlib
import sys


def main() -> None:
    program = pathlib.Path(__file__).parent / "bin" / "slalom"
    os.execv(program, [program, *sys.argv[1:]])
