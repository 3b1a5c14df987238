"""Drives and plans from the command line: what is printed, what is written, what is returned."""

import csv
import json
import re
import unittest
import xml.etree.ElementTree

from program import SOURCE, ProgramTest, run

COLUMNS = "t x y v r psi sa ux ax sr jx Fz_rl Fz_rr Fz_fl Fz_fr clearance".split()


def read_table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Laps(ProgramTest):
    def test_two_laps_in_closed_loop_are_near_the_optimum(self):
        out = self.folder / "laps"
        drive = run("simulate", "circuit", "--out", out)
        self.assertEqual(drive.code, 0, drive.err)
        summary = json.loads((out / "summary.json").read_text())
        first, second = summary["lap_ends_s"]
        self.assertEqual(summary["goal_time_s"], second)
        self.assertGreater(summary["least_edge_distance_m"], 0)
        best = run("lap", "circuit", "--json", "--out", self.folder / "best")
        self.assertEqual(best.code, 0, best.err)
        optimum = json.loads(best.out)
        self.assertEqual(optimum["status"], "converged")
        self.assertLess((second - first) / optimum["time_s"], 1.03)
        self.assertGreater((second - first) / optimum["time_s"], 1)
        points = read_table(self.folder / "best" / "lap.csv")
        self.assertAlmostEqual(float(points[-1]["t_s"]), optimum["time_s"], delta=0.01)

    def test_what_has_no_laps_is_refused(self):
        self.assert_refused(run("lap", "E_C"), 2, "a scenario without a road")
        self.assert_refused(run("check", "circuit", "--planner", "P_E"), 2, "planner P_L")
        self.assert_refused(run("check", "E_C", "--planner", "P_L"), 2, "planner P_L without a road")


