"""`slalom import` and `slalom export` hand their words to the Python package, which need not be there."""

import os
import unittest

from program import ProgramTest, run


class PythonCommands(ProgramTest):
    def python(self, script):
        """A stand-in for Python that runs this."""
        file = self.write("python", "#!/bin/sh\n" + script)
        file.chmod(0o755)
        return {**os.environ, "SLALOM_PYTHON": str(file)}

    def test_words_and_exit_codes_are_handed_on(self):
        environment = self.python('shift 2; for word in "$@"; do echo "[$word]"; done; exit 3')
        result = run("import", "track", "a ring.csv", "--speed", "9", "--force", "--out", "b.yaml", env=environment)
        self.assertEqual(result.code, 3)
        words = result.out.split("\n")[:-1]
        self.assertEqual(sorted(words), sorted(["[track]", "[a ring.csv]", "[--speed]", "[9]", "[--force]", "[--out]", "[b.yaml]"]))
        for option, value in (("--speed", "9"), ("--out", "b.yaml")):
            self.assertEqual(words[words.index(f"[{option}]") + 1], f"[{value}]")
        result = run("export", "mcap", "folder", env=self.python('echo "$2"; echo "$3 $4"'))
        self.assertIn("slalom.exporting", result.out)
        self.assertTrue(result.out.endswith("mcap folder\n"), result.out)

    def test_without_python_or_package(self):
        environment = {**os.environ, "SLALOM_PYTHON": str(self.folder / "none")}
        self.assert_refused(run("import", "track", "a.csv", env=environment), 2, "no Python", "none", "SLALOM_PYTHON")
        missing = run("export", "mcap", "folder", env=self.python('exec python3 -I -S "$@"'))
        self.assert_refused(missing, 2, "'slalom export' is done by the Python package", "SLALOM_PYTHON")

    def test_usage(self):
        self.assert_refused(run("import", "track"), 2, "FILE is required")
        self.assert_refused(run("export", "mcap", "folder", "--speed", "3"), 2, "--speed")
        for command in ("import", "export"):
            text = run(command, "--help").out
            for word in ("Example:", "Exit codes", "SLALOM_PYTHON"):
                self.assertIn(word, text)


if __name__ == "__main__":
    unittest.main()
