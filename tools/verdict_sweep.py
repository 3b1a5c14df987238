"""The paper's claims that its sweep of E_C shows, judged by ours; see verdicts.py."""

import math
import statistics

from sweeps import fisher
from verdict_data import of, paper_counts, paper_points, passes, share
from verdict_drives import DEARER, verdict


def safer(s):
    paper = paper_counts()
    c, d = s.of("P_C", tex=(-1, math.inf)), s.of("P_D", tex=(-1, math.inf))
    p = fisher(passes(c), len(c) - passes(c), passes(d), len(d) - passes(d))
    factor = passes(d) / passes(c) if passes(c) else math.inf
    kc, n = paper["P_C"]
    kd, _ = paper["P_D"]
    return ("Moving obstacle avoidance is safer over tex and the speed of O2",
            f"{kc} and {kd} of {n}, × {kd / kc:.2f}, p = 2.2e-16", f"P_C {of(c)}, P_D {of(d)}: × {factor:.2f}, p = {p:.1e}",
            "holds" if factor > 1 and p < 0.05 else "does not hold")


def solve_times(s):
    pairs = [(c, d) for c, d in s.pairs() if math.isfinite(c["median"]) and math.isfinite(d["median"])]
    found = []
    for key, name in (("median", "median solve"), ("max", "longest solve")):
        ratios = sorted(d[key] / c[key] for c, d in pairs)
        dearer = sum(r > DEARER for r in ratios)
        found.append((name, statistics.median(ratios), dearer))
    return ("Moving obstacle avoidance adds no solve time in most cases of the sweep", "in most cases",
            f"P_D's CPU time beside P_C's, {len(pairs)} pairs: " + "; ".join(
                f"{name} × {ratio:.2f} in the median, more than {DEARER:g} in {dearer}" for name, ratio, dearer in found),
            verdict(dearer <= len(pairs) / 2 for _, _, dearer in found))


def not_needed(s):
    tex, speed = 0.375, 2.2
    inside = s.of("P_C", tex=(-1, tex), speed=(-1, speed))
    slow_only = s.of("P_C", tex=(tex, math.inf), speed=(-1, speed))
    fast = s.of("P_C", tex=(-1, tex), speed=(speed, math.inf))
    return ("No moving obstacle avoidance is needed at tex up to .375 s with O2 at up to 2.11 m/s",
            "all arrive there", f"there P_C arrives in {of(inside)}; at larger tex in {of(slow_only)}, with a faster O2 in "
            f"{of(fast)}",
            "holds" if share(inside) == 1 else
            "holds in part" if share(inside) > max(share(slow_only), share(fast)) else "does not hold")


def too_fast(s):
    slow, fast = s.of("P_D", tex=(-1, math.inf), speed=(-1, 21.11)), s.of("P_D", tex=(-1, math.inf), speed=(21.11, math.inf))
    if not fast:
        return None
    last = max((t["speed"] for t in fast if t["passed"]), default=math.nan)
    beyond = f"; the fastest it passes has {last:.1f} m/s" if passes(fast) else ""
    return ("O2 cannot be avoided reliably above 21.1 m/s, even by P_D", "above 21.1 m/s",
            f"P_D arrives in {of(fast)} above and {of(slow)} at or below it{beyond}",
            "holds" if share(fast) < 0.5 * share(slow) else "does not hold")


def small_tex(s):
    edges = (-1, 8.5, 16.9, 25)
    words, better, ratios = [], [], []
    for low, high in zip(edges, edges[1:]):
        small, large = (s.of("P_D", tex=t, speed=(low, high)) for t in ((-1, 0.5), (0.5, math.inf)))
        if not small or not large:
            continue
        words.append(f"O2 {'at' if low < 0 else f'above {low:g} and'} up to {high:g} m/s {of(small)} and {of(large)}")
        better.append(share(small) - share(large))
        ratios.append((share(small) + 1e-3) / (share(large) + 1e-3))
    grows = all(b >= a for a, b in zip(ratios, ratios[1:]))
    return ("A small tex becomes crucial as O2 gets faster", "more crosses at small tex",
            "P_D with tex up to .5 s and above: " + "; ".join(words),
            "holds" if min(better) >= 0 and better[-1] > 0 and grows else
            "holds in part" if max(better) > 0 else "does not hold")


