"""Solves that failed, were slow or cut off are written down and solved again to the same bits."""

import json
import unittest

from program import ProgramTest, run

FAST = ("--set", "loop.timeout=2", "--quiet")


# Bodies that turn, far from the origin of the frame that plans are made in.
TURN = """name: turn
vehicle: {base: hmmwv, footprint: rectangle}
planner: {base: %s, prediction: %s, sm_start: 0.5, sm_end: 1, verified_clearance: 0.5, kept_clearance: 0.3}
start: {x: 8200, y: -4100, psi_deg: 90, ux: 15}
goal: {x: 8200, y: -3900, psi_deg: 90, sigma: 5}
region: {x_min: 8188, x_max: 8212}
obstacles:
  - {name: rock, x: 8202, y: -4070, polygon: [[-1, -1], [2, 0], [0, 1.5]], margin_start: 0.1, margin_rate: 0.05}
  - {name: car, length: 4.5, width: 1.8, table: [[0, 8194, -4040, -1.57], [1, 8194, -4048, -1.57],
     [2, 8195, -4056, -1], [3, 8200, -4060, 0], [4, 8203, -4060, 0]], before: absent}
  - {name: walker, r: 0.4, path: [[8205, -4000], [8195, -4000]], speed: 1.2}
loop: {sm_crash: 0}
"""


