#!/usr/bin/env python3
"""test_named_files.py: does make docs notice a document that names what does not exist?

    tools/docs/test_named_files.py -q
"""
import unittest

import named_files

THERE = {"README.md", "tests/README.md", "tests/core/test_judge.c", "src/impl/base/base.h", "tests",
         "tests/core"}


def problems(text, path="tests/README.md"):
    return named_files.problems(path, text, THERE, {"test", "docs"},
                                {"sl_solve", "sli_order", "SLI_ORDER_MAX"})


class NamedFiles(unittest.TestCase):
    def test_what_exists(self):
        self.assertEqual(problems(
            "`tests/core/test_judge.c`, `core/test_judge.c`, `test_judge.c`, `test_j*.c`"
            " `test_NAME.c` `tests/core/` [a](core/test_judge.c) [b](../README.md)"
            " [c](https://x.y/z.c) `make test` `n.h.v` `sl_solve` `build/x.csv`"
            "\n```\n`gone.c`\n```\n"), [])

    def test_a_file_that_is_gone(self):
        for name in ["gone.c", "tests/core/gone.c", "core/judge.c", "gone_*.c", "impl/gone/"]:
            self.assertEqual(problems("`%s`" % name),
                             ["tests/README.md names %s, which does not exist" % name])

    def test_a_link_to_a_file_or_a_heading_that_is_gone(self):
        self.assertEqual(problems("[a](core/gone.c)"),
                         ["tests/README.md has a link to core/gone.c"])
        self.assertEqual(problems("## Fuzzers\n[a](#fuzzers)"), [])
        self.assertEqual(problems("[a](../README.md#gone)"), [
            "tests/README.md has a link to ../README.md#gone: there is no such heading"])

    def test_a_target_that_is_gone(self):
        self.assertEqual(problems("`make docs`, `make tests`"),
                         ["tests/README.md names make tests, which does not exist"])

    def test_a_name_of_c_that_is_gone(self):
        self.assertEqual(problems("`sl_solve(a, sli_order)`, `SLI_ORDER_`, `sl_NAME_free`, sl_gone,"
                                  " `sl_solve_needs_SL_WITH_CHANGE`\n```\nsl_gone\n```\n"), [])
        for name in ["sl_gone", "sli_ord", "SLI_GONE_", "sl_gone_needs_SL_WITH_CHANGE"]:
            self.assertEqual(problems("`%s = 1`" % name),
                             ["tests/README.md names %s, which is in no source" % name])

    def test_figures_that_nothing_checks(self):
        mark = "It has <!-- sizes.csv: core -->331 kB<!-- end -->."
        self.assertEqual(len(problems(mark)), 1)
        self.assertEqual(problems(mark, "README.md"), [])

    def test_the_changelog_names_what_is_gone(self):
        self.assertEqual(problems("`gone.c`", "CHANGELOG.md"), [])
        self.assertEqual(len(problems("[a](gone.c)", "CHANGELOG.md")), 1)


if __name__ == "__main__":
    unittest.main()
