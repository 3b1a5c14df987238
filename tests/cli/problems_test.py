#!/usr/bin/env python3
"""slalom problems: the library of optimal-control problems on the command line."""

import json
import unittest

import program


class Problems(unittest.TestCase):
    def test_lists_all(self):
        listed = program.run("problems")
        self.assertEqual(listed.code, 0, listed.err)
        self.assertIn("goddard", listed.out)
        entries = json.loads(program.run("problems", "--json").out)
        self.assertGreaterEqual(len(entries), 40)
        self.assertEqual(len(listed.out.splitlines()), 1 + len(entries))

    def test_solves_one_to_its_known_value(self):
        for scheme in "hermite_simpson", "lgr":
            done = program.run("problems", "bryson-denham", "--scheme", scheme)
            self.assertEqual(done.code, 0, done.err)
            self.assertIn("on paper   4 ", done.out)
            self.assertRegex(done.out, r"converged by \S+: value \S+, error \S+, difference \S+: agrees")

    def test_json_has_the_entry_the_answer_and_each_mesh(self):
        done = program.run("problems", "moon-lander", "--json")
        self.assertEqual(done.code, 0, done.err)
        entry = json.loads(done.out)
        self.assertIn("bang_bang", entry["tags"])
        run = entry["run"]
        self.assertEqual(run["status"], "converged")
        self.assertLess(abs(run["value"] - entry["closed_form"]), 1e-4)
        self.assertGreater(len(run["meshes"]), 1)
        self.assertLess(run["meshes"][-1]["error"], 1e-6)

    def test_takes_scheme_points_intervals_and_back_end(self):
        done = program.run("problems", "hager", "--scheme", "lgl", "--points", 6, "--intervals", 2,
                           "--fixed-mesh", "--json")
        mesh = json.loads(done.out)["run"]["meshes"]
        self.assertEqual([(m["intervals"], m["points"]) for m in mesh], [(2, 11)])

    def test_a_coarse_answer_ends_with_1(self):
        done = program.run("problems", "brachistochrone", "--scheme", "trapezoidal", "--intervals", 5,
                           "--fixed-mesh")
        self.assertEqual(done.code, 1)
        self.assertIn("differs", done.out)

    def test_all_are_solved_by_two_schemes(self):
        names = [entry["name"] for entry in json.loads(program.run("problems", "--json").out)]
        done = program.run("problems", "--all", "--fixed-mesh", "--json")
        runs = json.loads(done.out)
        self.assertEqual([(run["name"], run["scheme"]) for run in runs],
                         [(name, scheme) for name in names for scheme in ("hermite_simpson", "lgr")])
        self.assertFalse(all(run["run"]["agrees"] for run in runs), "first meshes are coarse")
        self.assertEqual((done.code, done.err), (1, ""))

    def test_bad_input_is_one_line(self):
        for arguments, message in [
            (["godard"], "found 'godard', expected perhaps 'goddard'"),
            (["goddard", "--scheme", "lgrr"], "'lgrr'"),
            (["goddard", "--backend", "snobt"], "snobt"),
            (["goddard", "--intervals", "0"], "intervals"),
            (["goddard", "--tolerance", "2"], "tolerance"),
            (["goddard", "--all"], "all"),
        ]:
            done = program.run("problems", *arguments)
            self.assertEqual(done.code, 2, arguments)
            self.assertIn(message, done.err)
            self.assertEqual(len(done.err.splitlines()), 1, done.err)

    def test_the_page_is_as_generated(self):
        page = (program.SOURCE / "docs/problems.md").read_text()
        self.assertEqual(page, program.run("docs", "problems").out,
                         "run: slalom docs problems > docs/problems.md")


if __name__ == "__main__":
    unittest.main()
