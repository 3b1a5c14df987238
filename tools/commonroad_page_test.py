#!/usr/bin/env python3
"""What commonroad_page.py makes of imported files, drives and the checker's table; no program is needed."""

import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import commonroad_check  # noqa: E402
import commonroad_page as tool  # noqa: E402

NOTES = ["traffic sign 1 (MAX_SPEED 8): left out", "traffic sign 2 (MAX_SPEED 8): left out", "car8: left out"]


def checked(name, collision="no", off="no", reached="3.10 s"):
    return f"{commonroad_check.HEAD}\n| {name} | goal | 3.10 | {collision} | {off} | 0.42 | {reached} |  | both |\n\n1 of 1\n"


def row(name, **cells):
    return {"name": name, "notes": NOTES, "load": 3.5, "verdict": tool.verdict_of(name, checked(name, **cells)),
            "summary": {"outcome": "goal", "time_s": 3.1, "least_clearance_m": 0.41, "least_edge_distance_m": 0.1,
                        "cpu_time_max_s": 0.08}}  # fmt: skip


class Page(unittest.TestCase):
    def test_a_drive_has_its_rows(self):
        text = tool.page([row("A_1")], "A stamp.\n")
        self.assertIn("| A_1 | goal | 3.10 | 0.41 | 0.10 | 0.080 |", text)
        self.assertIn("| A_1 | no | no | 0.42 | 3.10 s | – | both |", text)
        self.assertIn("Load of the machine meanwhile: 3.5 to 3.5 on", text)
        self.assertIn("| A_1 | traffic signs (2); car8: left out |", text)
        self.assertIn("Imported: 1 of 1. Drives that ended at the goal: 1. By the checker: 1 of 1 touch nothing", text)
        self.assertIn("of 1 with a goal 1 reach it", text)

    def test_what_is_wrong_is_counted(self):
        rows = [row("A_1", collision="from 1.00 s"), row("A_2", off="from 2.00 s"), row("A_3", reached="no"),
                row("A_4", off="starts off it", reached="none asked"), {"name": "A_5", "refused": "a.xml:3: no goal"}]  # fmt: skip
        text = tool.page(rows, "A stamp.\n")
        self.assertIn("Imported: 4 of 5", text)
        self.assertIn("1 of 4 touch nothing and stay on the road, 1 touch nothing and start off it; of 3 with a goal 2 reach it",
                      text)
        self.assertIn("| A_5 | a.xml:3: no goal | – |", text)

    def test_a_drive_that_could_not_be_judged_says_why(self):
        lost = row("A_1") | {"verdict": {"message": "not exported"}}
        self.assertIn("| A_1 | not exported | – |", tool.page([lost], "A stamp.\n"))


class Judges(unittest.TestCase):
    def test_they_agree_where_their_time_steps_do(self):
        self.assertEqual(commonroad_check.together((None, 3), (None, 3)), (None, 3, "both"))
        self.assertEqual(commonroad_check.together((2, None), None), (2, None, "shapely"))
        self.assertEqual(commonroad_check.together((7, None), (5, 9)),
                         (5, 9, "differ: collision step 7 and step 5, off the road none and step 9"))

    def test_a_drive_that_starts_off_the_road_is_counted_apart(self):
        verdicts = {"A_1": {}, "A_2": {"starts_off": True}, "A_3": {"off": 2}}
        default = {"end": 3.0, "collision": None, "off": None, "least": 1.0, "reached": "no", "without": "", "starts_off": False,
                   "judges": "both", "dt": 0.1}  # fmt: skip
        for names, code, words in ((["A_1", "A_2"], 0, "1 of 2 drives touch nothing and stay on the road; 1 touch"),
                                   (["A_1", "A_3"], 1, "1 of 2 drives touch nothing and stay on the road; 0 touch")):
            with (tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as out,
                  unittest.mock.patch.object(sys, "argv", ["commonroad_check.py", folder, folder]),
                  unittest.mock.patch.object(commonroad_check, "judged", lambda xml, _: default | verdicts[xml.stem])):
                for name in names:
                    (pathlib.Path(folder) / f"{name}.xml").touch()
                    (pathlib.Path(folder) / name).mkdir()
                    (pathlib.Path(folder) / name / "solution.xml").touch()
                self.assertEqual(commonroad_check.main(), code)
            self.assertIn(words, out.getvalue())


class Driven(unittest.TestCase):
    def test_each_step_is_taken_once(self):
        """By stand-ins for the package, the program and the judge."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            log = folder / "log"
            xml = folder / "A_1.xml"
            xml.touch()

            def stand_in(kind, text):
                file = folder / kind
                file.write_text(f"#!/bin/sh\necho {kind} $2 >> {log}\n{text}\n")
                os.chmod(file, 0o755)
                return str(file)

            work = folder / "work"
            work.mkdir()
            args = type("Args", (), {
                "work": work,
                "python": stand_in("python", 'case $2 in *importing) printf -- "# - car8: left out\\nname: A_1\\n" > "$6";;'
                                   ' *) echo "<x/>" > "$4/solution.xml";; esac'),
                "program": stand_in("program", 'mkdir -p "$4"; echo \'{"outcome": "goal"}\' > "$4/summary.json"'),
                "judge": stand_in("judge", f"cat <<'END'\n{checked('A_1')}\nEND"),
            })  # fmt: skip
            first = tool.driven(args, xml)
            self.assertEqual(first["notes"], ["car8: left out"])
            self.assertEqual(first["summary"], {"outcome": "goal"})
            self.assertEqual(first["verdict"]["goal reached"], "3.10 s")
            self.assertEqual(tool.driven(args, xml), first)
            self.assertEqual(len(log.read_text().splitlines()), 4)

    def test_another_wheel_makes_the_packages_environment_anew(self):
        """By a stand-in for pip."""
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            commands = []

            def run(command, check):
                commands.append(command)
                (root / "build/commonroad/package/bin").mkdir(parents=True, exist_ok=True)
                (root / "build/commonroad/package/bin/python").touch()

            (root / "dist").mkdir()
            wheel = root / "dist/slalom-1.0-cp312-abi3-linux_x86_64.whl"
            with unittest.mock.patch.object(tool, "ROOT", root), unittest.mock.patch("subprocess.run", run):
                for text in ("one", "one", "two"):
                    wheel.write_text(text)
                    self.assertEqual(tool.with_package(), str(root / "build/commonroad/package/bin/python"))
            installs = [command for command in commands if "pip" in command]
            self.assertEqual([command[-1] for command in installs], [f"{wheel}[commonroad]"] * 2)

    def test_a_file_that_is_refused_is_not_driven(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            python = folder / "python"
            python.write_text("#!/bin/sh\necho 'a.xml:3: no goal' >&2; exit 2\n")
            os.chmod(python, 0o755)
            args = type("Args", (), {"work": folder, "python": str(python), "program": "false", "judge": "false"})
            self.assertEqual(tool.driven(args, folder / "A_1.xml"), {"name": "A_1", "refused": "a.xml:3: no goal"})


if __name__ == "__main__":
    unittest.main()
