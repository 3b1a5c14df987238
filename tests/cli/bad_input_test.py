"""Bad input: one message that says where, what was found and what was expected; exit 2, soon."""

import unittest

from program import GOOD, ProgramTest, run

# name: (file's content, parts of the message); the file is my.yaml. One of each way out: before the file is a document,
# while it is read, and when the scenario is whole. tests/io/bad_scenario_test.cpp has all messages.
FILES = {
    "binary": (bytes(range(256)), ["my.yaml:1:1: found binary data", "expected a scenario"]),
    "unknown key": (GOOD + "planner: {base: P_D, wt: 3}\n",
                    ["my.yaml:3:22: found unknown key 'wt' of planner", "did you mean 'w_t'?"]),
    "key with a line break": (GOOD + '"a\\n\\e[2J": 1\n', [r"unknown key 'a\x0a\x1b[2J'"]),
    "start in obstacle": (GOOD + "obstacles: [{name: rock, x: 1, y: 1, r: 3}]\n",
                          ["my.yaml:1:8: found start", "inside obstacle rock"]),
}


class BadInput(ProgramTest):
    def test_files(self):
        for name, (content, parts) in FILES.items():
            with self.subTest(name):
                path = self.write("my.yaml", content)
                before = self.entries()
                for command in (["simulate", path, "--out", self.folder / "out"], ["check", path],
                                ["plan", path]):
                    self.assert_refused(run(*command), 2, *parts)
                self.assertEqual(self.entries(), before)

    def test_hostile_files_end(self):
        """Which once took minutes, or all memory."""
        bomb = "a: &a [x, x, x, x, x, x, x, x, x]\n" + "".join(
            f"{name}: &{name} [" + ", ".join([f"*{before}"] * 9) + "]\n" for before, name in zip("abcdefghi", "bcdefghij"))
        for content, part in ((bomb, "my.yaml:2:8: found a YAML alias"),
                              ("a: " + "[" * 5000 + "]" * 5000, "nesting"),
                              ("#" * (13 << 20), "my.yaml: found a file of more than 12582912 bytes")):
            with self.subTest(part):
                self.assert_refused(run("check", self.write("my.yaml", content), timeout=60), 2, part)

    def test_paths(self):
        for path, part in ((self.folder / "none.yaml", "none.yaml: found no such file"),
                           (self.folder, "found a folder, expected a scenario"),
                           ("E_Z", "found scenario 'E_Z', expected one of E_A, E_A-figure"),
                           ("/dev/zero", "not a regular file")):
            with self.subTest(str(path)):
                out = self.folder / "out"
                self.assert_refused(run("simulate", path, "--out", out), 2, part)
                self.assertFalse(out.exists())

    def test_arguments(self):
        for arguments, parts in (
                ([], ["A subcommand is required"]),
                (["simulat", "E_B"], ["found 'simulat'", "did you mean 'simulate'?"]),
                (["simulate"], ["SCENARIO"]),
                (["simulate", "E_B", "--frce"], ["--frce"]),
                (["simulate", "E_B", "--out", ""], ["--out: found '', expected a folder"]),
                (["simulate", "E_B", "--tex", "soon"], ["--tex", "soon"]),
                (["simulate", "E_B", "--tex", "0"], ["--tex: found tex = 0"]),
                (["simulate", "E_B", "--tex", "nan"], ["--tex: found tex = nan"]),
                (["simulate", "E_B", "--tex", "10.5"], ["--tex: found tex = 10.5", "tf_max = 10"]),
                (["simulate", "E_B", "--planner", "P_Z"], ["--planner: found planner 'P_Z'", "P_A"]),
                (["simulate", "E_B", "--planner", "none.yaml"],
                 ["--planner: found planner 'none.yaml', expected an existing file"]),
                (["simulate", "E_B", "--set", "planner.wt=3"],
                 ["--set planner.wt: found unknown key 'wt'", "did you mean 'w_t'?"]),
                (["simulate", "E_B", "--set", "planner.N=0"], ["--set planner.N: found N = 0"]),
                (["simulate", "E_B", "--set", "planner"], ["--set: found 'planner'"]),
                (["simulate", "E_B", "--expect", "gaol"], ["--expect: found 'gaol'", "'goal'"]),
                (["plan", "E_B", "--expect", "goal"], ["--expect: found 'goal'", "solved"]),
                (["reproduce", "--set", "planner.NN=3"], ["--set planner.NN"]),
                (["reproduce", "--expect", "papre"], ["--expect", "'paper'"]),
                (["lap", "circuit", "--interval", "nan"], ["--interval: found 'nan', expected a number"]),
                (["lap", "circuit", "--interval", "1e-9"], ["--interval: found 1e-09, expected at least"]),
                (["lap", "circuit", "--interval", "inf"], ["--interval"]),
                (["lap", "circuit", "--margin", "nan"], ["--margin: found 'nan'"]),
                (["problems", "goddard", "--tolerance", "nan"], ["--tolerance: found 'nan'"]),
                (["simulate", "E_B", "--record-failures", self.folder / "none", "--record-slow", "nan"],
                 ["--record-slow: found 'nan'"]),
                (["simulate", "E_B", "--json", "--quiet"], ["--quiet"])):
            with self.subTest(arguments):
                self.assert_refused(run(*arguments), 2, *parts)

    def test_a_missing_folder_of_built_ins_is_said(self):
        result = run("list", env={"SLALOM_CONFIG_DIR": str(self.folder / "none")})
        self.assert_refused(result, 2, "SLALOM_CONFIG_DIR", "expected an existing folder")

    def test_ipopt_is_asked_for_where_its_library_is_not(self):
        result = run("simulate", "E_B", "--set", "planner.solver=ipopt",
                     env={"SLALOM_IPOPT": str(self.folder / "none.so")})
        self.assert_refused(result, 2, "--set planner.solver: found solver = ipopt",
                            "expected interior_point: Ipopt's library", "none.so", "SLALOM_IPOPT")


if __name__ == "__main__":
    unittest.main()
