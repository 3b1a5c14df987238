#!/usr/bin/env python3
"""What the page on errors of belief draws, and how it counts, on drives made up for it."""

import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import belief_errors  # noqa: E402
from belief_errors import LEVELS, Crash, crash_of, crashes, drawn, errors, page, with_errors  # noqa: E402
from sensitivity import QUANTITIES  # noqa: E402

FILE = ("plant:\n" + "".join(f"  {q.key.split('.')[1]}: {q.neutral}\n" for q in QUANTITIES if "plant" in q.key)
        + "sensing:\n" + "".join(f"  {q.key.split('.')[1]}: {q.neutral}\n" for q in QUANTITIES if "sensing" in q.key)
        + "  noise_seed: 0\nplanner:\n  delay: 7\n")  # fmt: skip


def trial(outcome):
    return {"outcome": outcome, "message": "ended 3.5", "least_clearance_m": "0.31"}


NOT_VERIFIED = Crash(False)


class Draws(unittest.TestCase):
    def test_errors_are_within_their_ranges_and_grow_with_the_level(self):
        every = [errors(drawn(f"gates-{k:04}")[0], level) for k in range(500) for level in LEVELS]
        large = every[2::3]
        mass = [e["plant.mass_factor"] for e in large]
        self.assertTrue(0.8 <= min(mass) < 0.81 and 1.19 < max(mass) <= 1.2)
        delay = [e["sensing.delay"] for e in large]
        self.assertTrue(0 <= min(delay) < 0.005 and 0.095 < max(delay) <= 0.1)
        for small, whole in zip(every[0::3], large):
            for q in QUANTITIES:
                self.assertAlmostEqual(small[q.key] - q.neutral, 0.1 * (whole[q.key] - q.neutral))

    def test_each_scenario_has_draws_of_its_own_that_stay(self):
        self.assertEqual(drawn("gates-0001"), drawn("gates-0001"))
        self.assertNotEqual(drawn("gates-0001"), drawn("gates-0002"))

    def test_a_file_gets_them_in_their_sections(self):
        text = with_errors(FILE, "gates-0001", "medium")
        for key, value in errors(drawn("gates-0001")[0], "medium").items():
            self.assertIn(f"  {key.split('.')[1]}: {value}\n", text)
        self.assertTrue(text.endswith("planner:\n  delay: 7\n"))
        self.assertIn(f"  noise_seed: {drawn('gates-0001')[1]}\n", text)
        with self.assertRaisesRegex(ValueError, "gates-0001: found plant.cg_shift 0 times"):
            with_errors(FILE.replace("  cg_shift: 0\n", ""), "gates-0001", "medium")


class Crashes(unittest.TestCase):
    def test_a_crash_is_what_the_program_measured(self):
        self.assertFalse(crash_of({"outcome": "crash"}).verified)
        found = {"cycle": 7, "kept_m": 0.3, "off_plan_m": 0.1, "off_belief_m": 0.25}
        self.assertEqual(crash_of({"verified_crash": found}), Crash(True, 0.3, 0.1, 0.25))
        self.assertEqual(crash_of({"verified_crash": found | {"off_belief_m": None}}).off_belief, math.inf)

    def test_a_certificate_is_wrong_where_the_errors_are_less_than_it_keeps(self):
        for off_plan, off_belief, wrong, by_vehicle in ((0.1, 0.25, False, False), (0.1, 0.15, True, False),
                                                         (0.35, 0, False, True), (0, math.inf, False, False)):
            crash = Crash(True, 0.3, off_plan, off_belief)
            self.assertEqual((crash.by_wrong_certificate(), crash.by_vehicle()), (wrong, by_vehicle), crash)
        self.assertFalse(NOT_VERIFIED.by_wrong_certificate() or NOT_VERIFIED.by_vehicle())


class Page(unittest.TestCase):
    def setUp(self):
        few = {"gates-0001": trial("goal"), "gates-0002": trial("crash"), "crossing_at_rest-0001": trial("timeout")}
        self.trials = {level: dict(few) for level in LEVELS}
        self.verified = {"small": {"gates-0002": Crash(True, 0.2, 0.5, 0.1)}, "medium": {"gates-0002": NOT_VERIFIED},
                         "large": {"gates-0002": NOT_VERIFIED}}

    def test_it_counts_by_level_and_family(self):
        text = page(self.trials, self.verified, "A stamp.\n")
        self.assertIn("| small | 3 | 1 | 0.0084–0.9057 | 1 | 1 | 0 | 1 | 1 | 0.310 |", text)
        self.assertIn("| large | 3 | 1 | 0.0084–0.9057 | 1 | 0 | 0 | 0 | 1 | 0.310 |", text)
        self.assertIn("| gates | 1/2 | 1/2 | 1/2 | 1 | 1 | 1 |", text)
        self.assertIn("| crossing | 0/0 | 0/0 | 0/0 | 0 | 0 | 0 |", text)
        self.assertIn("| gates-0002 | no | – | – | – | ended 3.5 | mass_factor ", text)

    def test_no_more_than_some_are_listed_but_all_are_in_the_table(self):
        many = {f"gates-{k:04}": trial("crash") for k in range(belief_errors.MOST_LISTED + 3)}
        words = {s: Crash(True, 0.2, 0.1, 0.15) if s == "gates-0022" else NOT_VERIFIED for s in many}
        trials, verified = {"large": many}, {"large": words}
        text = belief_errors.listed(trials, verified)
        self.assertEqual(text.count("| gates-"), belief_errors.MOST_LISTED)
        self.assertIn("| gates-0022 | yes | 0.20 | 0.10 | 0.15 |", text)
        self.assertIn("And 3 more.", text)
        self.assertEqual(len(crashes(trials, verified).splitlines()), 1 + len(many))


if __name__ == "__main__":
    unittest.main()
