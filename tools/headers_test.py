#!/usr/bin/env python3
"""Tests of headers.py and doc_blocks.py: what each must find, and what it must leave out."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import doc_blocks  # noqa: E402
import headers  # noqa: E402

HEADER = '''\
namespace outer {
/// What it is,
/// in two lines.
class Thing : public Base {
 public:
  /// Makes one.
  int make(int a,
           int b = 2) const;
  /// Another of the name.
  int make();

  double size = 1;  ///< in metres
  int bare;

 private:
  /// Nobody's business.
  int hidden;
};
enum class Kind {
  small,  ///< less than one
          ///< or one
  large
};
}  // namespace outer
'''


class Headers(unittest.TestCase):
    def setUp(self):
        self.entries = headers.Reader().read(HEADER)
        self.by_name = {e.names[0]: e for e in self.entries if e.names}

    def test_comments_hold_for_what_follows(self):
        self.assertEqual(self.by_name["Thing"].comment, ["What it is,", "in two lines."])
        self.assertEqual([e.comment for e in self.entries if e.names == ["make"]],
                         [["Makes one."], ["Another of the name."]])
        self.assertEqual(self.by_name["bare"].comment, [])

    def test_comments_behind(self):
        self.assertEqual(self.by_name["size"].comment, ["in metres"])
        self.assertEqual(self.by_name["small"].comment, ["less than one", "or one"])

    def test_declarations_of_several_lines_are_whole(self):
        first = next(e for e in self.entries if e.names == ["make"])
        self.assertEqual("".join(first.code).count("int"), 3)

    def test_scopes(self):
        self.assertEqual(self.by_name["size"].scope, ("outer", "Thing"))
        self.assertEqual(self.by_name["small"].scope, ("outer", "Kind"))

    def test_private_is_left_out(self):
        self.assertNotIn("hidden", self.by_name)


class DocBlocks(unittest.TestCase):
    def check(self, text, write=False):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            page.write_text(text, encoding="utf-8")
            with contextlib.redirect_stdout(io.StringIO()):
                messages, count = doc_blocks.check(page, write)
            return messages, count, page.read_text(encoding="utf-8")

    def test_what_is_printed_is_compared(self):
        good = "```python\na = 1\n```\n\n```python\nprint(a)\n```\n\n```text\n1\n```\n"
        self.assertEqual(self.check(good)[:2], ([], 2))
        self.assertEqual(len(self.check(good.replace("text\n1", "text\n2"))[0]), 1)
        self.assertEqual(len(self.check("```python\nprint(1)\n```\n")[0]), 1)

    def test_an_error_names_the_line(self):
        messages, _, _ = self.check("A page.\n\n```python\n\n1 / 0\n```\n")
        self.assertIn("line 5", messages[0])

    def test_writing(self):
        text = "```python\nprint(3)\n```\n\n```text\n1\n```\n\nrest\n"
        self.assertEqual(self.check(text, write=True)[2], text.replace("text\n1", "text\n3"))


if __name__ == "__main__":
    unittest.main()
