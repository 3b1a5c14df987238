#!/usr/bin/env python3
"""Says what a wheel built for this machine needs of it, and fails where the portable wheel could not have that.

usage: wheel_needs.py WHEEL, by a Python that has auditwheel

`make wheel` takes minutes, so tests build a wheel of the system's libraries instead. What auditwheel says of that one tells
most of what would go wrong with the other: a library from outside that tools/portable.sh does not put inside, and a
function of the C library that the oldest one lacks. Versions of symbols alone do not tell: a compiler asks for the newest
version of a function that it finds, so that a function counts as new only if this machine's C library has no older one."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import zipfile

OLDEST = (2, 28)
# What tools/portable.sh compiles in, and SLEEF, which `auditwheel repair` puts in.
INSIDE = {"libfmt", "libsleef", "libsqlite3", "libyaml-cpp"}
# Functions that older C libraries have, too, by other names: their headers call those.
RENAMED = re.compile(r"^(f|l|)stat(64|at|at64|)$|^mknod(at|)$|^__isoc23_")
# What GCC's C++ library asks for, in headers and only where it is there; the portable wheel has another one.
OF_GCC = {"__libc_single_threaded", "pthread_cond_clockwait"}


def version_of(name):
    """The number in a symbol's version, GLIBC_2.2.5; None for others."""
    found = re.fullmatch(r"GLIBC_(\d+(?:\.\d+)+)", name or "")
    return tuple(int(part) for part in found[1].split(".")) if found else None


def unforeseen(libraries):
    """Of the names of libraries (libfmt.so.9) those that the portable wheel has not inside."""
    return sorted(name for name in libraries if name.split(".so")[0] not in INSIDE)


def too_new(wanted, exported):
    """Functions, with their versions, that no C library as old as OLDEST has.

    wanted: (name, version) pairs; exported: the versions of each name in this machine's libraries."""
    def is_new(version):
        number = version_of(version)
        return number is not None and number > OLDEST

    return sorted(f"{name}@{version}" for name, version in set(wanted)
                  if is_new(version) and not RENAMED.match(name) and name not in OF_GCC
                  and all(is_new(other) for other in exported.get(name, [version])))  # fmt: skip


def versioned_symbols(path, defined):
    """(name, version) of the symbols that a file defines, or that it wants of others."""
    from elftools.elf.elffile import ELFFile

    with open(path, "rb") as stream:
        elf = ELFFile(stream)
        symbols = elf.get_section_by_name(".dynsym")
        numbers = elf.get_section_by_name(".gnu.version")
        names = {}
        table = elf.get_section_by_name(".gnu.version_d" if defined else ".gnu.version_r")
        for entry, auxiliaries in table.iter_versions() if table else ():
            if defined:
                names[entry["vd_ndx"]] = next(auxiliaries).name
            else:
                names.update({one["vna_other"]: one.name for one in auxiliaries})
        for number, symbol in enumerate(symbols.iter_symbols() if symbols and numbers else ()):
            if (symbol["st_shndx"] == "SHN_UNDEF") == defined:
                continue
            index = numbers.get_symbol(number)["ndx"]
            if isinstance(index, int) and index & 0x7FFF in names:
                yield symbol.name, names[index & 0x7FFF]


def elf_files(folder):
    for path in sorted(pathlib.Path(folder).rglob("*")):
        if path.is_file() and path.open("rb").read(4) == b"\x7fELF":
            yield path


def system_library(name):
    """Where the loader finds it, as ldconfig lists it."""
    listed = subprocess.run(["/sbin/ldconfig", "-p"], capture_output=True, text=True, check=True).stdout
    return re.search(rf"{re.escape(name)} .*64.* => (\S+)", listed)[1]


def main():
    wheel = sys.argv[1]
    shown = subprocess.run([sys.executable, "-m", "auditwheel", "show", "--json", wheel], stdout=subprocess.PIPE,
                           stderr=subprocess.DEVNULL, text=True, check=True).stdout  # fmt: skip
    libraries = json.loads(shown)["external_libs"]
    exported = {}
    for library in ("libc.so.6", "libm.so.6"):
        for name, version in versioned_symbols(system_library(library), True):
            exported.setdefault(name, set()).add(version)
    wanted = set()
    with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder)
        for path in elf_files(folder):
            wanted.update(versioned_symbols(path, False))
    oldest = ".".join(map(str, OLDEST))
    print(f"{pathlib.Path(wheel).name} needs {', '.join(sorted(libraries)) or 'no library'}, and "
          f"{sum(version_of(version) is not None for _, version in wanted)} functions of glibc")  # fmt: skip
    wrong = [f"needs {name}, which tools/portable.sh does not put into the portable wheel"
             for name in unforeseen(libraries)]  # fmt: skip
    wrong += [f"needs {name}, which glibc {oldest} lacks" for name in too_new(wanted, exported)]
    for line in wrong:
        print(f"wheel: {line}")
    return 1 if wrong or not wanted else 0


if __name__ == "__main__":
    sys.exit(main())