class Simulate(ProgramTest):
    def test_a_drive_leaves_its_folder(self):
        out = self.folder / "deep" / "out"
        result = run("simulate", "E_B", "--out", out)
        self.assertEqual((result.code, result.err), (0, ""))
        self.assertIn("E_B with P_D: goal at 6.50 s", result.out)
        self.assertIn(str(out), result.out)

        plant = read_table(out / "plant.csv")
        self.assertEqual(list(plant[0]), COLUMNS)
        times = [float(row["t"]) for row in plant]
        self.assertTrue(all(0 < b - a <= 0.02 + 1e-12 for a, b in zip(times, times[1:])))

        cycles = read_table(out / "cycles.csv")
        self.assertEqual(list(cycles[0])[:6],
                         ["cycle", "t0", "tex", "solve_time_s", "iterations", "status"])
        self.assertEqual([int(row["cycle"]) for row in cycles], list(range(1, len(cycles) + 1)))
        for row in cycles:
            self.assertEqual(row["status"], "solved")
            terms = sum(float(v) for k, v in row.items() if k.startswith("cost_"))
            self.assertAlmostEqual(terms, float(row["cost"]), delta=1e-6)

        plans = read_table(out / "plans.csv")
        self.assertEqual(len(plans), 11 * len(cycles))

        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual((summary["scenario"], summary["planner"], summary["outcome"]),
                         ("E_B", "P_D", "goal"))
        self.assertEqual(summary["cycles"], len(cycles))
        self.assertAlmostEqual(summary["least_clearance_m"],
                               min(float(row["clearance"]) for row in plant), delta=0.02)
        self.assertIn("<html", (out / "report.html").read_text())
        for figure in (out / "figures").glob("*.svg"):
            xml.etree.ElementTree.parse(figure)

    def test_every_vehicle_arrives_by_either_planner(self):
        for vehicle in ("ford_escort", "bmw_320i", "vw_vanagon"):
            for planner in ("P_D", "P_E"):
                result = run("simulate", "E_B", "--vehicle", vehicle, "--planner", planner, "--expect", "goal")
                self.assertEqual((result.code, result.err), (0, ""), f"{vehicle} {planner}")
        result = run("simulate", "E_B", "--vehicle", "tank")
        self.assertEqual(result.code, 2)
        self.assertIn("--vehicle: found vehicle 'tank'", result.err)

    def test_what_is_not_as_believed_drives_again_from_its_resolved_file(self):
        changed = ["--set", "plant.mass_factor=1.3", "--set", "plant.actuator_delay=0.07", "--set",
                   "sensing.position_noise=0.1", "--set", "sensing.obstacle_velocity_factor=0.9"]
        exact, out, again, other = (self.folder / name for name in ("exact", "out", "again", "other"))
        self.assertEqual(run("simulate", "E_B", "--out", exact, "--quiet").code, 0)
        self.assertEqual(run("simulate", "E_B", *changed, "--out", out, "--quiet").code, 0)
        self.assertEqual(run("simulate", out / "resolved.yaml", "--out", again, "--quiet").code, 0)
        self.assertEqual(run("simulate", out / "resolved.yaml", "--set", "sensing.noise_seed=1",
                             "--out", other, "--quiet").code, 0)
        drives = [(folder / "plant.csv").read_bytes() for folder in (exact, out, again, other)]
        self.assertEqual(drives[1], drives[2])
        self.assertEqual(len(set(drives)), 3)

    def test_a_drive_of_verified_plans_says_so(self):
        out = self.folder / "out"
        result = run("simulate", "E_B", "--planner", "P_E", "--out", out, "--expect", "goal")
        self.assertEqual((result.code, result.err), (0, ""))
        summary = json.loads((out / "summary.json").read_text())
        n, rungs = summary["cycles"], summary["rungs"]
        self.assertIn(f"{n} of {n} cycles verified ({rungs['new']} new plan", result.out)
        self.assertIn(f", {rungs['rest']} the rest of the last)\n", result.out)
        self.assertNotIn("warning", result.out)
        self.assertEqual((sum(rungs.values()), summary["cycles_unverified"]), (n, 0))
        cycles = read_table(out / "cycles.csv")
        for rung, count in rungs.items():
            self.assertEqual(sum(row["rung"] == rung for row in cycles), count)

    def test_an_unverified_cycle_is_a_warning(self):
        # O1 stands in front of the vehicle, too near for any way around it.
        out = self.folder / "out"
        result = run("simulate", "E_B", "--planner", "P_E", "--set", "obstacles.O1.x=200", "--set",
                     "obstacles.O1.y=20", "--set", "obstacles.O1.vx=0", "--out", out, "--expect", "crash")
        self.assertEqual((result.code, result.err), (0, ""))
        self.assertRegex(result.out, r"\n  warning  .* without a verified plan, the first at .*: unverified: .* O1")
        rows = read_table(out / "cycles.csv")
        unverified = [row for row in rows if row["verified"] == "0"]
        self.assertTrue(unverified)
        self.assertEqual(json.loads((out / "summary.json").read_text())["cycles_unverified"], len(unverified))
        for row in unverified:
            self.assertEqual(row["status"], "unverified: " + row["refused"])

    def test_that_there_is_no_plan_is_soon_known(self):
        # O2 comes at 27 m/s and is taken as standing: at last it is too near for any plan.
        out = self.folder / "out"
        self.assertEqual(run("simulate", "E_C", "--planner", "P_C", "--tex", "0.06210526315789474", "--set",
                             "obstacles.O2.vy=-27.36842105263158", "--out", out, "--quiet").code, 0)
        last = read_table(out / "cycles.csv")[-1]
        self.assertEqual(last["status"], "infeasible")
        self.assertLess(int(last["iterations"]), 150)

    def test_the_resolved_file_gives_the_same_drive_to_the_bit(self):
        first, second = self.folder / "first", self.folder / "second"
        set_ = ["--set", "obstacles.O2.vy=-9.87654321", "--set", "start.x=6.1",
                "--set", "loop.timeout=6"]
        self.assertEqual(run("simulate", "E_C", "--planner", "P_C", "--tex", ".37", *set_, "--out",
                             first, "--quiet").code, 0)
        self.assertEqual(run("simulate", first / "resolved.yaml", "--out", second, "--quiet").code, 0)
        for name in ("plant.csv", "plans.csv", "resolved.yaml"):
            self.assertEqual((first / name).read_bytes(), (second / name).read_bytes(), name)

    def test_without_out_nothing_is_written(self):
        result = run("simulate", "E_B", "--set", "loop.timeout=1", cwd=self.folder)
        self.assertEqual(result.code, 0)
        self.assertEqual(self.entries(), [])

    def test_a_goal_behind_the_vehicle_is_said_as_the_drive_starts(self):
        behind = ("simulate", "E_C", "--set", "goal.y=-90", "--set", "loop.timeout=0.5")
        self.assertRegex(run(*behind).err, r"^slalom: note: the goal lies .* behind it.*\n$")
        self.assertEqual(run(*behind, "--planner", "P_E").err, "")
        for machine in ("--json", "--quiet"):
            self.assertEqual(run(*behind, machine).err, "")

    def test_json_is_the_summary_and_nothing_else(self):
        result = run("simulate", "E_B", "--planner", "P_C", "--json")
        self.assertEqual((result.code, result.err), (0, ""))
        summary = json.loads(result.out)
        self.assertEqual((summary["outcome"], summary["hit"]), ("crash", "O1"))

    def test_quiet_prints_nothing(self):
        result = run("simulate", "E_B", "--quiet")
        self.assertEqual((result.code, result.out, result.err), (0, "", ""))

    def test_expectations(self):
        for planner, expect, code in (("P_D", "goal", 0), ("P_D", "crash", 1),
                                      ("P_C", "crash", 0), ("P_C", "goal", 1),
                                      ("P_C", "goal,crash", 0), ("P_C", "wheel_lift,timeout", 1)):
            with self.subTest(planner=planner, expect=expect):
                result = run("simulate", "E_B", "--planner", planner, "--expect", expect, "--quiet")
                self.assertEqual((result.code, result.err), (code, ""))
        self.assertEqual(run("simulate", "E_B", "--planner", "P_C", "--quiet").code, 0)

    def test_the_example_of_ten_lines(self):
        example = SOURCE / "examples" / "crossing.yaml"
        self.assertEqual(run("simulate", example, "--expect", "goal", "--quiet").code, 0)

    def test_the_example_of_every_shape_and_motion(self):
        example = SOURCE / "examples" / "shapes.yaml"
        out = self.folder / "out"
        result = run("simulate", example, "--expect", "goal", "--out", out, "--quiet")
        self.assertEqual((result.code, result.err), (0, ""))
        # What is resolved gives the drive again to the bit, without the files beside the scenario.
        again = self.folder / "again"
        self.assertEqual(run("simulate", out / "resolved.yaml", "--out", again, "--quiet").code, 0)
        self.assertEqual((out / "plant.csv").read_text(), (again / "plant.csv").read_text())


