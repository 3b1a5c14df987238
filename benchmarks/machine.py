"""What is timed beside ours, by versions and kernel sets; the stamp of a page has the processor."""

import os
import platform
import re
from pathlib import Path

from compiled import COMPILER
from contestants import BUILD, PEERS, WHEEL, python
from measured import output_of


def wheel_version(library):
    """Version in the name of a library the CasADi wheel carries."""
    for path in PEERS.glob(f"lib/python*/site-packages/casadi/{library}.so.*.*"):
        return path.name.split(".so.")[1]
    return "unknown"


def blasfeo_target(folder):
    """The kernels BLASFEO was built for, from its own header."""
    for header in Path(folder).rglob("blasfeo_target.h"):
        found = re.search(r"#define TARGET_((?!NEED)\w+)", header.read_text())
        if found:
            return found[1].lower()
    return "unknown"


def package_version(name):
    code = f"from importlib.metadata import version; print(version('{name}'))"
    return output_of(python(), "-c", code)


def acados_version():
    for folder in WHEEL.glob("comma_deps_acados-*.dist-info"):
        return folder.name.split("-")[1].removesuffix(".dist")
    return "unknown"


def describe():
    casadi_folder = next(PEERS.glob("lib/python*/site-packages/casadi"), BUILD)
    return {
        "system": output_of("sh", "-c", ". /etc/os-release && echo $PRETTY_NAME")
        + f", Linux {platform.release().split('-')[0]}",
        "load before the run": f"{os.getloadavg()[0]:.2f}",
        "compiler": output_of("g++", "--version").splitlines()[0],
        "SLEEF": output_of("pkg-config", "--modversion", "sleef"),
        "CasADi": f"{package_version('casadi')} (wheel); C by `{COMPILER}`",
        "CasADi's Ipopt": f"{wheel_version('libipopt')}, MUMPS interface "
        f"{wheel_version('libcoinmumps')}, OpenBLAS, one thread",
        "CasADi's fatrop": f"{wheel_version('libfatrop')}, BLASFEO built for "
        f"**{blasfeo_target(casadi_folder)}** (the wheel's)",
        "acados": f"wheel comma-deps-acados {acados_version()}, HPIPM, BLASFEO built for "
        f"{blasfeo_target(WHEEL)}",
    }
