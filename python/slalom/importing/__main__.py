"""`python -m slalom.importing FORMAT FILE`, which `slalom import` runs: a scenario file from one of another format."""

from __future__ import annotations

import argparse
import pathlib
import sys
from typing import Callable

from slalom import Error

from . import BadFile, ExtraMissing, Scene, commonroad, track
from ._files import readable

OK, BAD_INPUT, NOT_WRITTEN = 0, 2, 3


def parser(program: str) -> argparse.ArgumentParser:
    """Of the command's arguments."""
    made = argparse.ArgumentParser(prog=program, description="Make a scenario file from a file of another format.")
    made.add_argument(
        "format",
        choices=("commonroad", "track"),
        help="commonroad: XML of version 2018b or 2020a; track: CSV x_m,y_m,w_tr_right_m,w_tr_left_m",
    )
    made.add_argument("file", type=pathlib.Path)
    made.add_argument(
        "--out",
        type=pathlib.Path,
        metavar="FILE",
        help="the scenario file; by default in the current folder, with the name of FILE",
    )
    made.add_argument("--force", action="store_true", help="replace a file that stands there already")
    made.add_argument("--quiet", action="store_true", help="print nothing but errors")
    made.add_argument("--vehicle", default="bmw_320i", metavar="NAME", help="built-in vehicle or a file")
    made.add_argument(
        "--problem", type=int, metavar="ID", help="of commonroad: the planning problem, by default the first"
    )
    made.add_argument(
        "--oncoming",
        choices=("never", "needed", "always"),
        default="needed",
        help="of commonroad: whether adjacent lanes of oncoming traffic are part of the road; needed: only where "
        "something stands in the way",
    )
    made.add_argument("--speed", type=float, default=15.0, metavar="U", help="of track: speed at the start [m/s]")
    made.add_argument(
        "--time", type=float, default=60.0, metavar="S", help="of track: drive as far as possible in this time [s]"
    )
    made.add_argument("--laps", type=int, metavar="N", help="of track: number of laps to drive instead")
    return made


def scene_of(arguments: argparse.Namespace) -> Scene:
    """What the arguments ask for."""
    if arguments.format == "track":
        return track(
            arguments.file, vehicle=arguments.vehicle, speed=arguments.speed, time=arguments.time, laps=arguments.laps
        )
    return commonroad(arguments.file, vehicle=arguments.vehicle, problem=arguments.problem, oncoming=arguments.oncoming)


def said(program: str, run: Callable[[], int]) -> int:
    """Runs it; an error becomes one line on stderr and the exit code that the program `slalom` has for it."""
    try:
        return run()
    except (OSError, ExtraMissing) as error:
        code = NOT_WRITTEN if isinstance(error, OSError) else BAD_INPUT
        message = str(error)
    except (ValueError, Error) as error:
        code, message = BAD_INPUT, str(error)
    print(f"{program.split()[0]}: {' '.join(message.split())}", file=sys.stderr)
    return code


def main(words: list[str] | None = None, program: str = "python -m slalom.importing") -> int:
    """Returns the exit code."""
    arguments = parser(program).parse_args(words)

    def run() -> int:
        with readable(arguments.file, "a file to import"):
            scene = scene_of(arguments)
        file = arguments.out or pathlib.Path(arguments.file.stem + ".yaml")
        scene.write(file, arguments.force)
        if not arguments.quiet:
            print(f"{file}: road of {len(scene.points)} points, {len(scene.obstacles)} obstacles")
            for note in scene.notes:
                print(f"  {note}")
        return OK

    return said(program, run)


if __name__ == "__main__":
    sys.exit(main())