class Plan(ProgramTest):
    def test_a_plan_is_printed_and_written(self):
        out = self.folder / "out"
        result = run("plan", "E_C", "--out", out, "--expect", "solved")
        self.assertEqual((result.code, result.err), (0, ""))
        self.assertIn("solved", result.out)
        self.assertEqual(self.entries(out), ["plan.csv", "plan.json", "resolved.yaml"])
        nodes = read_table(out / "plan.csv")
        self.assertEqual(list(nodes[0]), "node t x y v r psi sa ux ax sr jx".split())
        self.assertEqual(len(nodes), 16)
        plan = json.loads((out / "plan.json").read_text())
        self.assertTrue(plan["solved"])
        self.assertEqual(plan["warm_up"]["status"], "solved")
        self.assertGreater(plan["warm_up"]["iterations"], 0)
        self.assertRegex(result.out, "warm-up solve of the same problem: solved after [1-9]")
        self.assertEqual(plan["t_start_s"], 0.5)
        self.assertAlmostEqual(plan["X0p"]["y"], 8.5, delta=1e-6)
        self.assertAlmostEqual(float(nodes[-1]["t"]), 0.5 + plan["tf_s"], delta=1e-12)
        self.assertAlmostEqual(sum(plan["cost_terms"].values()), plan["cost"], delta=1e-6)

    def test_it_is_the_first_plan_of_the_drive(self):
        out = self.folder / "out"
        plan = json.loads(run("plan", "E_B", "--json").out)
        self.assertEqual(run("simulate", "E_B", "--set", "loop.timeout=1", "--out", out,
                             "--quiet").code, 0)
        first = [row for row in read_table(out / "plans.csv") if row["cycle"] == "1"]
        for name, value in plan["end"].items():
            self.assertEqual(float(first[-1][name]), value, name)


class Reproduce(ProgramTest):
    def test_the_drives_end_as_the_papers(self):
        out = self.folder / "out"
        result = run("reproduce", "--out", out, "--json", "--expect", "paper")
        self.assertEqual((result.code, result.err), (0, ""))
        drives = json.loads(result.out)
        self.assertEqual(len(drives), 14 + 6)
        folders = [out / d["scenario"] / d["planner"] for d in drives[:14]]
        folders += [out / "cases" / letter for letter in "ABCDEF"]
        for drive, folder in zip(drives, folders):
            self.assertEqual(json.loads((folder / "summary.json").read_text()), drive)
            self.assertTrue((folder / "report.html").exists())
        self.assertTrue((out / "index.html").exists())
        self.assertTrue(list((out / "figures").glob("*.svg")))
        self.assert_refused(run("reproduce", "--out", out), 3, "holds results already", "--force")


