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
    """docs/command-line.md knows every sub-command and option, and no other."""

    PAGE = (SOURCE / "docs/command-line.md").read_text()

    def test_options(self):
        text = drives.run("--help")
        commands = re.findall(r"^  ([a-z-]+) {2,}", text.split("Subcommands:")[1], re.M)
        self.assertIn("simulate", commands)
        helps = text + "".join(drives.run(command, "--help") for command in commands)
        shown = set(re.findall(r"(--[a-z]+)", helps)) - {"--help"}
        told = set(re.findall(r"`(?:slalom [A-Z… ]*)?(--[a-z]+)", self.PAGE)) - {"--help"}
        self.assertEqual(shown, told)
        for command in commands:
            self.assertIn(f"| `{command}", self.PAGE)

    def test_exit_codes(self):
        told = re.findall(r"^\| (\d+) \| (.*) \|$", self.PAGE, re.M)
        shown = re.findall(r"^  (\d+) +(.*)$", drives.run("--help"), re.M)
        self.assertEqual([(code, text.replace("`", "")) for code, text in told], shown)


class OutputPage(unittest.TestCase):
    """docs/output-files.md knows every column and key."""

    PAGE = (SOURCE / "docs/output-files.md").read_text()

    def test_columns(self):
        with drives.scratch() as folder:
            out = pathlib.Path(folder) / "out"
            drives.run("simulate", "E_B", "--out", out, "--quiet")
            names = set()
            for table in ("plant.csv", "plans.csv", "cycles.csv"):
                with open(out / table) as file:
                    names |= set(file.readline().strip().split(","))
            names |= set(drives.Drive(out).summary)
            drives.run("plan", "E_B", "--out", pathlib.Path(folder) / "plan", "--quiet")
            plan = (pathlib.Path(folder) / "plan/plan.json").read_text()
            names |= set(re.findall(r'^  "(\w+)":', plan, re.M))
        for name in names:
            told = name[len("cost_"):] if name.startswith("cost_") and name != "cost_terms" else name
            self.assertIn(f"`{told}`", self.PAGE)


if __name__ == "__main__":
    unittest.main()
