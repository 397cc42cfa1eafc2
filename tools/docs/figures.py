#!/usr/bin/env python3
"""figures.py: the measured figures of README.md and the manual, from files that the bench writes

    tools/docs/figures.py record RESULTS    writes tools/docs/figures/NAME.csv, from make speed
    tools/docs/figures.py pages             writes the figures into the pages

A file begins with lines `# key: value`: date, commit, machine, instruction set, compiler. A page
has a figure between <!-- NAME.csv: FIGURE --> and <!-- end -->, where FIGURE names what
figure_texts.py makes of the file. manual.py calls problems(): make docs fails if a page has another
text than the files give, or a time, or a ratio of times, outside of such marks. Only README.md,
speed.md and raster.md may have marks.
"""
import csv
import glob
import os
import re
import sys

from figure_results import RESULTS
from figure_texts import TEXTS

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
FOLDER = "tools/docs/figures"
MARKED = ["README.md", "tools/docs/speed.md", "tools/docs/do/raster.md"]
KEYS = ["date", "commit", "machine", "instruction set", "compiler"]
MARKS = re.compile(r"(<!-- (\w+)\.csv: ([\w ]+) -->)(.*?)(<!-- end -->)", re.S)

NUMBER = r"(?:\b(?:\d[\d.,/e]*|two|three|four|five|six|seven|eight|nine|ten|[a-z]*dozen)\s)"
SHARE = r"(?:half|thirds?|quarters?|fifths?|sixths?|sevenths?|eighths?|ninths?|tenths?|" \
    r"[a-z]*tieths?|hundredths?|thousandths?|percent|%|1/\d+)"
# Texts that say a time, a rate of the machine, or a ratio of times.
TYPED = [
    r"\b\d[\d.,]*\s?(?:ns|us|ms|s|sec|seconds?|minutes?|hours?)\b",
    r"\b\d[\d.,]*\s?G(?:Flop|flop|B)/s",
    r"\b\d+(?:\.\d+)?x(?!\w)",
    NUMBER + r"?(?:twice|thrice) as (?:fast|long|slow)",
    NUMBER + r"times (?:as (?:fast|long)|faster|slower|longer)",
    SHARE + r"\s(?:as|longer|less|of)\s(?:\w+\s){0,3}?"
    r"(?:times?|cost|long|longer|fast|factorization|factor|solve|restriction|inversion)\b",
    r"percent of its cost\b",
    r"as long as " + NUMBER,
]


class Figures:
    """A file: its keys, and its rows as dictionaries."""

    def __init__(self, text):
        lines = text.split("\n")
        self.keys = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# "))
        self.rows = list(csv.DictReader(line for line in lines if not line.startswith("# ")))

    def where(self, **wanted):
        """The only row that has these values."""
        found = [row for row in self.rows
                 if all(row[key] == str(value) for key, value in wanted.items())]
        if len(found) != 1:
            raise LookupError("%d rows with %s" % (len(found), wanted))
        return found[0]


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def read_all():
    """The files by name, without their ending."""
    paths = glob.glob(os.path.join(ROOT, FOLDER, "*.csv"))
    return {os.path.basename(path)[:-4]: Figures(read(path)) for path in sorted(paths)}


# ---- files ----

def number_text(value):
    """Four digits of a number that is not an integer: more differ from run to run."""
    return "%.4g" % value if isinstance(value, float) else str(value)


def file_text(machine, rows):
    """A file: keys of what the bench wrote on the machine, and rows."""
    keys = dict(line.split(": ", 1) for line in machine.strip().split("\n"))
    missing = [key for key in KEYS if key not in keys]
    if missing:
        raise LookupError("the machine has no %s" % ", ".join(missing))
    lines = ["# %s: %s" % item for item in keys.items()] + [",".join(rows[0])]
    for row in rows:
        cells = [number_text(value) for value in row.values()]
        lines.append(",".join('"%s"' % cell if "," in cell else cell for cell in cells))
    return "\n".join(lines) + "\n"


