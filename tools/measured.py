#!/usr/bin/env python3
"""The pages of docs/measured/: which target makes each and what it measures, the stamp that each begins
with, and what tools that write one share. Standard library only.

    tools/measured.py --check      says which pages are older than what they measure; a warning, no error
    tools/measured.py --targets    make's targets of all pages, in the order of `make docs-measured`; of those that
                                   need files from elsewhere, where TRACKS or FILES names their folder
"""

import argparse
import datetime
import functools
import hashlib
import os
import pathlib
import platform
import re
import subprocess
from typing import NamedTuple

ROOT = pathlib.Path(__file__).resolve().parents[1]
FOLDER = ROOT / "docs/measured"
PROGRAM = ROOT / "build/slalom"


class Page(NamedTuple):
    name: str  # of the file, without .md
    target: str  # make's
    tool: str  # what writes it; it counts among what is measured, and so do the modules that it imports
    measures: tuple  # paths, which may have stars; a commit that changes one makes the page stale
    needs: str = ""  # make's variable that names a folder of files which are not in the repository


def modules(names):
    return tuple(f"{folder}/{name}" for name in names.split() for folder in ("src", "include/slalom"))


def programs(names):
    """The sources of programs of benchmarks/, and what they share."""
    own = tuple(f"benchmarks/{name}.*pp" for name in names.split())
    return own + ("benchmarks/cycle_file.*pp", "benchmarks/planner_cycle.*pp", "benchmarks/command_line.hpp")


CONFIG = tuple(f"config/{kind}" for kind in ("scenarios", "planners", "vehicles"))
SOLVER = modules("base expr kkt nlp ocp")
PLANNER = SOLVER + modules("vehicle world planner") + CONFIG
DRIVE = PLANNER + modules("sim")
SWEEP = DRIVE + modules("sweep")
PAPER = ("src/paper", "config/paper")
CYCLES = DRIVE + programs("record solve")  # recorded from drives

# In the order in which `make docs-measured` makes them: the shortest first.
PAGES = (
    Page("results", "results", "tools/paper_pages.py", DRIVE + PAPER + modules("report")),
    Page("realtime", "realtime", "tools/realtime.py", DRIVE),
    Page("obstacle-choice", "obstacle-choice", "tools/obstacle_choice.py", DRIVE),
    Page("model-choice", "model-choice", "tools/model_choice.py", DRIVE),
    Page("latency", "latency", "tools/latency.py", SWEEP + ("config/studies/latency.yaml",)),
    Page("robustness", "robustness", "tools/robustness.py", SWEEP),
    Page("verdicts", "verdicts", "tools/paper_pages.py", SWEEP + PAPER + ("config/studies",)),
    Page("paper-index", "verdicts", "tools/paper_pages.py", SWEEP + PAPER + ("config/studies",)),
    Page("verified-planner", "verified-planner", "tools/verified_planner.py", SWEEP),
    Page("ablation", "ablation", "tools/planner_ablation.py", SWEEP),
    Page("random-scenarios", "random-scenarios", "tools/random_scenarios.py", SWEEP),
    Page("paper-sweep", "paper-sweep", "tools/paper_pages.py", SWEEP + PAPER + ("config/studies",)),
    Page("sensitivity", "sensitivity", "tools/sensitivity.py", SWEEP),
    Page("long-solves", "long-solves", "benchmarks/long_solves.py", PLANNER + ("benchmarks/long_casadi.py",)),
    Page("shape-forms", "shape-forms", "benchmarks/shape_forms.py", SOLVER + modules("world") + tuple(
        f"benchmarks/{name}.*pp" for name in ("shape_forms", "shape_rows", "shape_scenes", "smooth_box"))),
    Page("commonroad", "commonroad", "tools/commonroad_page.py", DRIVE + (
        "python/slalom/importing", "python/slalom/exporting", "tools/commonroad_check.py"), "FILES"),
    Page("solver-profile", "solver-profile", "benchmarks/profile.py", CYCLES + programs("interleaved")),
    Page("growth", "growth", "benchmarks/growth.py", CYCLES + programs("growth")),
    Page("kills", "kills", "tools/kills.py", modules("sweep") + ("apps/slalom",)),
    Page("sweep-scale", "sweep-scale", "benchmarks/sweep_scale.py", modules("sweep") + ("apps/slalom",)),
    Page("perturbed", "perturbed", "benchmarks/perturb.py", CYCLES + programs("perturb")),
    Page("peers", "peers", "benchmarks/ocp/peers.py", SOLVER + ("python/src", "python/slalom", "benchmarks/ocp")),
    Page("any-scenario", "any-scenario", "tools/any_scenario.py", SWEEP),
    Page("laps", "laps", "benchmarks/laps.py", DRIVE + programs("lap") + ("benchmarks/lap_casadi.py",), "TRACKS"),
    Page("belief-errors", "belief-errors", "tools/belief_errors.py", SWEEP),
    Page("benchmarks", "bench", "benchmarks/run.py", CYCLES + programs("judge functions") + (
        "benchmarks/peer_*.py", "benchmarks/planner_casadi.py", "benchmarks/shooting.py", "benchmarks/compiled.py",
        "benchmarks/time_casadi.py", "benchmarks/time_generated.c")),
)


