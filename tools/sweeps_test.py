#!/usr/bin/env python3
"""What stays of drives; quantiles, and intervals and tests of shares, beside exact fractions."""

import math
import pathlib
import sys
import tempfile
import unittest
from fractions import Fraction

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from sweeps import interval, mcnemar, quantile, thin  # noqa: E402


class Folders(unittest.TestCase):
    def test_of_a_drive_stays_what_is_needed(self):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch) / "000001"
            (folder / "figures").mkdir(parents=True)
            for name in ("cycles.csv", "summary.json", "report.html", "figures/map.svg"):
                (folder / name).write_text("text\n")
            thin(folder, ("summary.json",))
            self.assertEqual([f.name for f in folder.iterdir()], ["summary.json"])
            thin(folder, ())
            self.assertFalse(folder.exists())
            thin(folder, ("summary.json",))  # of a trial whose process died


class Quantiles(unittest.TestCase):
    def test_ends_and_middle_are_least_greatest_and_median(self):
        values = [7, 1, 3, 9]
        self.assertEqual([quantile(values, share) for share in (0, 0.5, 1)], [1, 5, 9])
        self.assertEqual([quantile([4], share) for share in (0, 0.99, 1)], [4, 4, 4])

    def test_99_of_101_values_in_proportion(self):
        self.assertEqual(quantile(range(101), 0.99), 99)
        self.assertAlmostEqual(quantile([0, 10], 0.95), 9.5)


class Shares(unittest.TestCase):
    def test_at_the_ends_of_an_interval_the_binomial_tails_are_a_fortieth(self):
        def tail(p, terms, n):
            return float(sum(math.comb(n, i) * p**i * (1 - p)**(n - i) for i in terms))
        for k, n in ((1, 1), (3, 7), (111, 400)):
            low, high = map(Fraction, interval(k, n))
            self.assertAlmostEqual(tail(low, range(k, n + 1), n), 0.025, places=9)
            if k < n:
                self.assertAlmostEqual(tail(high, range(k + 1), n), 0.025, places=9)

    def test_none_and_all_have_one_end(self):
        self.assertEqual(interval(0, 20)[0], 0)
        self.assertAlmostEqual(interval(0, 20)[1], 1 - 0.025**(1 / 20), places=9)
        self.assertEqual(interval(20, 20)[1], 1)

    def test_thousands_of_drives_are_no_more_than_many(self):
        low, high = interval(1700, 3400)  # (p (1 - p) / n)^.5 = .00857
        self.assertAlmostEqual(low, 0.5 - 1.96 * 0.008575, places=3)
        self.assertAlmostEqual(high, 0.5 + 1.96 * 0.008575, places=3)

    def test_pairs(self):
        self.assertEqual(mcnemar(0, 0), 1)
        self.assertEqual(mcnemar(0, 5), 2 / 32)


if __name__ == "__main__":
    unittest.main()