def record(results):
    """Writes the files whose measurements are all in the folder; others stay as they are."""
    for name, (sources, machine, rows_of) in RESULTS.items():
        tables = []
        for source in sources:
            path = os.path.join(results, source)
            if not os.path.exists(path):
                break
            with open(path, encoding="utf-8") as file:
                tables.append(file.read())
        if len(tables) < len(sources):
            print("%s.csv stays: %s was not measured" % (name, source))
            continue
        with open(os.path.join(results, machine), encoding="utf-8") as file:
            text = file_text(file.read(), rows_of(*tables))
        os.makedirs(os.path.join(ROOT, FOLDER), exist_ok=True)
        with open(os.path.join(ROOT, FOLDER, name + ".csv"), "w", encoding="utf-8") as file:
            file.write(text)


# ---- pages ----

def texts_of(files):
    """The text of each figure, or the LookupError that says what it lacks."""
    texts = {}
    for name, what in TEXTS:
        try:
            if name not in files:
                raise LookupError("there is no file %s/%s.csv" % (FOLDER, name))
            texts[name, what] = TEXTS[name, what](files[name])
        except LookupError as error:
            texts[name, what] = error
    return texts


def text_of(texts, mark):
    """The text that belongs between marks."""
    text = texts.get(mark.group(2, 3), LookupError("there is no such figure"))
    if isinstance(text, LookupError):
        raise LookupError("%s.csv: %s: %s" % (mark.group(2, 3) + (text,)))
    return text


def with_figures(text, texts):
    """The page with the figures of the files."""
    return MARKS.sub(lambda mark: mark.group(1) + text_of(texts, mark) + mark.group(5), text)


def without_code(text):
    text = re.sub(r"^```.*?^```|^    .*?$|`[^`\n]*`", "", text, flags=re.S | re.M)
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)


def typed_figures(text):
    """Times and ratios of times outside of marks, code and links."""
    text = " ".join(without_code(MARKS.sub(" ", text)).split())
    return [match.group(0).strip() for pattern in TYPED for match in re.finditer(pattern, text)]


def page_problems(path, text, texts):
    """What is wrong with the figures of a page."""
    found = []
    marks = list(MARKS.finditer(text))
    if marks and path not in MARKED:
        found.append("%s has measured figures, which belong into speed.md" % path)
    for mark in marks:
        name = "%s: %s.csv: %s" % (path, mark.group(2), mark.group(3))
        try:
            wanted = text_of(texts, mark)
        except LookupError as error:
            found.append("%s: %s" % (path, error))
            continue
        if mark.group(4) != wanted:
            found.append("%s: the page has '%s', the file gives '%s'; run make speed-pages" % (
                (name,) + first_difference(mark.group(4), wanted)))
        # Markdown takes a line that begins with a comment as HTML.
        if "\n" not in wanted and text[:mark.start()].split("\n")[-1].strip(" -") == "":
            found.append("%s: the mark begins a line" % name)
    if text.count("<!-- end -->") != len(marks):
        found.append("%s has marks of figures that are not in pairs" % path)
    found += ["%s: '%s' is not from a file of %s" % (path, typed, FOLDER)
              for typed in typed_figures(text)]
    return found


def first_difference(old, new):
    """The first lines that differ."""
    pairs = zip(old.split("\n") + [""], new.split("\n") + [""])
    return next((pair for pair in pairs if pair[0] != pair[1]), (old, new))


def problems(pages, files=None):
    """What is wrong with the figures of pages, a dictionary of texts by path."""
    files = read_all() if files is None else files
    found = []
    for name, file in files.items():
        for key in KEYS:
            if not file.keys.get(key):
                found.append("%s/%s.csv has no %s" % (FOLDER, name, key))
    shown, texts = set(), texts_of(files)
    for path, text in pages.items():
        found += page_problems(path, text, texts)
        shown.update(mark.group(2, 3) for mark in MARKS.finditer(text))
    found += ["no page has the figure %s.csv: %s" % missing
              for missing in sorted(set(TEXTS) - shown)]
    found += ["no page has a figure of %s/%s.csv" % (FOLDER, name)
              for name in sorted(set(files) - {name for name, _ in shown})]
    return found


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "record":
        record(sys.argv[2])
        return 0
    if sys.argv[1:] != ["pages"]:
        print(__doc__, file=sys.stderr)
        return 2
    texts = texts_of(read_all())
    try:
        pages = {path: with_figures(read(path), texts) for path in MARKED}
    except LookupError as error:
        print("figures.py: %s" % error, file=sys.stderr)
        return 1
    for path, text in pages.items():
        with open(os.path.join(ROOT, path), "w", encoding="utf-8") as file:
            file.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
