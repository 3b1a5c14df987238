#!/usr/bin/env python3
"""What shape_forms.py makes of made-up answers."""

import json
import pathlib
import sys
import types
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import shape_forms  # noqa: E402

OPTIONS = types.SimpleNamespace(seeds=2, runs=3, intervals=40)


def answer(form, seed=1, start="way", **changes):
    return {"scene": "gap", "form": form, "seed": seed, "start": start, "rows": 8, "variables": 2, "solved": True,
            "status": "solved", "iterations": 20, "solve_s": 0.01, "warm_solved": True, "warm_iterations": 5,
            "warm_s": 0.002, "cost": 4.0, "time_s": 3.5, "gap": 0.3, "asked": 0.3, "length": 4.6, "width": 2,
            **changes}  # fmt: skip


def page(*answers):
    results = shape_forms.Results([json.dumps(a) for a in answers])
    return shape_forms.page(results, results, "A stamp.\n", OPTIONS)


class Page(unittest.TestCase):
    def test_a_form_has_its_medians(self):
        text = page(*(answer("line", seed, start) for seed in (1, 2) for start in ("way", "straight")),
                    answer("discs-0.2", cost=4.2, gap=0.5), answer("discs-0.2", start="straight", solved=False),
                    answer("discs-0.2", 2, cost=4.4, gap=0.4), answer("discs-0.2", 2, "straight"))  # fmt: skip
        self.assertIn("| `line` | 8, 2 | 2, 2 of 2 | 0.300, 0.300 | +0.0% | 20, 10.0 | 5, 2.0 | 0.300 | 10.0, 2.0 |", text)
        self.assertIn("| `discs-0.2` | 8, 2 | 2, 1 of 2 | 0.400, 0.450 | +7.5% |", text)
        self.assertIn("a vehicle of 4.6 m by 2 m", text)
        self.assertIn("medians of up to\n3 runs, fewer where they take longer than .5 s together", text)

    def test_only_forms_of_an_equal_gap_are_compared(self):
        text = page(answer("line"), answer("line", start="straight"), answer("dual", solve_s=0.03, gap=0.31),
                    answer("dual", start="straight", solved=False), answer("discs-0.2", gap=0.45),
                    answer("discs-0.2", start="straight", gap=0.45))  # fmt: skip
        equal = text.split("## At an equal gap")[1]
        self.assertIn("| `dual` | 1, 0 of 1 | × 3.00 (1) |  | × 1.00 (1) |", equal)
        self.assertIn("| `line` | 1, 1 of 1 | × 1.00 (1) |", equal)
        self.assertNotIn("discs", equal)

    def test_a_form_that_solves_nothing_has_empty_cells(self):
        text = page(answer("line"), answer("line", start="straight"), answer("dual", solved=False, warm_solved=False),
                    answer("dual", start="straight", solved=False, warm_solved=False))  # fmt: skip
        self.assertIn("| `dual` | 8, 2 | 0, 0 of 1 |  |  |  |  |  |  |", text)


if __name__ == "__main__":
    unittest.main()
