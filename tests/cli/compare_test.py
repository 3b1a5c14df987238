"""Two drives on one page."""

import json
import unittest

from program import ProgramTest, run

FAST = ("--set", "loop.timeout=1", "--quiet")


class Compare(ProgramTest):
    def drive(self, name, *arguments):
        folder = self.folder / name
        result = run("simulate", *arguments, *FAST, "--out", folder)
        self.assertEqual(result.code, 0, result.err)
        return folder

    def test_two_drives(self):
        a, b = self.drive("a", "E_B", "--planner", "P_A"), self.drive("b", "E_C", "--planner", "P_D")
        page = self.folder / "page.html"
        result = run("compare", a, b, "--out", page)
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(result.out, f"written to {page}\n")
        text = page.read_text()
        self.assertIn("<title>E_B with P_A · E_C with P_D · compared</title>", text)
        data = text.split('id="drive-data">')[1].split("</script")[0]
        self.assertEqual([d["scenario"] for d in json.loads(data)], ["E_B", "E_C"])
        # A page that stands is not lost.
        self.assert_refused(run("compare", b, a, "--out", page), 3, "page.html", "--force")
        self.assertEqual(page.read_text(), text)
        self.assertEqual(run("compare", b, a, "--out", page, "--force").code, 0)
        self.assertIn("<title>E_C with P_D · E_B with P_A", page.read_text())

    def test_the_page_is_left_where_the_program_runs(self):
        a = self.drive("a", "E_B")
        self.assertEqual(run("compare", a, a, cwd=self.folder).code, 0)
        self.assertTrue((self.folder / "compare.html").exists())

    def test_bad_input(self):
        good = self.drive("good", "E_B")
        page = (good / "report.html").read_text()

        def folder(name, text):
            (self.folder / name).mkdir()
            self.write(f"{name}/report.html", text)
            return self.folder / name

        (self.folder / "empty").mkdir()
        cases = {
            "missing": (self.folder / "none", "none: found no such folder"),
            "a file": (good / "report.html", "report.html: found a file, expected a folder"),
            "no results": (self.folder / "empty", "empty/report.html: found no such file"),
            "no drive": (folder("text", "text"), "text/report.html: found no drive"),
            "binary": (folder("bytes", bytes(range(256))), "bytes/report.html: found no drive"),
            "another format": (folder("old", page.replace("slalom drive 3", "slalom drive 1")),
                               'old/report.html: format: found "slalom drive 1", expected "slalom drive 3"'),
            "cut off": (folder("cut", page[:page.index('"plant"')]), "cut/report.html: found a drive that is damaged"),
            "not a name": (folder("name", page.replace('"scenario":"E_B"', '"scenario":[1]')),
                           "name/report.html: found a drive that is damaged"),
        }
        for name, (bad, message) in cases.items():
            with self.subTest(name):
                out = self.folder / "out.html"
                self.assert_refused(run("compare", good, bad, "--out", out), 2, message)
                self.assert_refused(run("compare", bad, good, "--out", out), 2, message)
                self.assertFalse(out.exists())
        self.assert_refused(run("compare", good), 2, "B")

    def test_a_page_that_cannot_be_written(self):
        good = self.drive("good", "E_B")
        self.assert_refused(run("compare", good, good, "--out", good / "report.html" / "page.html"), 3,
                            "page.html")


if __name__ == "__main__":
    unittest.main()
