#!/usr/bin/env python3
"""Pages of fewer measurements than their target's say so in their stamps; nothing is measured here."""

import pathlib
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import long_solves  # noqa: E402
import profile  # noqa: E402
import sweep_scale  # noqa: E402


def written_by(tool, name, arguments, **stand_ins):
    """The command in the stamp of the page that a tool writes."""
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "page.md"
        with (mock.patch.multiple(tool, **stand_ins),
              mock.patch.object(sys, "argv", [name, "--out", str(page), *arguments.split()])):
            tool.main()
        return page.read_text().split("*Written by `")[1].split("`")[0]


class Stamps(unittest.TestCase):
    def check(self, target, tool, name, options, **stand_ins):
        self.assertEqual(written_by(tool, name, "", **stand_ins), f"make {target}")
        self.assertEqual(written_by(tool, name, options, **stand_ins), f"benchmarks/{name} {options}")

    def test_long_solves(self):
        with tempfile.TemporaryDirectory() as work:
            for options in ("", "--limit 60.0 --intervals 20 40 --seeds 1"):
                found = written_by(long_solves, "long_solves.py", f"--work {work} --python python3 {options}",
                                   measure=lambda args: [])  # fmt: skip
                self.assertEqual(found, f"benchmarks/long_solves.py {options}" if options else "make long-solves")

    def test_profile(self):
        share = {name: 1 / len(profile.PARTS) for name, _ in profile.PARTS}
        self.check("solver-profile", profile, "profile.py", "--cycles 20", build_ours=mock.Mock(), record_cycles=mock.Mock(),
                   measure=lambda *_: (100.0, 4, share), INTERLEAVED=False, program=lambda name: name)  # fmt: skip

    def test_sweep_scale(self):
        self.check("sweep-scale", sweep_scale, "sweep_scale.py", "--trials 500 --jobs 64", measure=lambda *_: [])


if __name__ == "__main__":
    unittest.main()
