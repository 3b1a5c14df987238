"""The paper's claims that its drives show, judged by ours; see verdicts.py."""

import math
import statistics

from verdict_data import median_interval, of, paired, ratio_interval, share

STATIC = ("E_A", "E_A-figure")
NEAR = 2.0  # s before the closest approach that count as near it
DEARER = 1.1  # a ratio of solve times counts where its interval lies beyond this


def ms(seconds):
    return f"{1e3 * seconds:.3g}"


def interval_ms(values):
    return "{} [{}, {}]".format(*map(ms, median_interval(values)))


def ratio_words(before, after, measure=ratio_interval):
    """A ratio with its interval, as words and as numbers."""
    ratio, low, high = measure(before, after)
    return f"× {ratio:.2f} [{low:.2f}, {high:.2f}]", ratio, low, high


def no_dearer(ratios):
    """Of ratios (point, low, high): holds where none is dearer by its interval, in part where some are."""
    dearer = sum(low > DEARER for _, low, _ in ratios)
    return "holds" if dearer == 0 else "holds in part" if dearer < len(ratios) else "does not hold"


def verdict(checks):
    checks = list(checks)
    return "holds" if all(checks) else "holds in part" if any(checks) else "does not hold"


def minimum_time_arrives(d):
    gains = [(e, d[f"{e}/P_A"], d[f"{e}/P_B"], d[f"{e}/P_C"]) for e in STATIC]
    ours = "; ".join(f"{e}: {a.time:.1f} s to {b.time:.1f} and {c.time:.1f} s" for e, a, b, c in gains)
    return ("Minimum time (P_B, P_C instead of P_A) shortens the time to the goal in E_A",
            "9.0 s to 7.0 s", ours,
            verdict(a.arrived and b.arrived and c.arrived and max(b.time, c.time) < a.time
                    for _, a, b, c in gains))


def minimum_time_solves(d):
    found = [(f"{e} {p}", *ratio_words(d[f"{e}/P_A"].later, d[f"{e}/{p}"].later, paired))
             for e in STATIC for p in ("P_B", "P_C")]
    def cycles(e, p):
        drive = d[f"{e}/{p}"]
        return f"{p} {sum(drive.iterations[1:]) / len(drive.later):.1f}"

    steps = "; ".join(f"{e} " + ", ".join(cycles(e, p) for p in ("P_A", "P_B", "P_C")) for e in STATIC)
    return ("Minimum time shortens the solves in E_A", "P_A's are the longer ones, some above .5 s",
            "CPU time beside P_A's, cycle by cycle: " + "; ".join(f"{name} {text}" for name, text, *_ in found)
            + f"; iterations a cycle: {steps}", verdict(high < 1 for *_, high in found))


def baseline_misses(d):
    tex = 0.5
    late = sum(t > tex for e in STATIC for t in d[f"{e}/P_A"].solves)
    longest = max(t for e in STATIC for t in d[f"{e}/P_A"].solves)
    return ("P_A does not plan in real time in E_A, P_B and P_C do", "several of P_A's above .5 s",
            f"{late} of P_A's solves above .5 s, the longest takes {ms(longest)} ms; P_B's and P_C's at most "
            + ms(max(t for e in STATIC for p in ("P_B", "P_C") for t in d[f"{e}/{p}"].solves)) + " ms",
            "holds" if late else "does not hold")


def slow_is_hard(d):
    a = d["E_A-figure/P_A"]
    k = max(range(1, len(a.solves)), key=lambda i: a.solves[i])
    t = a.t0[k]
    return ("P_A's solve time rises sharply about 6 s, where it brakes and steers at low speed (speculated)",
            "about 6 s", f"P_A's longest solve in E_A-figure is planned at {t:.1f} s: {ms(a.solves[k])} ms at "
            f"{a.at(t, 'ux'):.1f} m/s, ax {a.at(t, 'ax'):.2f} m/s²; median {ms(statistics.median(a.later))} ms",
            "holds" if abs(t - 6) <= 1 else "does not hold")


def effort_less(d):
    b, c = d["E_A-figure/P_B"], d["E_A-figure/P_C"]
    change = 100 * (c.effort() / b.effort() - 1)
    return ("Control effort in the cost (P_C instead of P_B) lessens it, and arrives no later",
            "-20.9 %, both 7.0 s", f"{change:+.1f} %, {b.time:.1f} s and {c.time:.1f} s",
            "holds" if change <= -10 and c.time <= b.time else
            "holds in part" if change < 0 and c.time <= b.time else "does not hold")


def effort_free(d):
    found = [(e, *ratio_words(d[f"{e}/P_B"].later, d[f"{e}/P_C"].later, paired)) for e in STATIC]
    return ("Control effort in the cost costs no solve time", "all below .5 s",
            "P_C's CPU time beside P_B's, cycle by cycle: " + "; ".join(f"{e} {text}" for e, text, *_ in found),
            no_dearer([numbers for _, _, *numbers in found]))


