#!/usr/bin/env python3
"""How much sooner Problem.solve_many is done than as many calls of Problem.solve, all from one solution.

    benchmarks/many_solves.py [--solves 1000] [--mesh 40]

Needs the package slalom in the Python that runs it.
"""
import argparse
import statistics
import time

import numpy as np
import slalom


def cart_pole(length):
    """A pendulum on a cart from hanging to standing in two seconds, with the least force (Kelly, SIAM Review 59(4), 2017)."""
    p = slalom.Problem("cart-pole")
    l = p.parameter("length", length)
    m1, m2, g = 1.0, 0.3, 9.81
    x = p.state("x", lower=-2, upper=2, initial=0, final=1)
    a = p.state("a", initial=0, final=np.pi)
    v, w = p.state("v", initial=0, final=0), p.state("w", initial=0, final=0)
    u = p.control("u", lower=-20, upper=20)
    s, c = slalom.sin(a), slalom.cos(a)
    p.dynamics(x, v)
    p.dynamics(a, w)
    p.dynamics(v, (l * m2 * s * w**2 + u + m2 * g * c * s) / (m1 + m2 * (1 - c**2)))
    p.dynamics(w, -(l * m2 * c * s * w**2 + u * c + (m1 + m2) * g * s) / (l * m1 + l * m2 * (1 - c**2)))
    p.lagrange("force", u**2)
    p.final_time(equal=2)
    return p


def seconds(work):
    start = time.perf_counter()
    result = work()
    return time.perf_counter() - start, result


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--solves", type=int, default=1000)
    parser.add_argument("--mesh", type=int, default=40)
    a = parser.parse_args()
    lengths = np.linspace(0.48, 0.6, a.solves)  # near enough for the nominal optimum to be the one
    p = cart_pole(0.5)
    nominal = p.solve(mesh=a.mesh)
    ratios = {1: [], 0: []}
    for _ in range(3):
        alone, answers = seconds(lambda: [cart_pole(length).solve(mesh=a.mesh, warm_start=nominal)
                                           for length in lengths])
        for threads, ratio in ratios.items():
            together, many = seconds(lambda t=threads: p.solve_many(
                {"length": lengths}, mesh=a.mesh, threads=t, warm_start=nominal))
            ratio.append(alone / together)
            gap = np.max(np.abs(many.objective / [one.objective for one in answers] - 1))
            print(f"{a.solves} solves: {alone:.2f} s by solve, {together:.2f} s by solve_many on "
                  f"{threads or 'all'} threads; {many.solved.sum()} and {sum(one.solved for one in answers)} solved, "
                  f"objectives at most {gap:.1e} apart")  # fmt: skip
    for threads, ratio in ratios.items():
        print(f"solve_many on {threads or 'all'} threads: {statistics.median(ratio):.1f} times as fast as solve")


if __name__ == "__main__":
    main()
