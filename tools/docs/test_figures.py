#!/usr/bin/env python3
"""test_figures.py: does make docs notice a figure that is not that of its file?

Each number of the pages, and each column of the files that a figure shows, is changed in turn.
"""
import contextlib
import copy
import io
import re
import unittest

import figure_results
import figure_texts
import figures

# Columns that no figure shows: names, sizes and sums are looked at otherwise.
NOT_SHOWN = {"system", "n", "step", "peer", "group", "call", "class", "size", "pairs", "what",
             "header_bytes", "ours_changes", "qdldl_changes"}

PEERS = """system,n,threads,case,method,nrhs,count,median_s,limit_share
a,7,1,vertex,"ours, solve on a plan",1,9,2e-6,0.5
a,7,1,vertex,"ours, plan + solve",1,9,3e-6,0.4
a,7,1,vertex,"ours, AVX2 forced",1,9,1e-6,0.4
a,7,1,vertex,"CHOLMOD full solve, once",1,1,9e-6,0
a,7,1,vertex,CHOLMOD solve2 Bset,1,9,8e-6,0
a,7,2,vertex,CHOLMOD full solve,1,9,7e-6,0
a,7,1,refactor,ours,0,9,1e-3,0.1
a,7,2,refactor,ours,0,9,5e-4,0.1
b,7,1,order to factor,ours,0,1,3,0.1
b,7,1,order to factor,CHOLMOD METIS,0,1,%s,0
b,7,1,refactor,CHOLMOD defaults,0,1,2,0
"""


def changed(number, k):
    """Another number, in each row by another factor."""
    if number.isdigit():
        return str(2 * int(number) + k + 1)
    return str((1.37 + 0.5 * k) * float(number) + 0.01)


class Pages(unittest.TestCase):
    def setUp(self):
        self.files = figures.read_all()
        self.pages = {path: figures.read(path) for path in figures.MARKED}

    def problems(self):
        return figures.problems(self.pages, self.files)

    def test_pages_and_files_agree(self):
        self.assertEqual(self.problems(), [])

    def test_a_changed_number_of_a_page_is_noticed(self):
        count, texts = 0, figures.texts_of(self.files)
        for path in figures.MARKED:
            text = figures.read(path)
            for mark in figures.MARKS.finditer(text):
                for number in re.finditer(r"\d[\d.,]*", mark.group(4)):
                    at = mark.start(4) + number.start()
                    other = str((int(text[at]) + 1) % 10)
                    wrong = text[:at] + other + text[at + 1:]
                    found = figures.page_problems(path, wrong, texts)
                    self.assertEqual(len(found), 1, (path, mark.group(1), number.group(0)))
                    self.assertIn("%s.csv: %s" % mark.group(2, 3), found[0])
                    count += 1
        self.assertGreater(count, 500)

    def test_a_changed_number_of_a_file_is_noticed(self):
        for name, file in self.files.items():
            for column in [key for key in file.rows[0] if key not in NOT_SHOWN]:
                wrong = dict(self.files)
                wrong[name] = copy.deepcopy(file)
                for k, row in enumerate(wrong[name].rows):
                    row[column] = changed(row[column], k)
                found = figures.problems(self.pages, wrong)
                self.assertTrue(any(name + ".csv" in problem for problem in found), (name, column))

    def test_another_date_is_noticed(self):
        for name in self.files:
            wrong = dict(self.files)
            wrong[name] = copy.deepcopy(self.files[name])
            wrong[name].keys["date"] = "2001-01-01"
            self.assertTrue(any(name + ".csv: run" in problem
                                for problem in figures.problems(self.pages, wrong)), name)

    def test_what_is_missing_is_noticed(self):
        for name in self.files:
            less = {key: file for key, file in self.files.items() if key != name}
            self.assertTrue(any("no file" in problem and name in problem
                                for problem in figures.problems(self.pages, less)), name)
        self.files["peers"].rows.pop()
        self.assertTrue(self.problems())
        del self.files["sizes"].keys["compiler"]
        self.assertIn("tools/docs/figures/sizes.csv has no compiler", self.problems())

    def test_a_figure_that_no_page_has_is_noticed(self):
        text = self.pages["README.md"]
        mark = next(figures.MARKS.finditer(text))
        self.pages["README.md"] = text[:mark.start()] + text[mark.end():]
        self.assertTrue(any("no page has the figure" in problem for problem in self.problems()))

    def test_marks_elsewhere_are_refused(self):
        mark = next(figures.MARKS.finditer(self.pages["README.md"])).group(0)
        found = figures.page_problems("tools/docs/api.md", "It is " + mark,
                                      figures.texts_of(self.files))
        self.assertEqual(len(found), 1)


class Typed(unittest.TestCase):
    def test_times_and_ratios_are_found(self):
        for text in ("takes 2 ms", "in 13.5 seconds", "reads 40 GB/s", "3.5x", "twice as fast",
                     "six to seven times as long", "a quarter of a factorization", "4 times faster",
                     "a fiftieth of the time", "1/14 of the time", "half as long", "2 minutes",
                     "as long as two to three single ones", "a few percent of its cost"):
            self.assertTrue(figures.typed_figures("It " + text + " there."), text)

    def test_other_numbers_are_not(self):
        for text in ("2x2 pivots", "twice the memory", "several times as fast", "half of L",
                     "17 times the estimate", "at 8 times t", "    took 3 ms", "`sleep 3 s`",
                     "1e6 vertices", "80 % of the columns", "[x](a/3%20ms.md)"):
            self.assertEqual(figures.typed_figures(text), [], text)


class Results(unittest.TestCase):
    def test_peers(self):
        rows = figure_results.peer_rows(PEERS % 9)
        self.assertEqual([(row["step"], row["seconds"], row["peer"], row["peer_seconds"])
                          for row in rows],
                         [("one vertex, solve on a plan", 2e-6, "CHOLMOD solve2 Bset", 8e-6),
                          ("one vertex, plan + solve", 3e-6, "CHOLMOD solve2 Bset", 8e-6),
                          ("refactor", 1e-3, "", 0.0),
                          ("order + analyze + factor", 3.0, "CHOLMOD METIS", 9.0)])

    def test_a_disturbed_peer_is_left_out(self):
        with contextlib.redirect_stdout(io.StringIO()) as said:
            rows = figure_results.peer_rows(PEERS % 11)
        self.assertEqual((rows[-1]["seconds"], rows[-1]["peer"]), (3.0, ""))
        self.assertIn("left out: b, order to factor, CHOLMOD METIS took 11 s", said.getvalue())

    def test_two_threads_on_a_busy_machine_are_named(self):
        file = figures.Figures("# load: 1.87\na\n1\n")
        self.assertEqual(figure_texts.threads_load(file), "")
        file.keys["load"] = "8.10"
        self.assertIn("load 8", figure_texts.threads_load(file))

    def test_a_file_has_its_machine(self):
        machine = "".join("%s: x\n" % key for key in figures.KEYS)
        text = figures.file_text(machine, [{"a": 0.123456, "b": "c, d"}])
        file = figures.Figures(text)
        self.assertEqual((file.keys["date"], file.rows), ("x", [{"a": "0.1235", "b": "c, d"}]))
        with self.assertRaises(LookupError):
            figures.file_text("date: x\n", [{"a": 1}])


if __name__ == "__main__":
    unittest.main()