def area(drive, x_goal=200):
    """Between the path and the line through the goal along y [m²]."""
    return sum(abs(a["x"] + b["x"] - 2 * x_goal) / 2 * abs(b["y"] - a["y"])
               for a, b in zip(drive.rows, drive.rows[1:]))


def less_area(d):
    found = {p: area(d[f"E_A-figure/{p}"]) for p in ("P_A", "P_B", "P_C")}
    return ("P_A keeps the area between path and goal line smaller than P_B and P_C do", "compare the paths",
            "E_A-figure: " + ", ".join(f"{p} {a:.0f} m²" for p, a in found.items()),
            verdict(found["P_A"] < found[p] for p in ("P_B", "P_C")))


def moving_is_safer(d):
    ours = "; ".join(f"{e}: P_C {d[f'{e}/P_C'].ended()}, P_D {d[f'{e}/P_D'].ended()}" for e in ("E_B", "E_C"))
    return ("Moving obstacle avoidance (P_D instead of P_C) is what saves the vehicle in E_B and E_C",
            "E_B: 3.5 s crash, 6.5 s; E_C: 19.5 s crash, 28.5 s", ours,
            verdict(not d[f"{e}/P_C"].arrived and d[f"{e}/P_D"].arrived for e in ("E_B", "E_C")))


def moving_is_free(d):
    found = [(e, *ratio_words(d[f"{e}/P_C"].later, d[f"{e}/P_D"].later, paired)) for e in ("E_B", "E_C")]
    return ("Moving obstacle avoidance adds no solve time", "all of P_D's below .5 s",
            "P_D's CPU time beside P_C's, cycle by cycle while both drive: "
            + "; ".join(f"{e} {text}" for e, text, *_ in found),
            no_dearer([numbers for _, _, *numbers in found]))


def real_time(d):
    names = [n for n in d if n.count("/") == 1 and n.startswith(("E_A", "E_B/", "E_C/"))
             and not n.endswith("P_A")]
    longest = max((t, n) for n in names for t in d[n].solves)
    count = sum(len(d[n].solves) for n in names)
    return ("P_B, P_C and P_D plan within tex = .5 s in E_A to E_C", "all below .5 s",
            f"all {count} below; the longest {ms(longest[0])} ms ({longest[1]})"
            if longest[0] < 0.5 else f"longest {ms(longest[0])} ms ({longest[1]})",
            "holds" if longest[0] < 0.5 else "does not hold")


def more_obstacles(d):
    few = [t for n in ("E_A/P_C", "E_A-figure/P_C", "E_B/P_C", "E_B/P_D") for t in d[n].later]
    many = [t for n in ("E_C/P_C", "E_C/P_D") for t in d[n].later]
    bare = [t for n in ("E_C-no-cones/P_C", "E_C-no-cones/P_D") for t in d[n].later]
    text, _, low, _ = ratio_words(few, many)
    alone, _, low_alone, _ = ratio_words(bare, many)
    return ("More obstacles take more solve time: E_C's 38 beside E_A's and E_B's three",
            "compare the figures", f"medians {interval_ms(few)} ms and {interval_ms(many)} ms, {text} (N 10 and "
            f"15); of the same N, E_C without its 36 cones {interval_ms(bare)} ms, {alone}",
            verdict([low > 1, low_alone > 1]))


def danger(d):
    drive = d["E_C/P_D"]
    closest = min(drive.rows, key=lambda r: math.hypot(r["x"] - 18, r["y"] - 650 + 10 * r["t"]))["t"]
    near = [t for t0, t in zip(drive.t0, drive.solves) if closest - NEAR <= t0 <= closest]
    rest = [t for t0, t in zip(drive.t0[1:], drive.later) if not closest - NEAR <= t0 <= closest]
    k = max(range(len(drive.solves)), key=lambda i: drive.solves[i])
    text, _, low, _ = ratio_words(rest, near)
    peak = closest - NEAR <= drive.t0[k] <= closest
    return ("Solve times of P_D in E_C rise sharply just before it passes O2",
            "peak at 19.0 s", f"O2 is nearest at {closest:.1f} s; in the {NEAR:g} s before, median "
            f"{interval_ms(near)} ms, else {interval_ms(rest)} ms, {text}; the longest of all, {ms(drive.solves[k])} "
            f"ms, is planned at {drive.t0[k]:.1f} s", verdict([low > 1, peak]))


def dearer_to_avoid(d):
    c, other = d["E_C/P_C"], d["E_C/P_D"]
    last = [max(t for t0, t in zip(x.t0, x.solves) if c.time - NEAR <= t0 <= c.time) for x in (c, other)]
    return ("P_D avoids O2 with a solve time only slightly above P_C's just before its crash", "slightly higher",
            f"longest in the {NEAR:g} s before: P_D {ms(last[1])} ms, P_C {ms(last[0])} ms",
            "holds" if last[1] <= 1.5 * last[0] else "does not hold")


