#!/usr/bin/env python3
"""A drive is replayed by another model and method, moved, mirrored, and repeated from its own
resolved.yaml."""

import math
import pathlib
import unittest

import drives
import model
from drives import CONTROLS, STATES, WHEELS

CASES = (("E_B", "P_C"), ("E_B", "P_D"), ("E_C", "P_D"))
EAST, NORTH = 10000.0, -7000.0
AXIS = 100.0  # of the mirror x -> 2 AXIS - x [m]
STEP = 2.5e-3  # of the replay [s]


def setUpModule():
    global SCRATCH, DRIVES, OTHERS
    SCRATCH = drives.scratch()
    folder = pathlib.Path(SCRATCH.name)
    symmetric = ("--set", "vehicle.tyre_asymmetry=false")
    first = {}
    for environment, planner in CASES:
        first[f"{environment} {planner}"] = (environment, "--planner", planner)
        first[f"{environment} {planner} symmetric"] = (environment, "--planner", planner, *symmetric)
        first[f"{environment} {planner} wide"] = (
            environment, "--planner", planner, *symmetric, "--set", "vehicle.psi_max=1e6")
    DRIVES = drives.simulate_all(folder / "first", first)
    second = {}
    for environment, planner in CASES:
        name = f"{environment} {planner}"
        plain, even, wide = (DRIVES[name + kind] for kind in ("", " symmetric", " wide"))
        for kind, text in (
                ("again", plain.resolved),
                ("moved", drives.rewrite(plain.resolved, drives.moved(EAST, NORTH))),
                ("mirrored", drives.rewrite(even.resolved, drives.mirrored)),
                ("mirrored_x", drives.rewrite(wide.resolved, drives.mirrored_about(AXIS)))):
            file = folder / f"{environment}-{planner}-{kind}.yaml"
            file.write_text(text)
            second[f"{name} {kind}"] = (file,)
    OTHERS = drives.simulate_all(folder / "second", second)


def tearDownModule():
    SCRATCH.cleanup()


class Replay(unittest.TestCase):
    def test_states_follow_from_the_controls(self):
        for environment, planner in CASES:
            drive = DRIVES[f"{environment} {planner}"]
            state = [drive.plant[0][name] for name in STATES]
            position = heading = 0.0
            for a, b in zip(drive.plant, drive.plant[1:]):
                state = model.advance(state, [a[u] for u in CONTROLS], [b[u] for u in CONTROLS],
                                      b["t"] - a["t"], STEP)
                position = max(position, math.hypot(state[0] - b["x"], state[1] - b["y"]))
                heading = max(heading, abs(state[4] - b["psi"]))
            with self.subTest(f"{environment} {planner}"):
                self.assertLessEqual(position, 1e-4)
                self.assertLessEqual(heading, 1e-5)

    def test_wheel_loads(self):
        for environment, planner in CASES:
            for row in DRIVES[f"{environment} {planner}"].plant[::20]:
                own = model.wheel_loads([row[name] for name in STATES])
                for name, load in zip(WHEELS, own):
                    self.assertAlmostEqual(row[name], load, delta=1e-6)

    def test_the_replay_itself_would_tell(self):
        """A drive with a tyre of 1 % less grip is seen to differ."""
        drive = DRIVES["E_B P_D"]
        grip, model.PD1 = model.PD1, 0.99 * model.PD1
        try:
            state = [drive.plant[0][name] for name in STATES]
            for a, b in zip(drive.plant, drive.plant[1:]):
                state = model.advance(state, [a[u] for u in CONTROLS], [b[u] for u in CONTROLS],
                                      b["t"] - a["t"], STEP)
        finally:
            model.PD1 = grip
        self.assertGreater(math.hypot(state[0] - drive.end["x"], state[1] - drive.end["y"]), 1e-2)


class Symmetry(unittest.TestCase):
    def same(self, one, other, to_other):
        """Both drives end alike and stay within 1 cm of each other."""
        self.assertEqual(one.outcome, other.outcome)
        self.assertEqual(one.summary["hit"], other.summary["hit"])
        self.assertAlmostEqual(one.time, other.time, delta=1e-3)
        last = min(one.time, other.time)
        worst = 0.0
        for row in one.plant:
            if row["t"] <= last:
                x, y = to_other(row["x"], row["y"])
                away = math.hypot(other.at(row["t"], "x") - x, other.at(row["t"], "y") - y)
                worst = max(worst, away)
        self.assertLessEqual(worst, 0.01)

    def test_moved(self):
        for environment, planner in CASES:
            name = f"{environment} {planner}"
            with self.subTest(name):
                self.same(DRIVES[name], OTHERS[name + " moved"], lambda x, y: (x + EAST, y + NORTH))

    def test_mirrored(self):
        for environment, planner in CASES:
            name = f"{environment} {planner}"
            with self.subTest(name):
                self.same(DRIVES[name + " symmetric"], OTHERS[name + " mirrored"],
                          lambda x, y: (x, -y))

    def test_mirrored_across_the_road(self):
        """With the bounds of psi out of the way, as they are not their own image here."""
        for environment, planner in CASES:
            name = f"{environment} {planner}"
            with self.subTest(name):
                self.same(DRIVES[name + " wide"], OTHERS[name + " mirrored_x"],
                          lambda x, y: (2 * AXIS - x, y))

    def test_the_tyre_itself_is_not_symmetric(self):
        """Without the switch, left and right differ: the mirrored drive is no matter of course."""
        one, other = DRIVES["E_C P_D"], DRIVES["E_C P_D symmetric"]
        last = min(one.time, other.time)
        self.assertGreater(max(abs(row["x"] - other.at(row["t"], "x"))
                               for row in one.plant if row["t"] <= last), 0.01)


class Again(unittest.TestCase):
    def test_resolved_gives_the_same_bits(self):
        for environment, planner in CASES:
            one, other = DRIVES[f"{environment} {planner}"], OTHERS[f"{environment} {planner} again"]
            with self.subTest(f"{environment} {planner}"):
                for file in ("plant.csv", "plans.csv", "resolved.yaml"):
                    self.assertEqual((one.folder / file).read_bytes(),
                                     (other.folder / file).read_bytes(), file)


if __name__ == "__main__":
    unittest.main()
