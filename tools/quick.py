#!/usr/bin/env python3
"""Builds and runs the unit tests of the modules that changed, and checks format and layers.

A module's tests are those of tests/X and those of the modules that name X as a dependency in
CMakeLists.txt. Changed is what differs from the commit BASE (default: HEAD), and what git does not
know yet. A change of the build itself runs every unit test. No sanitizers: `make sanitize` has them.

usage: quick.py [BASE]
"""

import os
import pathlib
import re
import subprocess
import sys
import time
import xml.etree.ElementTree

from check_layers import module_of

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build"
JOBS = str(os.cpu_count())
PROGRAM = ("apps", "viewer")  # what the program is made of beside the modules


def changed_files(base):
    """The files that are there and differ from `base`, relative to the root."""
    commands = (["git", "diff", "--name-only", "--relative", base],
                ["git", "ls-files", "--others", "--exclude-standard"])
    names = [name for command in commands for name in
             subprocess.run(command, cwd=ROOT, text=True, check=True,
                            stdout=subprocess.PIPE).stdout.splitlines()]
    return sorted({pathlib.Path(name) for name in names})


def dependencies():
    """Each module's direct dependencies, from the slalom_module lines."""
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return {name: set(re.findall(r"slalom_(\w+)", rest))
            for name, rest in re.findall(r"^slalom_module\((\w+)([^)]*)\)", text, re.MULTILINE)}


def modules_to_test(files, depends):
    """Modules whose tests the changes may fail."""
    if any(path.name == "CMakeLists.txt" or path.parts[0] == "cmake" for path in files):
        return set(depends)
    modules = set()
    for path in files:
        if path.parts[0] == "tests" and len(path.parts) > 2:
            modules.add(path.parts[1])  # a test asks for itself alone
        elif (module := module_of(path)) in depends:
            modules |= {module} | {name for name, of in depends.items() if module in of}
    return modules & set(depends)


def not_covered(files, depends):
    """Changed files that nothing here builds or tests, but `make test` does."""
    return [path for path in files if not modules_to_test([path], depends)
            and path.parts[0] not in PROGRAM and path.suffix != ".md"]


def step(title, command):
    print(f"== {title}", flush=True)
    return subprocess.run(command, cwd=ROOT, check=False).returncode == 0


def run_tests(modules):
    """(passed, failed) of the modules' unit tests; a program that does not end counts as failed."""
    passed = failed = 0
    for module in modules:
        program = BUILD / "tests" / f"test_{module}"
        if not program.exists():
            continue
        results = BUILD / f"quick-{module}.xml"
        results.unlink(missing_ok=True)
        start = time.monotonic()
        ended = subprocess.run([program, "--gtest_brief=1", f"--gtest_output=xml:{results}"],
                               cwd=BUILD / "tests", check=False)
        print(f"   {module}: {time.monotonic() - start:.1f} s", flush=True)
        if not results.exists():
            print(f"   test_{module} ended with {ended.returncode}")
            failed += 1
            continue
        root = xml.etree.ElementTree.parse(results).getroot()
        bad = int(root.get("failures")) + int(root.get("errors"))
        passed += int(root.get("tests")) - int(root.get("disabled")) - bad
        failed += bad or ended.returncode != 0
    return passed, failed


def main(arguments):
    files = changed_files(arguments[0] if arguments else "HEAD")
    depends = dependencies()
    modules = sorted(modules_to_test(files, depends))
    print(f"{len(files)} files changed; unit tests of: {', '.join(modules) or 'no module'}")
    if others := not_covered(files, depends):
        print("for `make test` alone: " + ", ".join(map(str, others)))

    sources = [str(path) for path in files
               if path.suffix in (".cpp", ".hpp") and (ROOT / path).exists()]
    checks = [step("layers", [sys.executable, "tools/check_layers.py"])]
    if sources:
        checks.append(step("format", ["tools/format.sh", "--check", *sources]))
    targets = [f"test_{module}" for module in modules if any(
        not path.name.endswith("_slow_test.cpp")
        for path in (ROOT / "tests" / module).glob("*_test.cpp"))]
    if any(path.parts[0] in PROGRAM for path in files):
        targets.append("slalom_app")
    if targets:
        checks.append(
            step("build", ["cmake", "--preset", "release", "-DSLALOM_TESTS=ON", "--log-level=WARNING"])
            and step("build", ["cmake", "--build", "build", "-j", JOBS, "--target", *targets]))
    passed = sum(checks)
    failed = len(checks) - passed
    if targets and checks[-1]:
        print("== unit tests", flush=True)
        good, bad = run_tests(modules)
        passed, failed = passed + good, failed + bad
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
