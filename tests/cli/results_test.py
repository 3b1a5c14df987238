"""Folders of results: none is replaced unasked, and no file of an older run stays beside those of a newer one."""

import json
import unittest

from program import SOURCE, ProgramTest, interrupt, run, start, until

CIRCUIT = (SOURCE / "config/scenarios/circuit.yaml").read_text()
COARSE = ("--interval", 20, "--meshes", 1)
LAP = ("lap", "circuit", *COARSE)
PLAN = ("plan", "E_B", "--quiet")
DRIVE = ("simulate", "E_B", "--set", "loop.timeout=1", "--quiet")
FILES = {
    PLAN: ["plan.csv", "plan.json", "resolved.yaml"],
    DRIVE: ["cycles.csv", "figures", "plans.csv", "plant.csv", "report.html", "resolved.yaml", "summary.json"],
    (*LAP, "--quiet"): ["lap.csv"],
}


class Results(ProgramTest):
    def test_each_command_refuses_the_results_of_each_other(self):
        for first, names in FILES.items():
            out = self.folder / first[0]
            self.assertEqual(run(*first, "--out", out).code, 0)
            self.assertEqual(sorted(p.name for p in out.iterdir()), names)
            for second in FILES:
                with self.subTest(first=first[0], second=second[0]):
                    self.assert_refused(run(*second, "--out", out), 3, "holds results already", "--force")

    def test_forced_results_stand_alone(self):
        out = self.folder / "out"
        out.mkdir()
        (out / "notes.txt").write_text("mine")
        for before in FILES:
            for command, names in FILES.items():
                with self.subTest(before=before[0], after=command[0]):
                    self.assertEqual(run(*before, "--out", out, "--force").code, 0)
                    self.assertEqual(run(*command, "--out", out, "--force").code, 0)
                    self.assertEqual(sorted(p.name for p in out.iterdir()), sorted([*names, "notes.txt"]))
        self.assertEqual((out / "notes.txt").read_text(), "mine")

    def test_of_two_at_once_the_second_is_refused(self):
        out = self.folder / "out"
        first = start("simulate", "E_C", "--set", "loop.tex=0.001", "--out", out)  # thousands of cycles
        self.addCleanup(first.kill)
        until(lambda: (out / ".results.lock").exists() or first.poll() is not None)
        for command in FILES:
            for forced in ((), ("--force",)):
                with self.subTest(command=command[0], forced=forced):
                    self.assert_refused(run(*command, "--out", out, *forced), 3, "another process writes its results there")
        self.assertIsNone(first.poll(), "the first is still at it")
        self.assertEqual(interrupt(first).code, 130)
        self.assertEqual(json.loads((out / "summary.json").read_text())["scenario"], "E_C")
        self.assert_refused(run(*DRIVE, "--out", out), 3, "holds results already", "--force")

    def test_figures_of_ones_own_stay(self):
        out = self.folder / "out"
        self.assertEqual(run(*DRIVE, "--out", out).code, 0)
        (out / "figures" / "mine.svg").write_text("mine")
        self.assertEqual(run(*PLAN, "--out", out, "--force").code, 0)
        self.assertEqual([p.name for p in (out / "figures").iterdir()], ["mine.svg"])


class Plan(ProgramTest):
    def test_an_expected_outcome_is_success(self):
        cut = ("plan", "E_B", "--set", "planner.max_iterations=1")
        for expected, code in (("not_optimal", 0), ("solved", 1), ("solved,not_optimal", 0)):
            with self.subTest(expected):
                result = run(*cut, "--expect", expected, "--json")
                self.assertEqual(result.code, code, result.err)
                self.assertEqual(json.loads(result.out)["status"], "iteration_limit")
        self.assertEqual(run("plan", "E_B", "--quiet", "--expect", "not_optimal").code, 1)


class Lap(ProgramTest):
    def lap(self, *arguments):
        result = run("lap", "circuit", "--interval", 20, "--json", *arguments)
        return result.code, json.loads(result.out)

    def test_options_have_effect(self):
        _, plain = self.lap("--meshes", 1)
        self.assertEqual(len(plain["meshes"]), 1)
        _, narrow = self.lap("--meshes", 1, "--margin", 1)
        self.assertGreater(narrow["time_s"], plain["time_s"] + 0.1)
        _, finer = self.lap("--meshes", 2)
        self.assertEqual(len(finer["meshes"]), 2)

    def test_an_outcome_that_was_not_expected(self):
        self.assertEqual(self.lap("--meshes", 1, "--expect", "not_solved")[0], 1)
        self.assertEqual(self.lap("--meshes", 1, "--expect", "solved,not_solved")[0], 0)


class NamesThatAreNotUtf8(ProgramTest):
    """Files may be named by any bytes; JSON has U+FFFD for those that are no text."""

    def json_of(self, *arguments, code=0):
        result = run(*arguments, "--json")
        self.assertEqual((result.code, result.err), (code, ""), arguments)
        return json.loads(result.out)

    def test_scenarios(self):
        odd = self.folder / "\udcff"  # as Python has the byte 0xff of a name
        odd.mkdir()
        file = odd / "\udcff.yaml"
        file.write_text("\n".join((SOURCE / "config/scenarios/E_B.yaml").read_text().splitlines()[1:]))
        drive = ("--set", "loop.timeout=1")
        for arguments in (("check", file), ("plan", file), ("simulate", file, *drive, "--out", odd / "out")):
            with self.subTest(arguments[0]):
                self.assertEqual(self.json_of(*arguments)["scenario"], "\ufffd")
        made = self.json_of("make-scenarios", "gates", "--count", 2, "--out", odd / "made")
        self.assertEqual(len(made["files"]), 2)
        self.assertTrue(made["files"][0].endswith("\ufffd/made/gates-0001.yaml"), made)
        file.write_text("\n".join(CIRCUIT.splitlines()[1:]))
        self.assertEqual(self.json_of("lap", file, *COARSE)["scenario"], "\ufffd")

    def test_recorded_solves(self):
        file = self.folder / "\udcff.yaml"
        file.write_text("\n".join((SOURCE / "config/scenarios/E_B.yaml").read_text().splitlines()[1:]))
        records = self.folder / "records"
        recorded = run("simulate", file, "--set", "loop.timeout=1", "--record-failures", records, "--record-slow", 0,
                       "--quiet")
        self.assertEqual((recorded.code, recorded.err), (0, ""))
        self.assertEqual(self.json_of("replay", min(records.iterdir()))["scenario"], "\ufffd")

    def test_studies(self):
        study = self.folder / "\udcff.yaml"
        study.write_text("scenario: E_B\nplanners: [P_D]\nset: {loop.timeout: 1}\n"
                         "axes: [{key: loop.tex, values: [0.25, 0.5]}]\n")
        folders = []
        for shard in ("1/2", "2/2"):
            folders.append(self.folder / ("\udcff" + shard[0]))
            swept = run("sweep", study, "--shard", shard, "--out", folders[-1], "--json")
            self.assertEqual(swept.code, 0, swept.err)
            for line in swept.out.splitlines():
                json.loads(line)
        merged = self.json_of("merge", *folders, "--out", self.folder / "all")
        self.assertEqual(merged, {"study": "\ufffd", "trials": 2, "merged": 2, "missing": 0})


if __name__ == "__main__":
    unittest.main()
