"""C that CasADi generated, compiled once for each text, compiler and processor."""

import hashlib
import os
import subprocess
import sys
import time

COMPILER = "gcc -O3 -march=native"


def compile_c(name, compiler=COMPILER):
    """NAME.so from NAME.c, unless it is there from the same. Returns seconds of compilation."""
    version = subprocess.run([compiler.split()[0], "--version"], capture_output=True).stdout
    with open(f"{name}.c", "rb") as source, open("/proc/cpuinfo") as info:
        flags = next((line for line in info if line.startswith("flags")), "")
        parts = [source.read(), compiler.encode(), version, flags.encode()]
    key, stamp = hashlib.sha256(b"\0".join(parts)).hexdigest(), f"{name}.stamp"
    if os.path.exists(stamp) and os.path.exists(f"{name}.so"):
        with open(stamp) as file:
            before, _, seconds = file.read().partition(" ")
        if before == key:
            return float(seconds)
    began = time.time()
    subprocess.run([*compiler.split(), f"{name}.c", "-o", f"{name}.so", "-shared", "-fPIC",
                    "-lm"], check=True)  # fmt: skip
    seconds = time.time() - began
    print(f"{os.path.basename(name)}.so: {os.path.getsize(name + '.c') / 1e6:.1f} MB of C, "
          f"{seconds:.1f} s to compile", file=sys.stderr)  # fmt: skip
    with open(stamp, "w") as file:
        file.write(f"{key} {seconds}")
    return seconds