class Replay(ProgramTest):
    def record(self, *arguments, solver="interior_point"):
        """Drives 2 s of E_B; the recorded files, by name."""
        folder = self.folder / "recorded"
        result = run("simulate", "E_B", "--planner", "P_D", "--set", f"planner.solver={solver}",
                     *FAST, "--record-failures", folder, *arguments)
        self.assertEqual(result.code, 0, result.err)
        return {path.name: path for path in sorted(folder.glob("*"))}

    def assert_replays(self, path):
        result = run("replay", path, "--json")
        self.assertEqual(result.code, 0, result.out + result.err)
        replayed = json.loads(result.out)
        self.assertTrue(replayed["same"])
        self.assertEqual(replayed["recorded"]["iterations"], replayed["replayed"]["iterations"])
        self.assertEqual(replayed["recorded"]["phi"], replayed["replayed"]["phi"])
        return replayed

    def test_every_solve_of_a_drive(self):
        files = self.record("--record-slow", "0")
        self.assertEqual(len(files), 5)  # the warm-up and four cycles
        for path in files.values():
            self.assertEqual(self.assert_replays(path)["replayed"]["status"], "solved")
            self.assertLess(path.stat().st_size, 200_000)

    def test_nothing_where_nothing_fails_or_is_slow(self):
        self.assertEqual(self.record("--record-slow", "1000"), {})

    def test_failures_alone(self):
        files = self.record("--set", "planner.max_iterations=2")
        self.assertEqual(list(files), ["cycle-0.json", "cycle-1.json"])
        for path in files.values():
            self.assertEqual(self.assert_replays(path)["replayed"]["status"], "iteration_limit")

    def test_a_solve_cut_off_by_time_ends_at_the_same_iteration(self):
        files = self.record("--set", "loop.solve_time_limit=1e-4", "--set", "loop.warm_up=false")
        self.assertIn("cycle-1.json", files)
        replayed = self.assert_replays(files["cycle-1.json"])
        self.assertEqual(replayed["recorded"]["status"], "time_limit")
        self.assertEqual(replayed["replayed"]["status"], "iteration_limit")

    def test_both_kernel_sets(self):
        path = self.record("--record-slow", "0")["cycle-2.json"]
        recorded = json.loads(path.read_text())
        if recorded["kernels"] == "baseline":
            self.skipTest("this processor has the baseline set alone")
        recorded["kernels"] = "baseline"
        result = run("replay", self.write("other.json", json.dumps(recorded)))
        self.assertEqual(result.code, 1, result.out + result.err)
        self.assertIn("kernel set baseline", result.out)
        self.assertIn("NOT the same", result.out)

    def test_one_bit_of_the_answer_is_seen(self):
        path = self.record("--record-slow", "0")["cycle-1.json"]
        for key in ("x", "y", "zl", "zu"):
            recorded = json.loads(path.read_text())
            index = next(i for i, v in enumerate(recorded["end"][key]) if v != 0)
            recorded["end"][key][index] *= 1 + 2.3e-16
            result = run("replay", self.write("bit.json", json.dumps(recorded)), "--quiet")
            self.assertEqual((result.code, result.out, result.err), (1, "", ""), key)

    def test_plans_that_are_verified_are_verified_again(self):
        folder = self.folder / "plans"
        result = run("simulate", "E_B", "--planner", "P_E", *FAST, "--set", "sensing.position_noise=0.05",
                     "--record-failures", folder, "--record-slow", "0")
        self.assertEqual(result.code, 0, result.err)
        files = sorted(folder.glob("cycle-*.json"))
        self.assertGreaterEqual(len(files), 4)
        for path in files:
            self.assert_same(path)
        recorded = json.loads(files[1].read_text())
        self.assertEqual(recorded["format"], "slalom recorded plan 1")
        # A plan that was moved by a centimetre keeps something else.
        for state in recorded["states"]:
            state[0] += 0.01
        result = run("replay", self.write("moved.json", json.dumps(recorded)))
        self.assertEqual(result.code, 1, result.out + result.err)
        self.assertIn("NOT the same", result.out)
        recorded["controls"].pop()
        self.assert_refused(run("replay", self.write("short.json", json.dumps(recorded))), 2,
                            "controls", "as t has")
        self.assert_bad_plans(json.loads(files[1].read_text()))

    def assert_bad_plans(self, whole):
        """Motions that no planner made are refused: some would be looked at without end."""
        times = whole["t"]
        for change, parts in (
                ({"t": [*times[:-1], 1e18]}, ["t: found 1e+18"]),
                ({"t": [*times[:-1], "inf"]}, ["t: found inf"]),
                ({"t": ["nan", *times[1:]]}, ["t: found nan"]),
                ({"t": [*times[:-1], times[-1] + 1000]}, ["within 1 s of the last"]),
                ({"t": times[:1], "states": whole["states"][:1], "controls": whole["controls"][:1]},
                 ["t: found 1 times, expected at least 2"]),
                ({"tex": 1e-300}, ["tex: found 1e-300"]), ({"tex": "nan"}, ["tex: found nan"]),
                ({"t0": -1e300}, ["t0: found -1e+300"])):
            with self.subTest(change=list(change)):
                path = self.write("bad.json", json.dumps({**whole, **change}))
                self.assert_refused(run("replay", path), 2, "bad.json", *parts)

    def test_along_a_road(self):
        for planner, scenario in (("P_D", "circuit"), ("P_E_road", "chicane"), ("P_L", "circuit")):
            with self.subTest(planner=planner):
                folder = self.folder / f"road-{planner}"
                result = run("simulate", scenario, "--planner", planner, *FAST, "--record-failures", folder,
                             "--record-slow", "0")
                self.assertEqual(result.code, 0, result.err)
                files = sorted(folder.glob("cycle-*.json"))
                self.assertTrue(files)
                for path in files:
                    self.assertEqual(run("replay", path).code, 0, path)

    def test_each_of_several_solves_of_a_cycle_has_its_file(self):
        folder = self.folder / "several"
        result = run("simulate", "door", "--planner", "P_D", "--set", "planner.between_nodes=refine",
                     *FAST[:-1], "--record-failures", folder, "--record-slow", "0")
        self.assertEqual(result.code, 0, result.err)
        files = sorted(path.name for path in folder.glob("*"))
        self.assertIn(f" {len(files)} solves in ", result.out)
        self.assertIn("cycle-0-2.json", files)
        self.assertEqual(run("replay", folder / "cycle-0-2.json").code, 0)

    def test_bodies_that_turn(self):
        for planner in ("P_D", "P_E"):
            for prediction in ("known", "constant_velocity", "constant_turn"):
                with self.subTest(planner=planner, prediction=prediction):
                    folder = self.folder / f"{planner}-{prediction}"
                    scene = self.write("turn.yaml", TURN % (planner, prediction))
                    result = run("simulate", scene, *FAST, "--record-failures", folder, "--record-slow",
                                 "0")
                    self.assertIn(result.code, (0, 1), result.err)
                    files = sorted(folder.glob("cycle-*.json"))
                    self.assertTrue(files)
                    for path in files:
                        self.assert_same(path)
                    if planner == "P_E":
                        bodies = json.loads(files[-1].read_text())["obstacles"]
                        self.assertEqual(len(bodies[0]["polygon"]), 3)
                        moved = {"known": "moved", "constant_turn": "turning"}.get(prediction)
                        if moved:
                            self.assertIn(moved, bodies[-1]["trajectory"])

    def assert_same(self, path):
        result = run("replay", path, "--json")
        self.assertEqual(result.code, 0, result.out + result.err)
        self.assertTrue(json.loads(result.out)["same"])

    def test_bad_files(self):
        whole = json.loads(self.record("--record-slow", "0")["cycle-1.json"].read_text())

        def changed(*path, to):
            copy = json.loads(json.dumps(whole))
            inner = copy
            for key in path[:-1]:
                inner = inner[key]
            if to is None:
                del inner[path[-1]]
            else:
                inner[path[-1]] = to
            return json.dumps(copy)

        cases = {
            "no JSON": ("{", ["bad.json: found no valid JSON"]),
            "no object": ("[]", ["bad.json: found no 'format'"]),
            "another format": (changed("format", to="x"), ["bad.json: format: found 'x'"]),
            "no start": (changed("start", to=None), ["bad.json: found no 'start'"]),
            "text for a number": (changed("start", "x", 3, to="soon"),
                                  ["bad.json: start.x[3]: found \"soon\", expected a number"]),
            "short start": (changed("start", "x", to=[1.0]), ["start: x", "found 1 numbers"]),
            "empty start": (changed("start", "x", to=[]), ["start: x", "found 0 numbers"]),
            "no time": (changed("request", "t0", to="nan"), ["recorded solve: t0: found nan"]),
            "short state": (changed("request", "X0p", to=[1, 2]),
                            ["bad.json: request.X0p: found 2 numbers, expected 8"]),
            "kernel set": (changed("kernels", to="neon"),
                           ["bad.json: kernels: found \"neon\", expected one of baseline, avx2, avx512"]),
            "status": (changed("status", to="fine"), ["bad.json: status: found \"fine\""]),
            "option": (changed("options", "tol", to=-1), ["bad.json: options", "tol = -1"]),
            "scenario": (changed("scenario", to="start: {x: 0}"), ["bad.json: scenario:1:"]),
            "fraction": (changed("iterations", to=1.5),
                         ["bad.json: iterations: found 1.5, expected an integer"]),
        }
        for name, (content, parts) in cases.items():
            with self.subTest(name):
                self.assert_refused(run("replay", self.write("bad.json", content)), 2, *parts)
        self.assert_refused(run("replay", self.folder / "none.json"), 2, "no such file")
        self.assert_refused(run("replay", self.folder), 2, "a folder")

    def test_older_recordings_stay_unless_forced(self):
        self.record("--record-slow", "0")
        folder = self.folder / "recorded"
        again = ("simulate", "E_B", *FAST, "--record-failures", folder)
        self.assert_refused(run(*again), 3, "holds recorded solves already", "--force")
        self.assertEqual(run(*again, "--force").code, 0)
        self.assertEqual(self.entries(folder), [])

    def test_slow_needs_a_folder(self):
        self.assert_refused(run("simulate", "E_B", "--record-slow", "1"), 2, "--record-failures")


if __name__ == "__main__":
    unittest.main()