def written_by(tool):
    """A tool and all that it imports of tools/ and its own folder, but for the stamp's own module."""
    found, left = [], [tool]
    while left:
        file = left.pop()
        found.append(file)
        for name in re.findall(r"(?m)^(?:from|import) (\w+)", (ROOT / file).read_text()):
            names = [f"{folder}/{name}.py" for folder in (pathlib.PurePath(file).parent, "tools")]
            other = next((name for name in names if (ROOT / name).is_file()), "tools/measured.py")
            if other not in (*found, *left, "tools/measured.py"):
                left.append(other)
    return tuple(found)


# --- the stamp ----------------------------------------------------------------------------------


def output_of(*command, default="unknown"):
    """What a command prints; `default` where it fails or prints nothing."""
    try:
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return default
    return done.stdout.strip() or default


# What is built or read without being named in the build: a file that git does not know yet counts there.
FOUND = ("src", "include", "apps", "viewer", "config")


def commit(root=ROOT):
    """Short hash of HEAD; with -dirty where the tree differs, generated pages aside."""
    head = output_of("git", "-C", root, "rev-parse", "--short", "HEAD")
    changed = output_of("git", "-C", root, "status", "--porcelain", "--untracked-files=no", "--", ".",
                        ":!docs/measured", default="")
    unknown = output_of("git", "-C", root, "ls-files", "--others", "--exclude-standard", "--", *FOUND, default="")
    return head + ("-dirty" if changed or unknown else "")


@functools.cache
def commit_at_start():
    """The commit when it was first asked for: a page's stamp has what its measuring began with, whatever was committed
    or changed meanwhile."""
    return commit()


def folder_of(program):
    """The folder in which measurements of a program are kept: a commit's; where the commit does not say which program it
    is, one for each program."""
    file = pathlib.Path(program)
    told = file.resolve() == PROGRAM.resolve() and not commit_at_start().endswith("-dirty")
    digest = hashlib.sha256(file.read_bytes()).hexdigest()[:8] if not told and file.is_file() else ""
    return ROOT / "run/measured" / "-".join(filter(None, (commit_at_start(), digest)))


def of_processor(field):
    """The first such field in /proc/cpuinfo, or nothing."""
    info = pathlib.Path("/proc/cpuinfo")
    for line in info.read_text().splitlines() if info.is_file() else ():
        name, _, value = line.partition(":")
        if name.strip() == field:
            return value.strip()
    return ""


def processor():
    """Model and number of cores."""
    return f"{of_processor('model name') or platform.processor() or 'unknown processor'}, {os.cpu_count()} cores"


def kernel_set():
    """The one that the program takes on this processor (src/base/kernels.cpp)."""
    return "avx2" if {"avx2", "fma"} <= set(of_processor("flags").split()) else "baseline"


def compiler(program):
    """The compiler that a program names in itself."""
    file = pathlib.Path(program)
    found = re.search(rb"GCC: \([^)]*\) [\d.]+|clang version [\d.]+|g\+\+ [\d.]+", file.read_bytes()) if file.is_file() else None
    return found[0].decode().replace("GCC: ", "g++ ") if found else "unknown compiler"


