#!/usr/bin/env python3
"""clang-tidy finds the mistake in each file of a batch, and says where it is in the file itself."""

import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

import tidy

MISTAKE = "\n\nint* {name}() {{ return 0; }}\n"  # modernize-use-nullptr, in the fourth line of a file


class Tidy(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        (self.root / ".clang-tidy").write_text(
            (tidy.ROOT / ".clang-tidy").read_text(encoding="utf-8"), encoding="utf-8")
        for name in ("src/one", "src/two", "build/Unity"):
            (self.root / name).mkdir(parents=True)
        self.files = [self.root / "src/one/one.cpp", self.root / "src/two/two.cpp"]
        self.batch = self.root / "build/Unity/unity_one.cxx"
        self.batch.write_text("".join(f'#include "{file}"\n\n' for file in self.files),
                              encoding="utf-8")
        command = {"file": str(self.batch), "directory": str(self.root / "build"),
                   "command": f"c++ -std=c++20 -o one.o -c {self.batch}"}
        (self.root / "build/compile_commands.json").write_text(json.dumps([command]),
                                                               encoding="utf-8")

    def run_on(self, texts, *options):
        for file, text in zip(self.files, texts):
            file.write_text(f'#include "{file.stem}_near.hpp"\n' + text, encoding="utf-8")
            (file.parent / f"{file.stem}_near.hpp").write_text("#pragma once\n", encoding="utf-8")
        printed = io.StringIO()
        arguments = ["tidy.py", "--build", str(self.root / "build"), *options]
        with unittest.mock.patch.object(tidy, "ROOT", self.root), \
                unittest.mock.patch.object(sys, "argv", arguments), \
                contextlib.redirect_stdout(printed):
            code = tidy.main()
        return code, printed.getvalue()

    def test_a_mistake_in_either_file_is_found_where_it_is(self):
        for at in (0, 1):
            texts = ["int one();\n", "int two();\n"]
            texts[at] = MISTAKE.format(name="wrong")
            for options in ((), ("--alone",)):
                code, printed = self.run_on(texts, *options)
                self.assertEqual(code, 1, printed)
                self.assertIn(f"{self.files[at]}:4:", printed)

    def test_what_passed_is_not_looked_at_again_until_it_changes(self):
        right = ["int one();\n", "int two();\n"]
        self.assertIn("0 with findings, 0 unchanged", self.run_on(right)[1])
        self.assertIn("0 with findings, 2 unchanged", self.run_on(right)[1])
        code, printed = self.run_on([right[0], MISTAKE.format(name="wrong")])
        self.assertEqual(code, 1, printed)

    def test_changed_are_batches_with_a_file_or_a_header_that_changed(self):
        texts = ["int one();\n", MISTAKE.format(name="wrong")]
        for changed, code in (("src/one/one.cpp", 0), ("src/two/two.cpp", 1),
                              ("src/two/two_near.hpp", 1), ("docs/two.md", 0)):
            with unittest.mock.patch.object(tidy, "changed_files",
                                            lambda _, name=changed: [pathlib.Path(name)]), \
                    unittest.mock.patch.dict(tidy.os.environ):
                tidy.os.environ.pop("SLALOM_TIDY", None)
                ended, printed = self.run_on(texts, "--alone", "--changed")
            self.assertEqual(ended, code, changed + printed)


if __name__ == "__main__":
    unittest.main()
