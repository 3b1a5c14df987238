#!/usr/bin/env python3
"""The quick tests are those of the changed modules and of the modules that name them."""

import pathlib
import unittest

import quick

DEPENDS = {"base": set(), "ocp": {"base"}, "planner": {"ocp"}, "sim": {"planner"}}


class Quick(unittest.TestCase):
    def modules(self, *names):
        return quick.modules_to_test([pathlib.Path(name) for name in names], DEPENDS)

    def test_a_source_and_a_public_header_are_tested_with_what_names_their_module(self):
        self.assertEqual(self.modules("src/ocp/mesh.cpp"), {"ocp", "planner"})
        self.assertEqual(self.modules("include/slalom/planner/plan.hpp"), {"planner", "sim"})

    def test_a_test_asks_for_itself_alone(self):
        self.assertEqual(self.modules("tests/ocp/mesh_test.cpp"), {"ocp"})

    def test_the_build_asks_for_all_and_a_page_for_none(self):
        self.assertEqual(self.modules("cmake/SlalomModule.cmake"), set(DEPENDS))
        self.assertEqual(self.modules("tests/CMakeLists.txt"), set(DEPENDS))
        self.assertEqual(self.modules("docs/ocp.md", "tests/cli/drive_test.py"), set())

    def test_what_only_the_whole_test_covers_is_named(self):
        files = [pathlib.Path(name) for name in (
            "src/ocp/mesh.cpp", "apps/slalom/main.cpp", "viewer/map.js", "config/planners/P_A.yaml",
            "tests/cli/drive_test.py", "docs/ocp.md")]
        self.assertEqual([str(path) for path in quick.not_covered(files, DEPENDS)],
                         ["config/planners/P_A.yaml", "tests/cli/drive_test.py"])

    def test_dependencies_are_those_of_the_build(self):
        depends = quick.dependencies()
        self.assertIn("nlp", depends["ocp"])
        self.assertEqual(depends["base"], set())
        self.assertLessEqual(set().union(*depends.values()), set(depends))


if __name__ == "__main__":
    unittest.main()
