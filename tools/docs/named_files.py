#!/usr/bin/env python3
"""named_files.py: do the files, headings, make targets and C names in the documents exist?

    tools/docs/named_files.py

Of each Markdown file of the repository, outside of code blocks: targets of links, with the heading
after #, and names of files between backquotes, `tests/core/test_judge.c` or `test_judge.c`: a path
from the root or from the folder of the document, or the end of one. `*` stands for any characters,
NAME in capitals for a name. `make target` has to be in a Makefile, and `sli_name`, `SL_NAME` and
the like in a source; with _ at the end they are the beginning of a name. Marks of measured figures
are in those documents alone that figures.py checks. CHANGELOG.md names what is gone: of it links
alone are checked. Ends with 1 if something does not exist.
"""
import fnmatch
import os
import re
import subprocess
import sys

import figures
from markdown import anchor

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
FILE = re.compile(r"[\w.*/{},-]*[\w*]\.(?:h|hpp|c|cpp|md|sh|py|awk|mk|cmake|m|mjs|csv|tsv|png|obj"
                  r"|ignore|dict)$|(?:src|tests|tools|bench|impl|public|\.ci)/[\w.*/-]+$")
C_NAME = re.compile(r"\b(?:sli?|SL[IFVW]?)_\w+")
SOURCE = re.compile(r"(?:src|tools|bench|tests(?!/abi))/.*\.(?:h|hpp|c|cpp|py|js|sh|mk|awk)$")
# of QDLDL, and of a release
OTHERS = {"qdldl.h", "CONTENTS.md", "pair/sparse_local.h", "pair/sparse_local.c"}


def files():
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT,
                            stdout=subprocess.PIPE, universal_newlines=True)
    found = set(listed.stdout.split())
    if listed.returncode != 0 or not found:
        for folder, folders, names in os.walk(ROOT):
            if folder == ROOT:
                folders[:] = [name for name in folders if name not in ("build", ".git")]
            found.update(os.path.relpath(os.path.join(folder, name), ROOT) for name in names)
    return {name for name in found if os.path.exists(os.path.join(ROOT, name))}


def folders_of(names):
    found = set()
    for name in names:
        while "/" in name:
            name = name.rpartition("/")[0]
            found.add(name)
    return found


def without_code(text):
    return re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def anchors(text):
    found = set(re.findall(r'<a (?:id|name)="([^"]+)"', text))
    return found | {anchor(title) for title in re.findall(r"^#+ +(.+?)\s*$", text, flags=re.M)}


def link_problems(path, text, there):
    for target in re.findall(r"\]\(([^()\s]+)\)", text):
        if re.match(r"[a-z]+:", target):
            continue
        name, _, part = target.partition("#")
        name = os.path.normpath(os.path.join(os.path.dirname(path), name)) if name else path
        if name not in there:
            yield "%s has a link to %s" % (path, target)
        elif part and name.endswith(".md") and part not in anchors(without_code(read(name))):
            yield "%s has a link to %s: there is no such heading" % (path, target)


def exists(name, path, there):
    name = name.rstrip("/").replace("NAME", "*")
    beside = os.path.normpath(os.path.join(os.path.dirname(path), name))
    if name in there or beside in there:
        return True
    return bool(fnmatch.filter(there, name) or fnmatch.filter(there, "*/" + name))


def name_problems(path, text, there):
    for name in sorted(set(re.findall(r"`([^`\n ]+)`", text))):
        if FILE.match(name) and not name.startswith("build/") and name not in OTHERS \
                and not exists(name, path, there):
            yield "%s names %s, which does not exist" % (path, name)


def targets(there):
    found = set()
    for name in there:
        if os.path.basename(name) == "Makefile" or name.endswith(".mk"):
            for line in re.findall(r"^([a-z][\w -]*):", read(name), flags=re.M):
                found.update(line.split())
    return found


def target_problems(path, text, known):
    for name in sorted(set(re.findall(r"`make ([a-z][\w-]*)", text)) - known):
        yield "%s names make %s, which does not exist" % (path, name)


def c_names(there):
    """The names of the sources, without the header of 1.0.0-rc1 and what is generated."""
    return {name for path in there
            if SOURCE.match(path)
            for name in C_NAME.findall(read(path))}


def c_name_problems(path, text, sources):
    quoted = " ".join(re.findall(r"`([^`]+)`", text))
    for name in sorted(set(C_NAME.findall(quoted)) - sources):
        call = name.partition("_needs_SL_WITH_")[0]  # what a call of a pack that is off expands to
        is_part = name.endswith("_") and any(full.startswith(name) for full in sources)
        if call not in sources and not is_part and "NAME" not in name:
            yield "%s names %s, which is in no source" % (path, name)


def problems(path, text, there, known, sources):
    """What a document names and does not exist; known: the targets of make; sources: names of C."""
    found = list(link_problems(path, without_code(text), there))
    if path == "CHANGELOG.md":
        return found
    found += name_problems(path, without_code(text), there)
    found += target_problems(path, text, known)
    found += c_name_problems(path, without_code(text), sources)
    if path not in figures.MARKED and figures.MARKS.search(text):
        found.append("%s has marks of figures, which nothing checks there" % path)
    return found


def main():
    names = files()
    there = names | folders_of(names)
    pages = sorted(name for name in names if name.endswith(".md"))
    known = targets(names)
    sources = c_names(names)
    found = [problem for page in pages
             for problem in problems(page, read(page), there, known, sources)]
    print("\n".join(found) or "named_files: what %d documents name exists" % len(pages))
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