class Variants(ProgramTest):
    def test_they_are_e_c_but_for_what_they_are_named_for(self):
        def resolved(name):
            return re.sub(r"\n(name|title): .*", "", "\n" + run("check", name).out)

        whole = resolved("E_C")
        cones = re.compile(r'\n  - \{name: "cone\d+".*')
        self.assertEqual(len(cones.findall(whole)), 36)
        self.assertEqual(resolved("E_C-no-cones"), cones.sub("", whole))
        seen = run("check", "E_C", "--set", "planner.L_range=50", "--set", "planner.N=10",
                   "--set", "planner.kappa=5").out
        self.assertEqual(resolved("E_C-range-50"), re.sub(r"\n(name|title): .*", "", "\n" + seen))


class Others(ProgramTest):
    def test_check_says_what_is_likely_to_go_wrong(self):
        result = run("check", "E_C", "--set", "goal.y=-90")
        self.assertEqual(result.code, 0)
        notes = [line.removeprefix("slalom: note: ") for line in result.err.splitlines()]
        self.assertIn("degrees off the vehicle's heading, behind it", result.err)
        self.assertEqual(json.loads(run("check", "E_C", "--set", "goal.y=-90", "--json").out)["advice"], notes)
        refused = run("check", "E_C", "--set", "goal.y=281", "--set", "goal.x=8")
        self.assert_refused(refused, 2, "inside obstacle O1 grown by sm_end = 4 m")

    def test_check_prints_what_it_resolved(self):
        result = run("check", "E_B", "--planner", "P_B", "--set", "planner.w_t=42")
        self.assertEqual((result.code, result.err), (0, ""))
        self.assertIn("\n  w_t: 42\n", result.out)
        self.assertIn('name: "P_B"', result.out)
        again = self.write("again.yaml", result.out)
        self.assertEqual(run("check", again).out, result.out)
        resolved = json.loads(run("check", again, "--json").out)
        self.assertEqual((resolved["valid"], resolved["obstacles"]), (True, 3))

    def test_list(self):
        listed = json.loads(run("list", "--json").out)
        names = {kind: [entry["name"] for entry in entries] for kind, entries in listed.items()}
        self.assertEqual(names, {"scenarios": ["E_A", "E_A-figure", "E_B", "E_C",
                                               "E_C-no-cones", "E_C-range-50", "chicane", "circuit",
                                               "door", "double-lane-change", "merge",
                                               "one-crossing", "one-standing", "overtaking",
                                               "parked-row", "pedestrian", "turning-car"],
                                 "planners": ["P_A", "P_B", "P_C", "P_D", "P_E", "P_E_road", "P_L"],
                                 "vehicles": ["bmw_320i", "ford_escort", "hmmwv", "vw_vanagon"],
                                 "studies": ["latency", "paper", "paper-printed", "prediction"]})
        text = run("list").out
        for entries in listed.values():
            for entry in entries:
                self.assertIn(entry["name"], text)
                self.assertIn(entry["title"], text)

    def test_the_version_is_the_projects(self):
        project = (SOURCE / "CMakeLists.txt").read_text()
        version = re.search(r"project\(slalom VERSION ([\d.]+)", project).group(1)
        self.assertEqual(run("--version").out, f"slalom {version}\n")

    def test_help_documents_exit_codes_and_every_command(self):
        text = run("--help").out
        for word in ("simulate", "plan", "reproduce", "check", "list", "Exit codes", "130"):
            self.assertIn(word, text)
        self.assertNotIn("docs", text)
        commands = re.findall(r"^  ([a-z-]+) {2,}", text.split("Subcommands:")[1].split("Exit codes")[0], re.M)
        self.assertGreater(len(commands), 10)
        for command in commands:
            with self.subTest(command):
                result = run(command, "--help")
                self.assertEqual(result.code, 0)
                self.assertIn("Exit codes", result.out)
                self.assertRegex(result.out, "Example: |Start with: ")

    def test_the_generated_reference_is_up_to_date(self):
        page = (SOURCE / "docs" / "scenario-reference.md").read_text()
        self.assertEqual(run("docs", "scenario-reference").out, page)


if __name__ == "__main__":
    unittest.main()
