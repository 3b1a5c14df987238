#!/usr/bin/env python3
"""When environments.py makes a virtual environment anew; once with pip itself, by a wheel made here."""

import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import environments  # noqa: E402


def wheel(folder, value):
    """A wheel with the module `answer`."""
    file, info = folder / "answer-1.0-py3-none-any.whl", "answer-1.0.dist-info"
    with zipfile.ZipFile(file, "w") as packed:
        packed.writestr("answer.py", f"VALUE = {value}\n")
        packed.writestr(f"{info}/METADATA", "Metadata-Version: 2.1\nName: answer\nVersion: 1.0\n")
        packed.writestr(f"{info}/WHEEL", "Wheel-Version: 1.0\nGenerator: a test\nRoot-Is-Purelib: true\nTag: py3-none-any\n")
        packed.writestr(f"{info}/RECORD", "")
    return file


class Made(unittest.TestCase):
    """By a stand-in for pip, which fails where it is told to."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name) / "environment"
        self.commands, self.pip_fails = [], False
        patch = mock.patch.object(environments.subprocess, "run", self.run_command)
        self.addCleanup(patch.stop)
        patch.start()

    def run_command(self, command, check):
        self.commands.append(command)
        if "venv" in command:
            (self.folder / "bin").mkdir(parents=True, exist_ok=True)
            (self.folder / "bin/python").touch()
            (self.folder / environments.STAMP).unlink(missing_ok=True)  # as --clear does
        elif self.pip_fails:
            raise subprocess.CalledProcessError(1, command)

    def times_made(self, *calls):
        self.commands.clear()
        for call in calls:
            self.assertEqual(environments.environment(self.folder, *call), str(self.folder / "bin/python"))
        return sum("venv" in command for command in self.commands)

    def test_one_with_the_same_packages_is_made_once(self):
        self.assertEqual(self.times_made((["a==1", "b"],), (["a==1", "b"],)), 1)
        self.assertEqual(self.commands[1][-2:], ["a==1", "b"])

    def test_other_packages_make_it_anew(self):
        self.assertEqual(self.times_made((["a==1"],), (["a==2"],), (["a==2"], {"x": ["c"]}), (["a==2"], {"x": ["d"]})), 4)
        self.assertEqual(self.commands[-1][-4:], ["--no-deps", "--target", str(self.folder / "x"), "d"])

    def test_one_cut_short_is_made_anew(self):
        self.pip_fails = True
        with self.assertRaises(subprocess.CalledProcessError):
            self.times_made((["a"],))
        self.pip_fails = False
        self.assertEqual(self.times_made((["a"],), (["a"],)), 1)

    def test_a_wheel_of_the_same_name_built_anew_makes_it_anew(self):
        file = wheel(self.folder.parent, 1)
        self.assertEqual(self.times_made(([f"{file}[extra]"],)), 1)
        wheel(self.folder.parent, 2)
        self.assertEqual(self.times_made(([f"{file}[extra]"],), ([f"{file}[extra]"],)), 1)

    def test_another_python_makes_it_anew(self):
        self.times_made((["a"],))
        with mock.patch.object(environments.sys, "version", "4.0"):
            self.assertEqual(self.times_made((["a"],)), 1)


class Requirements(unittest.TestCase):
    def test_comments_are_left_out_and_names_are_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "requirements.txt"
            file.write_text("# The peers.\ncasadi==3.8.2\n\ncasadi-more==1\nnumpy\n")
            self.assertEqual(environments.requirements(file), ["casadi==3.8.2", "casadi-more==1", "numpy"])
            self.assertEqual(environments.requirements(file, "casadi", "numpy"), ["casadi==3.8.2", "numpy"])


class Processes(unittest.TestCase):
    def test_one_thread_keeps_what_else_is_set(self):
        with mock.patch.dict(os.environ, {"OMP_NUM_THREADS": "8", "KEPT": "as it is"}):
            found = environments.one_thread()
        self.assertEqual((found["OMP_NUM_THREADS"], found["OPENBLAS_NUM_THREADS"], found["KEPT"]), ("1", "1", "as it is"))


@unittest.skipUnless(importlib.util.find_spec("ensurepip"), "needs python3-venv")
class Real(unittest.TestCase):
    def test_a_package_is_there_to_import_and_one_beside_is_not(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            python = environments.environment(folder / "one", [wheel(folder, 41)], {"aside": [wheel(folder, 41)]})
            found = subprocess.run([python, "-c", "import answer; print(answer.VALUE + 1)"], capture_output=True, text=True)
            self.assertEqual(found.stdout, "42\n", found.stderr)
            self.assertTrue((folder / "one/aside/answer.py").is_file())


if __name__ == "__main__":
    unittest.main()
