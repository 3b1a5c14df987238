#!/usr/bin/env python3
"""What the README and the examples show really runs."""

import os
import pathlib
import re
import unittest

import drives
from drives import SOURCE

README = (SOURCE / "README.md").read_text()


def block(language):
    return re.search(rf"```{language}\n(.*?)```", README, re.S).group(1)


class Readme(unittest.TestCase):
    def setUp(self):
        self.scratch = drives.scratch()
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)

    def test_scenario_has_ten_lines_and_arrives(self):
        text = block("yaml")
        self.assertEqual(len(text.splitlines()), 10)
        (self.folder / "lorry.yaml").write_text(text)
        commands = re.findall(r"build/slalom (simulate lorry\.yaml .*)", README)
        self.assertEqual(len(commands), 2)
        for command in commands:
            drives.run(*command.split(), "--quiet", "--expect", "goal", cwd=self.folder)
        self.assertTrue((self.folder / "run/lorry/report.html").is_file())

    def test_links_lead_somewhere(self):
        pages = [SOURCE / "README.md", *sorted((SOURCE / "docs").rglob("*.md"))]
        for page in pages:
            for link in re.findall(r"\]\(([^)#\s]+)\)", page.read_text()):
                if "://" not in link:
                    with self.subTest(f"{page.name}: {link}"):
                        self.assertTrue((page.parent / link).exists())

    def test_examples_arrive(self):
        examples = sorted((SOURCE / "examples").glob("*.yaml"))
        self.assertTrue(examples)
        for example in examples:
            drives.run("simulate", example, "--quiet", "--expect", "goal")


class CommandLinePage(unittest.TestCase):
    """docs/command-line.md knows every sub-command and its options, and no other."""

    PAGE = (SOURCE / "docs/command-line.md").read_text()

    def told(self, commands):
        """The options of each command, by its usage and by the table, where a cell may be empty as above, or
        `all but …`."""
        usage = dict(re.findall(r"^\| `([a-z-]+)(.*?)` \|", self.PAGE.split("## Options")[0], re.M))
        told, options = {command: set(re.findall(r"--[a-z-]+", usage[command])) for command in commands}, []
        for cells in re.findall(r"^\| ([^|]*?) ?\| ([^|]+) \|.*\|$", self.PAGE.split("## Options")[1], re.M):
            options = re.findall(r"`(--[a-z-]+)", cells[0]) or options
            but = cells[1].removeprefix("all but ")
            named = set(but.split(", "))
            if not options or named == {"slalom itself"}:
                continue
            self.assertLessEqual(named, set(commands), cells)
            for command in named if but == cells[1] else set(commands) - named:
                told[command].update(options)
        return told

    def test_options(self):
        text = drives.run("--help")
        commands = re.findall(r"^  ([a-z-]+) {2,}", text.split("Subcommands:")[1].split("Exit codes")[0], re.M)
        self.assertIn("simulate", commands)
        told = self.told(commands)
        for command in commands:
            with self.subTest(command):
                shown = set(re.findall(r"^ +(?:-\w,)?(--[a-z-]+)", drives.run(command, "--help"), re.M))
                self.assertEqual(told[command], shown - {"--help"})

    def test_exit_codes(self):
        told = re.findall(r"^\| (\d+) \| (.*) \|$", self.PAGE, re.M)
        shown = re.findall(r"^  (\d+) +(.*)$", drives.run("--help"), re.M)
        self.assertEqual([(code, text.replace("`", "")) for code, text in told], shown)


class OutputPage(unittest.TestCase):
    """docs/output-files.md knows every column and key, and docs/laps.md those of lap.csv."""

    PAGE = (SOURCE / "docs/output-files.md").read_text()

    def setUp(self):
        scratch = drives.scratch()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    @staticmethod
    def columns(table):
        with open(table) as file:
            return set(file.readline().strip().split(","))

    def test_drives(self):
        """Of each kind, for a planner that verifies and a road add to the files, and a closed one."""
        jobs = {"plain": ("E_B",), "verifying": ("E_C", "--planner", "P_E", "--set", "loop.timeout=2"),
                "road": ("circuit", "--set", "loop.timeout=2")}
        kinds = {}
        for kind, drive in drives.simulate_all(self.folder, jobs).items():
            kinds[kind] = set(drive.summary)
            for table in ("plant.csv", "plans.csv", "cycles.csv"):
                kinds[kind] |= self.columns(drive.folder / table)
        self.assertTrue({"rungs", "cycles_unverified", "refused"} <= kinds["verifying"] - kinds["plain"])
        self.assertTrue({"lap_ends_s", "progress_m", "least_edge_distance_m"} <= kinds["road"] - kinds["plain"])
        self.assert_told(set.union(*kinds.values()))

    def test_plans(self):
        drives.run("plan", "E_B", "--out", self.folder / "plan", "--quiet")
        plan = (self.folder / "plan/plan.json").read_text()
        self.assert_told(set(re.findall(r'^  "(\w+)":', plan, re.M)) | self.columns(self.folder / "plan/plan.csv"))

    def test_laps(self):
        drives.run("lap", "circuit", "--interval", 20, "--meshes", 1, "--out", self.folder / "lap", "--quiet")
        self.assert_told(self.columns(self.folder / "lap/lap.csv"),
                         self.PAGE + (SOURCE / "docs/laps.md").read_text())

    def assert_told(self, names, page=PAGE):
        for name in names:
            told = name[len("cost_"):] if name.startswith("cost_") and name != "cost_terms" else name
            told = "soft …" if told.startswith("soft ") else told  # a limit's name
            with self.subTest(name):
                self.assertTrue(f"`{told}`" in page, told)


if __name__ == "__main__":
    unittest.main()
