#!/usr/bin/env python3
"""What growth.py makes of times."""

import pathlib
import sys
import unittest
import xml.etree.ElementTree as xml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import growth  # noqa: E402


def curves():
    return [growth.Curve("intervals", "a", {15: 100.0, 60: 400.0, 240: 1800.0}),
            growth.Curve("obstacles", "b", {38: 100.0, 1000: 1000.0}),
            growth.Curve("phases", "c", {1: 10.0, 2: 40.0, 4: 160.0}),
            growth.Curve("LGR points", "d", {3: 5.0, 30: 50.0})]  # fmt: skip


class Growth(unittest.TestCase):
    def test_exponents_are_those_of_powers(self):
        self.assertAlmostEqual(curves()[2].exponent(), 2)
        self.assertAlmostEqual(curves()[3].exponent(), 1)

    def test_the_last_two_points_may_grow_otherwise(self):
        self.assertGreater(curves()[0].exponent(-2), curves()[0].exponent())

    def test_the_page_has_what_the_curves_say(self):
        page = growth.page(curves(), "A stamp.\n")
        self.assertIn("240 intervals take 18.0 times as long as 15.", page)
        self.assertIn("takes 58 ns an iteration", page)  # 900 µs over 962 obstacles at 16 nodes
        self.assertIn("| phases | c | 2.00 | 2.00 | 1: 10, 2: 40, 4: 160 |", page)

    def test_the_figure_has_a_panel_for_each(self):
        drawn = xml.fromstring(growth.figure(curves()))
        lines = [e for e in drawn if e.tag.endswith("polyline") and e.get("stroke") == "#3b7dd8"]
        self.assertEqual([len(e.get("points").split()) for e in lines], [3, 2, 3, 2])


if __name__ == "__main__":
    unittest.main()
