#!/usr/bin/env python3
"""The layer check fails on wrong trees, each wrong in one way, and passes a right one."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import check_layers

CHECKER = pathlib.Path(__file__).resolve().parent / "check_layers.py"

RIGHT = {
    "include/slalom/base/error.hpp": "#pragma once\n#include <string>\n",
    "include/slalom/sim/sensing.hpp": '#include "slalom/planner/plan.hpp"\n',
    "src/sim/sensing.cpp": '#include "slalom/sim/sensing.hpp"\n#include "detail.hpp"\n',
    "src/sim/detail.hpp": '#include "slalom/base/error.hpp"\n',
    "src/io/yaml.cpp": "#include <yaml-cpp/yaml.h>\n",
    "apps/slalom/main.cpp": '#include <CLI/CLI.hpp>\n#include "slalom/io/files.hpp"\n',
}


class CheckLayers(unittest.TestCase):
    def run_on(self, files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in files.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            return subprocess.run([sys.executable, CHECKER, folder], text=True,
                                  stdout=subprocess.PIPE, check=False)

    def assert_wrong(self, name, text, message):
        result = self.run_on(RIGHT | {name: text})
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn(message, result.stdout)
        self.assertEqual(result.stdout.count("error:"), 1, result.stdout)

    def test_right_tree_passes(self):
        result = self.run_on(RIGHT)
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("6 files, 0 errors", result.stdout)

    def test_include_against_the_flow(self):
        self.assert_wrong("src/base/error.cpp", '\n#include "slalom/sim/sensing.hpp"\n',
                          "src/base/error.cpp:2: base includes slalom/sim/sensing.hpp")

    def test_include_against_the_flow_in_a_header(self):
        self.assert_wrong("include/slalom/expr/expr.hpp", "#include <slalom/nlp/solver.hpp>\n",
                          "expr includes slalom/nlp/solver.hpp")

    def test_a_header_that_gathers_a_module_belongs_to_it(self):
        gathering = {"include/slalom/sim.hpp": '#include "slalom/sim/sensing.hpp"\n'}
        self.assertEqual(self.run_on(RIGHT | gathering).returncode, 0)
        self.assert_wrong("include/slalom/base.hpp", '#include "slalom/sim/sensing.hpp"\n',
                          "base includes slalom/sim/sensing.hpp")
        self.assert_wrong("src/base/error.cpp", '#include "slalom/sim.hpp"\n',
                          "src/base/error.cpp:1: base includes slalom/sim.hpp")
        self.assert_wrong("include/slalom/all.hpp", "\n", "in no known module")

    def test_modules_do_not_include_the_program(self):
        self.assert_wrong("src/io/x.cpp", '#include "../../apps/slalom/main.cpp"\n',
                          "io includes a private header of apps")

    def test_private_header_of_another_module(self):
        self.assert_wrong("src/report/page.cpp", '#include "../sim/detail.hpp"\n',
                          "report includes a private header of sim")

    def test_private_headers_of_io_serve_sources_below_it_alone(self):
        part = {"src/io/section.hpp": "\n"}
        below = {"src/sweep/x.cpp": '#include "../io/section.hpp"\n'}
        self.assertEqual(self.run_on(RIGHT | part | below).returncode, 0)
        result = self.run_on(RIGHT | part | {"src/sim/x.cpp": '#include "../io/section.hpp"\n'})
        self.assertIn("sim includes ../io/section.hpp, but io stands below it", result.stdout)

    def test_the_program_alone_uses_paper(self):
        drives = {"src/paper/drives.hpp": "\n"}
        program = {"apps/slalom/x.cpp": '#include "../../src/paper/drives.hpp"\n'}
        self.assertEqual(self.run_on(RIGHT | drives | program).returncode, 0)
        self.assert_wrong("include/slalom/paper/drives.hpp", "\n", "paper has no public headers")

    def test_the_design_page_lists_the_same_folders(self):
        page = "".join(f"| `{layer}` | what |\n" for layer in check_layers.LAYERS)
        self.assertEqual(self.run_on(RIGHT | {"docs/design.md": page}).returncode, 0)
        self.assert_wrong("docs/design.md", page.replace("| `io` |", "| `files` |"),
                          "docs/design.md: its folders are base")

    def test_private_headers_of_base_serve_the_sources_of_all(self):
        result = self.run_on(RIGHT | {"src/base/simd.hpp": "\n",
                                      "src/sim/x.cpp": '#include "../base/simd.hpp"\n'})
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assert_wrong("include/slalom/sim/x.hpp", '#include "../../../src/base/simd.hpp"\n',
                          "sim includes a private header of base")

    def test_kept_library_in_a_public_header(self):
        for header in ("CLI/CLI.hpp", "yaml-cpp/yaml.h"):
            self.assert_wrong("include/slalom/io/files.hpp", f"#include <{header}>\n",
                              "public header includes")

    def test_unknown_module(self):
        self.assert_wrong("src/misc/x.cpp", "\n", "in no known module")
        self.assert_wrong("src/sim/x.cpp", '#include "slalom/misc/x.hpp"\n', "of no known module")

    def test_long_files(self):
        self.assert_wrong("src/sim/x.cpp", "\n" * 401, "401 lines, more than 400")
        self.assert_wrong("tests/sim/x_test.cpp", "\n" * 401, "401 lines, more than 400")
        self.assert_wrong("python/tests/test_x.py", "\n" * 401, "401 lines, more than 400")
        for file in ("tests/browser/x.mjs", "viewer/x.css", "viewer/x.html", "cmake/X.cmake", "src/CMakeLists.txt",
                     "CMakeLists.txt"):
            self.assert_wrong(file, "\n" * 401, f"{file}: 401 lines, more than 400")

    def test_empty_tree_is_no_success(self):
        self.assertEqual(self.run_on({"README.md": ""}).returncode, 1)


if __name__ == "__main__":
    unittest.main()
