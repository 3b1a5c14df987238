#!/usr/bin/env python3
"""The pages that paper_pages.py writes, from an evaluation made up for them: what stands on them is what the program
says, and nothing else."""

import json
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import paper_pages  # noqa: E402
import stand_in  # noqa: E402

SHOT = {"t_s": 2.1667, "x_m": 1.0, "y_m": 2.0, "tolerance_m": 2.5, "comparable": True,
        "ours": {"x_m": 1.5, "y_m": 2.0, "distance_m": 0.5, "within": True}}
PRINTED = {"outcome": "crash", "hit": "O2", "time_s": 19.5, "as_paper": False, "snapshots": [
    SHOT, SHOT | {"ours": None}, SHOT | {"comparable": False},
    SHOT | {"ours": {"x_m": 9.0, "y_m": 2.0, "distance_m": 8.0, "within": False}}]}
DRIVE = {"folder": "E_C/P_C", "scenario": "E_C", "planner": "P_C", "outcome": "goal", "hit": None, "time_s": 28.0,
         "goal_time_s": None, "least_clearance_m": -1e-9, "end": {"x_m": 17.0, "y_m": 688.0, "ux_mps": 25.0},
         "printed": PRINTED}
TERMS = {"steering_angle": 1e-4, "steering_rate": 1e-3, "jerk": 0.5, "total": 0.5011}
PAIR = {"P_B": TERMS, "P_C": TERMS | {"total": 0.4009}}


def claim(verdict):
    return {"claim": "x", "says": f"it {verdict}", "at": "Fig. rtf", "printed": "1 | 2", "ours": "3", "verdict": verdict}


def counts(of_C, of_D, p):
    return {"planners": [{"planner": "P_C", "passed": of_C, "trials": 400}, {"planner": "P_D", "passed": of_D, "trials": 400}],
            "ratio": of_D / of_C, "fisher_p": p}


def sweep(title, passed):
    horizons = [{"tex_s": 0.5, "planner": p, "passed": 1, "trials": 2, "pos": 0.5, "rtf_cpu": 0.25, "rtf_wall": None,
                 "printed": {"pos": 0.45, "rtf": None} if p == "P_D" else None} for p in ("P_C", "P_D")]
    ends = [{"planner": p, "tex": t, "tex_s": 0.5, "trials": 10, "passed": passed, "crash_O2": 1, "crash_other": 2,
             "no_plan": 3, "else": 4, "fastest_passed_mps": v}
            for p, v in (("P_C", None), ("P_D", 21.1)) for t in ("up to", "above")]
    return {"title": title, "trials": 2, "size": 4, "greatest_speed_mps": 40.0, "horizons": horizons, "ends": ends,
            "counts": counts(18, 111, 2.5e-20),
            "slower": [{"tex_s": 0.687, "speed_mps": 16.8, "passed": 1, "trials": 9, "rtf_cpu": 0.01,
                        "printed": {"pos": 0.889, "rtf": 0.933}}],
            "claims": [claim("holds"), claim("does not hold")]}


EVALUATION = {
    "repeats": 9, "drives": [DRIVE, DRIVE | {"folder": "E_C-no-cones/P_C", "printed": None}],
    "effort": [{"environment": "E_A-figure", "weights": [0.1, 1, 0.01], "weighted": PAIR, "printed": PAIR, **PAIR}],
    "cases": [], "index": [{"of": "Fig. mo", "command": "a", "where": "b", "ours": "c", "printed": "d"}],
    "figures": [{"file": file, "caption": f"what is in {file}"}
                for file in ("E_B.svg", "E_B_traces.svg", "E_C.svg", "E_C_crash.svg", "E_C_crash_P_D.svg")],
    "claims": [claim("holds"), claim("holds in part")],
    "printed_counts": counts(22, 148, 1.3e-29),
    "sweeps": [sweep("the first", 1), sweep("the second", 2),
               *(sweep("a variant", k) for k in range(3, 3 + len(paper_pages.VARIANTS)))],
}


