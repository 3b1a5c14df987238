#!/usr/bin/env python3
"""Which residuals make an answer."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from levels import LEVELS  # noqa: E402


def entry(**changes):
    return {"violation": 0.0, "stationarity": 0.0, "complementarity": 0.0, **changes}


class Confirmed(unittest.TestCase):
    def test_multipliers_that_stand_for_all_that_is_allowed_are_not_refused(self):
        """As peer_ipopt.py cuts them and bench_judge multiplies them, in its own units."""
        for level in LEVELS.values():
            for slack in (k / 7 for k in range(1, 200)):
                for scale in (3.0, 1300.0):
                    z = level.complementarity / slack
                    product = (slack / scale) * (z * scale)
                    self.assertTrue(level.confirms(entry(complementarity=product)), product)

    def test_what_is_more_than_allowed_or_missing_is_refused(self):
        for level in LEVELS.values():
            self.assertTrue(level.confirms(entry(violation=level.violation)))
            self.assertFalse(level.confirms(entry(violation=1.000001 * level.violation)))
            self.assertFalse(level.confirms(entry(stationarity=None)))


if __name__ == "__main__":
    unittest.main()
