#!/usr/bin/env python3
"""What growth.py makes of times."""

import json
import pathlib
import sys
import unittest
import xml.etree.ElementTree as xml
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import growth  # noqa: E402


def curves():
    return [growth.Curve("intervals", "a", {15: 100.0, 60: 400.0, 240: 1800.0}),
            growth.Curve("obstacles", "b", {38: 100.0, 1000: 1000.0}, {38: 800, 1000: 800 + 15 * 962}),
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
        self.assertIn("a row, of which each obstacle has 15, takes 62 ns an iteration", page)  # 900 µs over 962 obstacles
        self.assertIn("| phases | c | 2.00 | 2.00 | 1: 10, 2: 40, 4: 160 |", page)

    def test_sizes_without_a_time_are_named(self):
        def answer(*_):
            return json.dumps({"growth": [
                {"N": N, "obstacles": 38, "rows": 50 * N, "cycles": [
                    {"status": status, "cpu_s": 0.004, "iterations": 10},
                    {"status": "iteration_limit", "cpu_s": 1.0, "iterations": 500}]}  # fmt: skip
                for N, status in ((15, "solved"), (30, "solved"), (60, "infeasible"))]})

        with mock.patch.multiple(growth, program=lambda name: name, run_command=answer):
            times, rows, without = growth.of_cycles("E_C.cycles", "N", (15, 30, 60))
        self.assertEqual((times, rows), ({15: 400.0, 30: 400.0}, {15: 750, 30: 1500, 60: 3000}))
        self.assertEqual(without, ["60 N: no cycle was solved"])
        entries = [{"phases": n, "status": status, "iterations": 7, "iteration_s": 1e-4}
                   for n, status in ((1, "solved"), (2, "iteration_limit"), (4, "numerical_failure"))]  # fmt: skip
        times, _, lost = growth.timed(entries, "phases")
        self.assertEqual((times, lost), ({1: 100.0, 2: 100.0}, ["4 phases: numerical_failure after 7 iterations"]))
        found = curves()
        found[0].without, found[2].without = without, lost
        self.assertIn("\nWithout a time: 60 N: no cycle was solved; 4 phases: numerical_failure after 7 iterations.\n",
                      growth.page(found, "A stamp.\n"))  # fmt: skip
        self.assertNotIn("Without", growth.page(curves(), "A stamp.\n"))

    def test_whole_solves_have_their_time_and_memory(self):
        def answer(command, *_):
            size = int(command[command.index("--controls") + 1])
            return json.dumps([{"controls": size, "status": "solved", "iterations": 10, "iteration_s": size * 1e-6,
                                "whole_s": size / 100, "peak_mib": 30 + size}])  # fmt: skip

        with mock.patch.multiple(growth, program=lambda name: name, run_command=answer):
            found = growth.Curve("controls", "e", *growth.of_whole_solves("controls", (25, 400)))
        self.assertEqual([(size, round(time)) for size, time in found.points], [(25, 25), (400, 400)])
        page = growth.page([*curves(), found], "A stamp.\n")
        self.assertIn("| controls | 25 | solved | 10 | 0.25 s | 55 MiB |\n| controls | 400 | solved | 10 | 4.00 s | 430 MiB |", page)
        self.assertNotIn("Whole solves by", growth.page(curves(), "A stamp.\n"))

    def test_the_figure_has_a_panel_for_each(self):
        drawn = xml.fromstring(growth.figure(curves()))
        lines = [e for e in drawn if e.tag.endswith("polyline") and e.get("stroke") == "#3b7dd8"]
        self.assertEqual([len(e.get("points").split()) for e in lines], [3, 2, 3, 2])
        taller = xml.fromstring(growth.figure([*curves(), curves()[0]]))
        lowest = max(float(e.get("y")) + float(e.get("height")) for e in taller if e.tag.endswith("rect") and e.get("x"))
        self.assertLess(lowest, float(taller.get("height")))


if __name__ == "__main__":
    unittest.main()