class Pages(unittest.TestCase):
    def test_results(self):
        page = paper_pages.results(EVALUATION, "MARK")
        self.assertIn("| E_C/P_C | goal | 28.000 | – | (17.00, 688.00) | 25.00 | 0.000 | crash O2, 19.5 | differs |", page)
        self.assertIn("in its text alone | – |", page)
        for judged in ("within 2.5 m", "ours has ended", "no: the paper's series lags", "beyond 2.5 m"):
            self.assertEqual(page.count(judged), 1, judged)
        self.assertIn("| total | 0.501 | 0.401 | -20.0 % | 0.501 | 0.401 | -20.0 % |", page)
        self.assertIn("| jerk | 0.5 | 0.5 | 0.0 % |", page)

    def test_figures_are_those_that_are_there_with_the_programs_captions(self):
        page = paper_pages.results(EVALUATION, "MARK")
        for name in ("E_B", "E_C_crash", "E_C_crash_P_D"):
            self.assertIn(f"![what is in {name}.svg](figures/{name}.svg)", page)
        self.assertNotIn("traces", page)
        self.assertNotIn("_crash", paper_pages.results(EVALUATION | {"figures": [], "drives": []}, "MARK"))

    def test_verdicts_are_counted_and_shown_as_they_are(self):
        page = paper_pages.verdicts(EVALUATION, "MARK")
        self.assertIn("of 4 claims", page)
        self.assertIn("2 hold, 1 hold in part, 1 do not hold", page)
        self.assertIn("| it holds in part | Fig. rtf: 1 \\| 2 | 3 | **holds in part** |", page)
        self.assertEqual(page.count("**does not hold**"), 2)
        self.assertIn("## From the second", page)
        self.assertNotIn("a variant", page)

    def test_the_sweep(self):
        page = paper_pages.paper_sweep(EVALUATION, "MARK")
        self.assertIn("| the first | 18 of 400 | 111 of 400 | × 6.17 | 2.5e-20 |", page)
        self.assertIn("| the paper's, from its counts | 22 of 400 | 148 of 400 | × 6.73 | 1.3e-29 |", page)
        self.assertIn("| 0.500 | 0.50 | 0.25 | – | 0.50 | 0.25 | – | POS 0.45 |", page)
        self.assertIn("| 16.8 m/s | 0.687 | 1 of 9 | 0.01 | 0.889, 0.933 |", page)
        self.assertIn("| barrier floor .8 | 6 of 20 | 6 of 20 | 3 of 10 | 3 of 10 | 21.1 |", page)

    def test_every_page_has_its_mark(self):
        for name, page in paper_pages.PAGES.items():
            self.assertIn("\n\nMARK\n", page(EVALUATION, "MARK"), name)
        self.assertIn("| Fig. mo | a | b | c | d |", paper_pages.index(EVALUATION, "MARK"))


class Written(unittest.TestCase):
    """By a stand-in for the program."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def run_tool(self, *pages, **more):
        evaluation = json.dumps(EVALUATION | more)
        log = self.folder / "log"
        stand_in.run(paper_pages.main, *pages, "--out", self.folder / "out", "--work", self.folder / "work",
                     STAND_IN_EVALUATION=evaluation, STAND_IN_LOG=str(log))  # fmt: skip
        return log.read_text()

    def test_results_need_no_sweep_and_have_their_figures(self):
        self.assertNotIn("sweep", self.run_tool("results"))
        figures = self.folder / "out/figures"
        self.assertEqual((figures / "E_C_crash.svg").read_text(), "what is in E_C_crash.svg")
        self.assertEqual(sorted(file.name for file in (self.folder / "out").iterdir()), ["figures", "results.md"])

    def test_a_drive_that_does_not_crash_has_no_figure_of_it(self):
        self.run_tool("results", figures=[{"file": "E_C.svg", "caption": "all arrive"}])
        self.assertIn("all arrive", (self.folder / "out/results.md").read_text())

    def test_the_index_goes_on_with_sweeps_of_its_own(self):
        log = self.run_tool("paper-index", "verdicts", "--repeats", "3")
        for folder in ("study", "printed"):
            self.assertIn(f"--out {self.folder}/work/{folder}", log)
            self.assertIn(f"--sweep {self.folder}/work/{folder}", log)
        self.assertIn("make verdicts", (self.folder / "out/paper-index.md").read_text())
        self.assertIn("tools/paper_pages.py verdicts --repeats 3", (self.folder / "out/verdicts.md").read_text())

    def test_sweeps_of_another_commit_are_not_gone_on_with(self):
        with unittest.mock.patch.object(paper_pages, "swept") as swept:
            folders = []
            for commit in ("aaaaaaa", "bbbbbbb"):
                with (unittest.mock.patch("measured.commit_at_start", lambda commit=commit: commit),
                      unittest.mock.patch.object(paper_pages, "write")):
                    stand_in.run(paper_pages.main, "paper-index", STAND_IN_EVALUATION=json.dumps(EVALUATION))
                folders.append({call.args[2] for call in swept.call_args_list})
                swept.reset_mock()
        self.assertEqual(folders[0] & folders[1], set())
        self.assertEqual(len(folders[0]), 2)


if __name__ == "__main__":
    unittest.main()
