#!/usr/bin/env python3
"""Files go into one batch, unless one mentions a name the other keeps to itself."""

import pathlib
import tempfile
import unittest

import batches

KEEPS = "namespace a {\nnamespace {\n%s\n}  // namespace\n}  // namespace a\n"


class Batches(unittest.TestCase):
    def batches(self, texts, headers=None):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (headers or {}).items():
                pathlib.Path(folder, name).write_text(text, encoding="utf-8")
            paths = []
            for name, text in texts.items():
                paths.append(pathlib.Path(folder, name))
                paths[-1].write_text(text, encoding="utf-8")
            return [[path.name for path in batch] for batch in batches.batches(paths)]

    def together(self, one, other):
        return len(self.batches({"one.cpp": one, "other.cpp": other})) == 1

    def test_strangers_share_a_batch(self):
        self.assertTrue(self.together(KEEPS % "int f(int a) { return a; }",
                                      KEEPS % "int g(int a) { return a; }"))

    def test_a_name_kept_by_one_and_mentioned_by_the_other(self):
        for kept in ("int found(int a) {\n  return a;\n}", "constexpr int found = 1;",
                     "constexpr int other = 1, found = 2;", "struct found {\n  int a;\n};",
                     "enum class found { a };", "using found = int;", "const int found[] = {1};",
                     "template <class T>\nT found(T a) {\n  return a;\n}"):
            self.assertFalse(self.together(KEEPS % kept, "int use() { return found(1); }\n"), kept)
            self.assertFalse(self.together("int use() { return found(1); }\n", KEEPS % kept), kept)
        self.assertFalse(self.together("#define found 1\n", "int found();\n"))
        self.assertFalse(self.together("static int found() { return 1; }\n", "int found();\n"))

    def test_a_name_kept_by_one_and_declared_by_a_header_of_the_other(self):
        header = {"near.hpp": '#include "far.hpp"\n', "far.hpp": "inline constexpr int found = 1;\n"}
        including = '#include "near.hpp"\n'
        keeps = KEEPS % "int found(int a);"
        self.assertEqual(len(self.batches({"a.cpp": including, "b.cpp": keeps}, header)), 2)
        self.assertEqual(len(self.batches({"a.cpp": including, "b.cpp": including + keeps}, header)), 1)

    def test_comments_and_strings_mention_nothing(self):
        self.assertTrue(self.together(KEEPS % "int found = 1;",
                                      '// found\nconst char* s = "found" R"(\nfound )";\n'))
        self.assertTrue(self.together(KEEPS % "const int a = int{1}, found = b{2};", "int b();\n"))

    def test_what_follows_an_unnamed_namespace_is_everybodys(self):
        self.assertTrue(self.together(KEEPS % "int f();" + "int found() { return 1; }\n",
                                      "int found();\n"))

    def test_the_same_alias_twice_is_no_clash(self):
        self.assertTrue(self.together("using b::found;\n", "using b::found;\n"))
        self.assertFalse(self.together("using b::found;\n", "using c::found;\n"))

    def test_files_of_a_batch_use_the_same_namespaces(self):
        self.assertFalse(self.together("using namespace b;\n", "int f();\n"))
        self.assertTrue(self.together("using namespace b;\n", "using namespace b;\n"))

    def test_kernels_are_alone(self):
        self.assertEqual(self.batches({"a_avx2.cpp": "", "a_avx512.cpp": "", "b_baseline.cpp": "", "c.cpp": ""}),
                         [["a_avx2.cpp"], ["a_avx512.cpp"], ["b_baseline.cpp"], ["c.cpp"]])

    def test_a_batch_is_full(self):
        made = self.batches({f"{i:02}.cpp": "" for i in range(batches.MOST_FILES + 1)})
        self.assertEqual([len(batch) for batch in made], [batches.MOST_FILES, 1])


if __name__ == "__main__":
    unittest.main()
