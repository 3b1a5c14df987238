#!/usr/bin/env python3
"""What a solve from Python costs beside the same solve in C++: the time of the call less that of
ocp::solve within it (Solution.elapsed_s), median and 95 % over many solves; and what the import costs.

usage: python_overhead.py [--solves N]   (needs the package slalom)
"""

import argparse
import statistics
import time

began = time.perf_counter()
import slalom  # noqa: E402

IMPORT_S = time.perf_counter() - began


def bryson_denham():
    p = slalom.Problem("Bryson-Denham")
    x = p.state("x", upper=1 / 9, initial=0, final=0)
    v = p.state("v", initial=1, final=-1)
    u = p.control("u")
    p.dynamics(x, v)
    p.dynamics(v, u)
    p.lagrange("effort", u**2 / 2)
    return p


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--solves", type=int, default=300)
    count = parser.parse_args().solves
    problem = bryson_denham()
    bare, fetched, inner = [], [], []
    for _ in range(count):
        begin = time.perf_counter()
        solution = problem.solve()
        solved = time.perf_counter()
        solution.t, solution.states, solution.controls, solution.costates
        end = time.perf_counter()
        bare.append(solved - begin - solution.elapsed_s)
        fetched.append(end - begin - solution.elapsed_s)
        inner.append(solution.elapsed_s)
    print(f"{'import':<24} {1e3 * IMPORT_S:.0f} ms")
    for name, times in (("solve in C++", inner), ("overhead of the call", bare),
                        ("with all arrays fetched", fetched)):
        cuts = statistics.quantiles(times, n=20)
        print(f"{name:<24} median {1e6 * statistics.median(times):9.1f} us"
              f"   95 % {1e6 * cuts[-1]:9.1f} us")


if __name__ == "__main__":
    main()
