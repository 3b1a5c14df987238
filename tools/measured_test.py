#!/usr/bin/env python3
"""The stamp of measured pages, and which of them are stale, on a repository made up for it."""

import argparse
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import measured  # noqa: E402

PAGE = measured.Page("realtime", "realtime", "tools/realtime.py", ("src/nlp", "include/slalom/nlp"))


class Table(unittest.TestCase):
    def test_it_names_what_is_there(self):
        makefile = (measured.ROOT / "Makefile").read_text()
        for page in measured.PAGES:
            self.assertRegex(makefile, rf"(?m)^{page.target}: ")
            for path in page.measures:
                self.assertTrue(any(measured.ROOT.glob(path)), path)
            # The target runs the tool.
            recipe = re.search(rf"(?m)^{page.target}: .*\n((?:\t.*\n)+)", makefile)[1]
            self.assertIn(f"python3 {page.tool}", recipe)

    def test_a_tool_counts_with_what_it_imports(self):
        self.assertEqual(set(measured.written_by("tools/planner_ablation.py")), {f"tools/{name}.py" for name in (
            "planner_ablation", "verified_planner", "first_sight", "random_scenarios", "sweeps")})  # fmt: skip
        self.assertIn("benchmarks/contestants.py", measured.written_by("benchmarks/perturb.py"))

    def test_pages_of_files_from_elsewhere_are_made_where_their_folder_is_given(self):
        self.assertFalse({"laps", "commonroad"} & set(measured.targets({"TRACKS": ""})))
        self.assertEqual({"laps", "commonroad"} & set(measured.targets({"TRACKS": "tracks"})), {"laps"})
        self.assertIn("results", measured.targets({}))

    def test_it_has_every_page(self):
        known = {page.name for page in measured.PAGES}
        self.assertEqual({file.stem for file in measured.FOLDER.glob("*.md")} - known, set())


class Repository(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name) / "work"
        self.root.mkdir()
        self.git("init", "-q")
        self.commit("src/nlp/a.cpp", "1")

    def git(self, *arguments):
        subprocess.run(["git", "-C", self.root, "-c", "user.name=t", "-c", "user.email=t@example.org", *arguments],
                       check=True)  # fmt: skip

    def put(self, file, text):
        (self.root / file).parent.mkdir(parents=True, exist_ok=True)
        (self.root / file).write_text(text)

    def commit(self, file, text):
        self.put(file, text)
        self.git("add", "-A")
        self.git("commit", "-qm", file)

    def stamped(self, at=None):
        at = at or measured.commit(self.root)
        self.put("docs/measured/realtime.md", f"# T\n\n{measured.stamp('make realtime', at=at)}\ntext\n")

    def test_a_page_is_stale_once_what_it_measures_has_changed(self):
        self.stamped()
        self.commit("src/sim/b.cpp", "1")
        self.assertEqual(measured.stale(PAGE, self.root), "")
        self.commit("src/nlp/a.cpp", "2")
        self.assertRegex(measured.stale(PAGE, self.root), "commits since to what it measures: 1$")
        self.commit("tools/robustness.py", "1")
        self.assertRegex(measured.stale(PAGE, self.root), "commits since to what it measures: 2$")
        self.commit("tools/quick.py", "1")
        star = PAGE._replace(measures=("src/nlp/*.cpp",))
        self.assertRegex(measured.stale(star, self.root), "commits since to what it measures: 2$")

    def test_what_cannot_be_compared_is_said(self):
        self.assertEqual(measured.stale(PAGE, self.root), "is not there")
        self.put("docs/measured/realtime.md", "text\n")
        self.assertEqual(measured.stale(PAGE, self.root), "has no stamp")
        self.stamped("0123456")
        self.assertIn("0123456, which is not in the history", measured.stale(PAGE, self.root))
        self.put("src/nlp/a.cpp", "3")
        self.stamped()
        self.assertIn("with changes not committed", measured.stale(PAGE, self.root))

    def test_generated_pages_do_not_make_the_tree_dirty(self):
        self.commit("docs/measured/realtime.md", "text\n")
        self.put("docs/measured/realtime.md", "other\n")
        self.assertNotIn("dirty", measured.commit(self.root))
        self.put("src/nlp/a.cpp", "3")
        self.assertIn("-dirty", measured.commit(self.root))

    def test_a_source_that_git_does_not_know_yet_makes_the_tree_dirty(self):
        self.put("notes.txt", "text\n")
        self.assertNotIn("dirty", measured.commit(self.root))
        self.put("include/slalom/nlp/new.hpp", "1")
        self.assertIn("-dirty", measured.commit(self.root))

    def test_without_history_nothing_is_judged(self):
        self.commit("src/nlp/a.cpp", "2")
        self.assertIn(f"0 of {len(measured.PAGES)} pages", measured.check(self.root)[0])
        shallow = self.root.parent / "shallow"
        self.git("clone", "-q", "--depth", "1", f"file://{self.root}", str(shallow))
        for root in (shallow, self.root.parent):
            self.assertEqual(len(measured.check(root)), 1)
            self.assertIn("no history", measured.check(root)[0])


