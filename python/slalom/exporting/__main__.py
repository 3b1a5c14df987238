"""`python -m slalom.exporting FORMAT FOLDER`, which `slalom export` runs: a drive in another format."""

from __future__ import annotations

import argparse
import pathlib
import sys

from ..importing.__main__ import OK, said
from . import BadFile, commonroad_solution, mcap, rerun

FILES = {"mcap": "drive.mcap", "rerun": "drive.rrd", "commonroad": "solution.xml"}


def parser(program: str) -> argparse.ArgumentParser:
    """Of the command's arguments."""
    made = argparse.ArgumentParser(prog=program, description="Write the drive of a results folder in another format.")
    made.add_argument(
        "format", choices=tuple(FILES), help="mcap: for Foxglove; rerun: for Rerun; commonroad: a solution, as XML"
    )
    made.add_argument("folder", type=pathlib.Path, help="results of 'slalom simulate'")
    made.add_argument(
        "--out", type=pathlib.Path, metavar="FILE", help="by default " + ", ".join(FILES.values()) + " in the folder"
    )
    made.add_argument("--force", action="store_true", help="replace a file that stands there already")
    made.add_argument("--quiet", action="store_true", help="print nothing but errors")
    made.add_argument(
        "--scenario",
        type=pathlib.Path,
        metavar="XML",
        help="of commonroad: what the drive's scenario was imported from",
    )
    made.add_argument(
        "--problem", type=int, metavar="ID", help="of commonroad: the planning problem, by default the first"
    )
    made.add_argument("--cost", default="JB1", help="of commonroad: the cost function it is entered for")
    return made


def main(words: list[str] | None = None, program: str = "python -m slalom.exporting") -> int:
    """Returns the exit code."""
    arguments = parser(program).parse_args(words)

    def run() -> int:
        file = arguments.out or arguments.folder / FILES[arguments.format]
        if arguments.format == "commonroad":
            if arguments.scenario is None:
                raise BadFile(
                    "export commonroad",
                    "no --scenario",
                    "the CommonRoad XML that the drive's scenario was imported from",
                )
            commonroad_solution(
                arguments.folder,
                file,
                scenario=arguments.scenario,
                problem=arguments.problem,
                cost=arguments.cost,
                force=arguments.force,
            )
        else:
            (mcap if arguments.format == "mcap" else rerun)(arguments.folder, file, force=arguments.force)
        if not arguments.quiet:
            print(f"written to {file}")
        return OK

    return said(program, run)


if __name__ == "__main__":
    sys.exit(main())