def crash_speed(d):
    c, other = d["E_C/P_C"], d["E_C/P_D"]
    return ("In E_C both vehicles gain speed until, at 19.5 s, that of P_C hits O2", "26.5 m/s",
            f"P_C {c.ended()} with {c.rows[-1]['ux']:.1f} m/s; P_D then {other.at(c.time, 'ux'):.1f} m/s",
            "holds" if c.summary["hit"] == "O2" and abs(c.time - 19.5) <= 0.5 else "does not hold")


def range_50(d, seen):
    """`seen`: outcomes of P_D by speed of O2, seen 50 m and 90 m ahead."""
    lost = [s for s, o in seen[50].items() if o != "goal"]
    crashed = [s for s, o in seen[50].items() if o == "crash"]
    kept = [s for s, o in seen[90].items() if o == "goal"]
    return ("With L_range 50 m the vehicle crashes into O2 in E_C over a large range of O2's speeds",
            "hence 90 m", f"of {len(seen[50])} speeds up to {max(seen[50]):.0f} m/s P_D fails at {len(lost)}, by a crash "
            f"at {len(crashed)}, else without a plan; with 90 m it arrives at {len(kept)}",
            "holds" if len(crashed) > len(seen[50]) / 2 else
            "holds in part" if len(lost) > len(seen[90]) - len(kept) else "does not hold")


def lane_change(d):
    y = [next(r["y"] for r in d[f"{e}/P_D"].rows if r["x"] >= 12) for e in ("E_C-no-cones", "E_C")]
    return ("Without the cones the vehicle changes lanes earlier", "hence 36 cones",
            f"other lane from y = {y[0]:.0f} m, with cones from {y[1]:.0f} m",
            "holds" if y[0] < y[1] else "does not hold")


def cases(d):
    ended = "; ".join(f"{c}: {d[f'cases/{c}'].ended()}" for c in "ABCDEF")
    goal = {c: d[f"cases/{c}"].arrived for c in "ABCDEF"}
    time = {c: d[f"cases/{c}"].summary["goal_time_s"] or math.inf for c in "ABCDEF"}
    return ("Planners that lack specifications are less safe or slower (conceptual figure, cases A to F)",
            "A, E collide; C before B, D before C; F safe", ended,
            verdict([not goal["A"], goal["B"], time["C"] < time["B"], time["D"] < time["C"],
                     not goal["E"], goal["F"]]))


def small_tex_instead(outcomes, sweep):
    """`outcomes`: how case E ends by tex. In the sweep: P_C with O2 moving, at up to 5 m/s."""
    arrived = [tex for tex, o in outcomes.items() if o == "goal"]
    small, large = (sweep.of("P_C", tex=t, speed=(0, 5)) for t in ((-1, 0.375), (0.375, math.inf)))
    return ("A small execution horizon can stand in for moving obstacle avoidance (case E)",
            "said of the conceptual figure",
            "case E with tex " + "; ".join(f"{tex:g} s: {o}" for tex, o in outcomes.items())
            + f". In E_C, O2 at up to 5 m/s, P_C arrives in {of(small)} with tex up to .375 s and in {of(large)} above",
            verdict([arrived, share(small) > share(large)]))


def kinematic_moving(outcome):
    return ("Moving obstacle avoidance by a kinematic model is not enough (planners before this one)",
            "case A depicts it", f"case F with the kinematic model: {outcome}",
            "holds" if outcome != "goal" else "does not hold")


def ipopt(d, other):
    names = [n for n in d if n in other and n.startswith("E_") and not n.endswith("P_A")
             and "range" not in n and "cones" not in n]
    same = sum(d[n].outcome == other[n].outcome and d[n].summary["hit"] == other[n].summary["hit"]
               for n in names)
    longest = max(t for n in names for t in other[n].solves)
    ours = [t for n in names for t in d[n].later]
    theirs = [t for n in names for t in other[n].later]
    text, *_ = ratio_words(ours, theirs)
    return ("Ipopt plans as KNITRO does, so that real time is not KNITRO's doing", "similar solve times, unreported",
            f"KNITRO is not here; Ipopt and our solver end {same} of {len(names)} drives alike; medians "
            f"{interval_ms(theirs)} ms and {interval_ms(ours)} ms, Ipopt {text}; Ipopt's longest {ms(longest)} ms",
            "holds" if same == len(names) and longest < 0.5 else "holds in part" if longest < 0.5 else
            "does not hold")


def all_of(d, more, sweep):
    """Every claim of the drives; `more` holds the drives made besides."""
    return [minimum_time_arrives(d), minimum_time_solves(d), baseline_misses(d), slow_is_hard(d), less_area(d),
            effort_less(d), effort_free(d), moving_is_safer(d), crash_speed(d), moving_is_free(d),
            dearer_to_avoid(d), real_time(d), danger(d), more_obstacles(d), range_50(d, more["range"]), lane_change(d),
            cases(d), small_tex_instead(more["case E"], sweep), kinematic_moving(more["kinematic F"]),
            ipopt(d, more["ipopt"])]
