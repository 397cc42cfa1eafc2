"""contracts.py: the pages of the API, from the comments of src/public

A contract is followed by a use of its call, a section of tools/examples/uses.c.
"""
import html
import os
import re

LINES_OF_USE = 3


# of a declaration: linkage, and a warning where a status is not looked at
BEFORE_RESULT = "SL_API SL_WARN_UNUSED "


class Entry:
    """A declaration, its name, and the comment before it."""

    def __init__(self, comment, code):
        self.comment, self.code = comment, code
        self.name = declared_name(code)

    def is_function(self):
        return bool(self.name) and "SL_API" in self.code and not self.code.startswith("#")


def declared_name(code):
    """The name that a declaration declares, or None."""
    for pattern in (r"^\} (\w+);", r"\(\*(sl_\w+)\)\(", r"\b(sl_\w+)\(",
                    r"^typedef [\w ]+ \*?(\w+);", r"^#define (\w+)"):
        match = re.search(pattern, code, re.M)
        if match:
            return match.group(1)
    return None


def parse_header(text):
    """The entries of a public file. A declaration ends at a semicolon outside braces."""
    text = re.sub(r"^#(ifn?def|if|endif|include|else).*\n(?:(?<=\\\n).*\n)*", "", text, flags=re.M)
    entries, comment, code, depth = [], "", [], 0
    position = 0
    lines = text.split("\n")
    while position < len(lines):
        line = lines[position]
        if depth == 0 and not code and line.startswith("/*"):
            end = position
            while "*/" not in lines[end]:
                end += 1
            comment = "\n".join(lines[position:end + 1])
            position = end + 1
            continue
        if line.strip() or code:
            code.append(line)
            bare = re.sub(r"/\*.*?\*/", "", line)
            depth += bare.count("{") - bare.count("}")
            ends = bare.rstrip().endswith(";") or (line.startswith("#") and not line.endswith("\\"))
            if depth == 0 and ends:
                entries.append(Entry(comment, "\n".join(code)))
                comment, code = "", []
        elif comment and not code:
            entries.append(Entry(comment, ""))
            comment = ""
        position += 1
    return entries


def experimental(text):
    """The names in a public file whose contracts have EXPERIMENTAL in their first line."""
    return {entry.name for entry in parse_header(text)
            if "EXPERIMENTAL" in entry.comment.split("\n")[0]}


def shown_code(code):
    """A declaration without what only the compiler reads."""
    for begin in (BEFORE_RESULT, "SL_API "):
        if code.startswith(begin):
            return code[len(begin):].replace("\n" + " " * len(begin), "\n")
    return code


def shown_comment(comment):
    """A contract without the tests that it names: the manual shows a use."""
    return re.sub(r"^Example +.*\n?", "", comment_text(comment), flags=re.M).rstrip("\n")


def shown_entries(file, entries):
    """Of the introduction what holds for all calls; the manual has pages in place of the rest."""
    return [entry for entry in entries
            if file != "intro" or re.match(r"/\* (Notation|References)", entry.comment)]


def comment_text(comment):
    """The text of a C comment without its stars."""
    body = re.sub(r"^/\*+ ?|\s*\*+/$", "", comment.strip())
    return "\n".join(re.sub(r"^ \*(  ?)?", "", line) for line in body.split("\n"))


def check_entry(root, entry, uses, problems):
    """Has a function a comment and a use, and are the files there that it gives as examples?"""
    # a view is described at the struct that it returns
    if entry.is_function() and not (entry.comment or entry.name.endswith("_view")):
        problems.append("%s has no comment" % entry.name)
    if entry.is_function() and "sl_status " in entry.code.split("(")[0]:
        lines = uses.get(entry.name, "").count("\n") + 1
        if entry.name not in uses or lines > LINES_OF_USE:
            problems.append("%s: tools/examples/uses.c needs a section of 1 to %d lines" % (
                entry.name, LINES_OF_USE))
    for example in re.findall(r"Example +(.*)", comment_text(entry.comment)):
        for path in re.findall(r"[\w/]+\.c\b", example):
            path = path if "/" in path else "tests/core/" + path
            if not os.path.exists(os.path.join(root, path)):
                problems.append("%s gives the example %s" % (entry.name, path))


def entry_html(entry, uses):
    """The HTML of a declaration, its comment, and its use."""
    parts = ['<h3 id="%s">%s</h3>' % (entry.name, entry.name)] if entry.name else []
    if entry.code:
        parts.append("<pre>%s</pre>" % html.escape(shown_code(entry.code)))
    if entry.comment:
        parts.append("<pre>%s</pre>" % html.escape(shown_comment(entry.comment)))
    if entry.is_function() and entry.name in uses:
        parts.append('<pre class="use">%s</pre>' % html.escape(uses[entry.name]))
    return "\n".join(parts)


def constants_of(entry):
    """The names within a declaration that are not declared by it alone: values of an enumeration,
    the members of sl_options, and macros that a comment lists."""
    if entry.name == "sl_options":
        members = re.findall(r"(\w+);", re.sub(r"/\*.*?\*/", "", entry.code, flags=re.S))
        return ["options." + name for name in members if name not in ("reserved", "sl_options")]
    if entry.code.startswith("typedef enum"):
        return re.findall(r"^ +(SL_\w+)", re.sub(r"/\*.*?\*/", "", entry.code, flags=re.S), re.M)
    return re.findall(r"^ \*  ((?:SL|SPARSE_LOCAL)_\w+) ", entry.comment, re.M)


def api_pages(root, manifest, uses, problems):
    """The bodies of a page for each public file, the lines that lead to them, the page of each
    name, and the place of each constant."""
    pages, contents, page_of_name, constants = {}, [], {}, {}
    for file in re.findall(r'#include "public/(\w+)\.h"', manifest):
        page = "api-" + file
        with open(os.path.join(root, "src/public/%s.h" % file), encoding="utf-8") as header:
            text = header.read()
        title = html.escape(re.match(r"/\* (\w+\.h): (.*?) \*/", text).group(2))
        entries = [entry for entry in parse_header(text.split("\n", 1)[1])
                   if not (entry.name or "").startswith("SL_PUBLIC")]
        for entry in entries:
            check_entry(root, entry, uses, problems)
        found = [entry.name for entry in entries if entry.name]
        page_of_name.update((name, page) for name in found)
        for entry in entries:
            place = "%s.html%s" % (page, "#" + entry.name if entry.name else "")
            constants.update((name, place) for name in constants_of(entry) if name not in found)
        pages[page] = "<h1>%s.h: %s</h1>\n%s" % (file, title, "\n".join(
            entry_html(entry, uses) for entry in shown_entries(file, entries)))
        contents.append('<li><a href="%s.html">%s.h</a>: %s</li>' % (page, file, title))
    for name in sorted(set(uses) - set(page_of_name)):
        problems.append("tools/examples/uses.c uses %s, which is not public" % name)
    return pages, contents, page_of_name, constants
