#!/usr/bin/env python3
"""wheel_needs.py tells libraries that nobody foresaw and functions that an old C library lacks."""

import unittest

import wheel_needs


class Needs(unittest.TestCase):
    def test_libraries_that_the_portable_wheel_has_not_inside(self):
        self.assertEqual(wheel_needs.unforeseen({"libfmt.so.9": "", "libsleef.so.3": "", "libsqlite3.so.0": "",
                                                 "libyaml-cpp.so.0.7": ""}), [])  # fmt: skip
        self.assertEqual(wheel_needs.unforeseen({"libfmt.so.10": "", "libcurl.so.4": ""}), ["libcurl.so.4"])

    def test_functions_that_the_oldest_c_library_lacks(self):
        exported = {"hypot": {"GLIBC_2.2.5", "GLIBC_2.35"}, "closefrom": {"GLIBC_2.34"}, "memcpy": {"GLIBC_2.14"}}
        wanted = [("hypot", "GLIBC_2.35"), ("memcpy", "GLIBC_2.14"), ("fstat", "GLIBC_2.33"), ("stat", "GLIBC_2.33"),
                  ("__isoc23_strtoul", "GLIBC_2.38"), ("pthread_cond_clockwait", "GLIBC_2.34"), ("_Znwm", "GLIBCXX_3.4.30")]  # fmt: skip
        self.assertEqual(wheel_needs.too_new(wanted, exported), [])
        self.assertEqual(wheel_needs.too_new([*wanted, ("closefrom", "GLIBC_2.34"), ("unknown", "GLIBC_2.41")], exported),
                         ["closefrom@GLIBC_2.34", "unknown@GLIBC_2.41"])  # fmt: skip

    def test_versions(self):
        self.assertEqual(wheel_needs.version_of("GLIBC_2.2.5"), (2, 2, 5))
        for other in ("GLIBC_PRIVATE", "GCC_3.0", None):
            self.assertIsNone(wheel_needs.version_of(other))


if __name__ == "__main__":
    unittest.main()