def real_time(s):
    factors = {tex: s.rtf("P_D", tex)[0] for tex in s.texs}
    below = [t for t, f in factors.items() if f < 1]
    first, last = factors[s.texs[0]], factors[s.texs[-1]]
    return ("The real-time factor is very high at small tex and drops, so that P_D is below 1 at two tex alone",
            "below 1 at .687 and .790 s alone", f"P_D: {first:.2g} at tex {s.texs[0]:g} s, {last:.2g} at {s.texs[-1]:g} s; "
            f"below 1 at {len(below)} of {len(s.texs)} tex" + (f", from {min(below):.3g} s on" if below else ""),
            "holds" if len(below) <= 2 else "holds in part" if first > last else "does not hold")


def safety_by_tex(s):
    low = [s.rtf("P_C", t)[1] for t in s.texs]
    small, large = (s.of("P_D", tex=t) for t in ((-1, 0.5), (0.5, math.inf)))
    return ("P_C's probability of safety is very low at every tex; P_D's is higher at small tex", "compare the figure",
            f"P_C at most {max(low):.2f}; P_D {share(small):.2f} up to .5 s, {share(large):.2f} above",
            verdict([max(low) < 0.25, share(small) > share(large)]))


def trade_off(s):
    both = [t for t in s.texs if s.rtf("P_D", t)[0] < 1]
    best = max(both, key=lambda t: s.rtf("P_D", t)[1]) if both else None
    safest = max(s.rtf("P_D", t)[1] for t in s.texs)
    if best is None:
        return ("Safety asks for a small tex, real time for a large one", "POS .45 and .25 where below 1",
                "no tex is below 1", "holds")
    factor, pos = s.rtf("P_D", best)
    return ("Safety asks for a small tex, real time for a large one", "POS .45 and .25 where below 1",
            f"of the tex with a real-time factor below 1 the safest is {best:.3g} s: factor {factor:.2g}, POS {pos:.2f}; the "
            f"safest of all has {safest:.2f}", "holds" if pos < safest else "does not hold")


def slower_is_safer(s):
    words, checks = [], []
    for point in paper_points():
        if "rtf" not in point:
            continue
        tex = s.nearest_tex(point["tex"])
        factor, pos = s.rtf("P_D", tex, point["speed"] + 0.05)
        whole, whole_pos = s.rtf("P_D", tex)
        words.append(f"up to {point['speed']:g} m/s at tex {tex:.3g} s: {factor:.2g} and {pos:.2f} (paper {point['rtf']:g} "
                     f"and {point['pos']:g}; at all speeds ours {whole:.2g} and {whole_pos:.2f})")
        checks += [factor <= whole, pos > whole_pos]
    return ("Where O2 is slower, the real-time factor falls and the probability of safety rises",
            ".933 and .889; .920 and 1", "; ".join(words), verdict(checks))


def danger(s):
    ratios = []
    for tex in s.texs:
        own = [t for t in s.trials if t["planner"] == "P_D" and t["tex"] == tex and math.isfinite(t["max"])]
        lost, kept = ([t["max"] for t in own if t["passed"] == p] for p in (False, True))
        if lost and kept:
            ratios.append(statistics.median(lost) / statistics.median(kept))
    longer = sum(r > 1 for r in ratios)
    return ("Dangerous situations raise the real-time factor", "solve times rise before O2",
            f"P_D's longest solve in trials that fail beside those that arrive, of one tex: × "
            f"{statistics.median(ratios):.1f} in the median, longer at {longer} of {len(ratios)} tex",
            "holds" if longer >= 0.75 * len(ratios) else "holds in part" if longer > 0.5 * len(ratios) else
            "does not hold")


def shares(s):
    c, d = s.of("P_C", tex=(-1, math.inf)), s.of("P_D", tex=(-1, math.inf))
    k, n = passes(c) + passes(d), len(c) + len(d)
    return ("P_D makes most of the passes, P_C most of the failures", "87.1 %, 60.0 %",
            f"{100 * passes(d) / k:.1f} %, {100 * (len(c) - passes(c)) / (n - k):.1f} %",
            verdict([passes(d) > k / 2, len(c) - passes(c) > (n - k) / 2]))


def all_of(s):
    found = [safer(s), shares(s), solve_times(s), not_needed(s), too_fast(s), small_tex(s), real_time(s),
             safety_by_tex(s), trade_off(s), slower_is_safer(s), danger(s)]
    return [one for one in found if one]