class Stamp(unittest.TestCase):
    def test_it_says_what_where_and_when(self):
        text = measured.stamp("make realtime", sys.executable)
        self.assertRegex(text, r"^\*Written by `make realtime`; .* on \d{4}-\d\d-\d\d: .*, \d+ cores, kernels "
                               r"(avx2|baseline), .*\.\*\n$")  # fmt: skip
        self.assertIn(measured.commit(), text)

    def test_a_page_of_fewer_drives_names_the_tool_that_made_it(self):
        parser = argparse.ArgumentParser(prog="some_tool.py")
        parser.add_argument("--most", type=int, default=5)
        self.assertEqual(measured.command_of(parser, parser.parse_args([]), "some-target", "most"), "make some-target")
        self.assertEqual(measured.command_of(parser, parser.parse_args(["--most", "2"]), "some-target", "most"),
                         "tools/some_tool.py --most 2")

    def test_what_differs_is_named_alone(self):
        parser = argparse.ArgumentParser(prog="perturb.py")
        parser.add_argument("--count", type=int, default=5)
        parser.add_argument("--solve-limit", type=float, default=1)
        parser.add_argument("--names", nargs="*")
        options = parser.parse_args(["--names", "a", "b", "--solve-limit", "2"])
        made_by = [measured.command_of(parser, options, target, "count", "names", "solve_limit", given=given)
                   for target, given in (("laps TRACKS=folder", ""), ("verdicts", "verdicts"))]  # fmt: skip
        self.assertEqual(made_by, ["benchmarks/perturb.py FOLDER --names a b --solve-limit 2.0",
                                   "benchmarks/perturb.py verdicts --names a b --solve-limit 2.0"])  # fmt: skip

    def test_a_page_has_the_commit_that_its_measuring_began_with(self):
        with unittest.mock.patch.object(measured, "commit", side_effect=["aaaaaaa", "bbbbbbb"]):
            measured.commit_at_start.cache_clear()
            self.addCleanup(measured.commit_at_start.cache_clear)
            work = measured.page_parser("realtime", "Text.").parse_args([]).work
            self.assertIn("at commit aaaaaaa on", measured.stamp("make realtime"))
        self.assertEqual(work, measured.ROOT / "run/measured/aaaaaaa/realtime")

    def test_programs_that_the_commit_does_not_tell_apart_have_folders_of_their_own(self):
        def folder(commit, text):
            program.write_text(text)
            with (unittest.mock.patch.object(measured, "PROGRAM", built),
                  unittest.mock.patch.object(measured, "commit_at_start", lambda: commit)):
                return measured.page_parser("realtime", "Text.").parse_args(["--program", str(program)]).work
        with tempfile.TemporaryDirectory() as scratch:
            built = program = pathlib.Path(scratch) / "slalom"
            self.assertEqual(folder("aaaaaaa", "one"), folder("aaaaaaa", "two"))
            self.assertNotEqual(folder("aaaaaaa-dirty", "one"), folder("aaaaaaa-dirty", "two"))
            self.assertEqual(folder("aaaaaaa-dirty", "one"), folder("aaaaaaa-dirty", "one"))
            program = pathlib.Path(scratch) / "other"
            self.assertNotEqual(folder("aaaaaaa", "one"), folder("aaaaaaa", "two"))

    def test_the_compiler_is_the_programs_own(self):
        with tempfile.NamedTemporaryFile(suffix=".o") as file:
            file.write(b"\x7fELF\0GCC: (Debian 12.2.0-14) 12.2.0\0.text")
            file.flush()
            self.assertEqual(measured.compiler(file.name), "g++ (Debian 12.2.0-14) 12.2.0")
        with tempfile.NamedTemporaryFile(suffix=".so") as file:  # stripped
            for name in ("clang version 20.1.2", "g++ 12.2.0"):
                file.seek(0)
                file.write(b"\x7fELF\0" + name.encode() + b" (somewhere)\0.text")
                file.flush()
                self.assertEqual(measured.compiler(file.name), name)
        self.assertEqual(measured.compiler("/nowhere"), "unknown compiler")

    def test_writing_makes_the_folder_and_leaves_nothing_beside(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "new/page.md"
            measured.write(file, "text\n")
            self.assertEqual([f.name for f in file.parent.iterdir()], ["page.md"])


if __name__ == "__main__":
    unittest.main()