def stamp(command, program=PROGRAM, at=None):
    """The block that a generated page begins with: what makes it, and of what and on what it was
    measured; `at`: the commit, where it is not what is checked out."""
    return (f"*Written by `{command}`; do not edit. Measured at commit {at or commit_at_start()} on "
            f"{datetime.date.today()}: {processor()}, kernels {kernel_set()}, {compiler(program)}.*\n")


# --- stale pages --------------------------------------------------------------------------------


def stale(page, root=ROOT):
    """Why a page needs to be made anew, or nothing."""
    file = root / "docs/measured" / f"{page.name}.md"
    if not file.is_file():
        return "is not there"
    found = re.search(r"Measured at commit ([0-9a-f]+)(-dirty)?", file.read_text())
    if not found:
        return "has no stamp"
    since = output_of("git", "-C", root, "rev-list", "--count", f"{found[1]}..HEAD", "--", *page.measures,
                      *written_by(page.tool))
    if since == "unknown":
        return f"was measured at {found[1]}, which is not in the history"
    if since != "0":
        return f"was measured at {found[1]}; commits since to what it measures: {since}"
    return f"was measured at {found[1]} with changes not committed" if found[2] else ""


def check(root=ROOT):
    """What to say of the pages, line by line."""
    shallow = output_of("git", "-C", root, "rev-parse", "--is-shallow-repository")
    if shallow != "false":
        return ["measured: no history here to compare the pages with"]
    lines = [f"{page.name}.md {why} (make {page.target}{f' {page.needs}=folder' if page.needs else ''})"
             for page in PAGES if (why := stale(page, root))]  # fmt: skip
    return [f"measured: {len(PAGES) - len(lines)} of {len(PAGES)} pages are up to date", *lines]


def targets(given):
    """Make's targets, once each, but those whose folder of files is not given."""
    return list(dict.fromkeys(page.target for page in PAGES if not page.needs or given.get(page.needs)))


# --- what tools share ---------------------------------------------------------------------------


class PageParser(argparse.ArgumentParser):
    """Keeps what is measured in a folder of the commit, or of the program, unless --work names another."""

    def parse_args(self, *arguments):
        options = super().parse_args(*arguments)
        if getattr(options, "work", "") is None:
            options.work = folder_of(options.program) / self.page
        return options


def page_parser(name, doc, keeps="goes on with what was measured there"):
    """The command line of a tool that writes the page `name`. With `keeps`, what --work is for, what it measured stays
    there."""
    parser = PageParser(description=doc.split("\n\n")[0])
    parser.page = name
    commit_at_start()
    parser.add_argument("--program", default=str(PROGRAM))
    parser.add_argument("--out", type=pathlib.Path, default=FOLDER / f"{name}.md")
    if keeps:
        parser.add_argument("--work", type=pathlib.Path, help=keeps + " (default: a folder of this commit in run/measured/)")
    return parser


def command_of(parser, options, target, *names, given=""):
    """What makes a page of these options, of which `names` change it: its target, or the tool with those that differ
    from their defaults, behind what is `given` to it without a name: a folder, for a target with a variable, such as
    "laps TRACKS=folder"."""
    words = []
    for name in names:
        value = getattr(options, name)
        if value != parser.get_default(name):
            values = [] if value is True else value if isinstance(value, list) else [value]
            words += ["--" + name.replace("_", "-"), *values]
    if not words:
        return f"make {target}"
    given = given or ("FOLDER" if "=" in target else "")
    folder = "benchmarks" if (ROOT / "benchmarks" / parser.prog).is_file() else "tools"
    return " ".join(map(str, [f"{folder}/{parser.prog}", *given.split(), *words]))


def write(file, text):
    """Whole or not at all."""
    file.parent.mkdir(parents=True, exist_ok=True)
    aside = file.with_suffix(".part")
    aside.write_text(text)
    aside.rename(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--check", action="store_true", help="say which pages are stale")
    what.add_argument("--targets", action="store_true", help="print make's targets")
    if parser.parse_args().check:
        print("\n".join(check()))
    else:
        print(" ".join(targets(os.environ)))


if __name__ == "__main__":
    main()
