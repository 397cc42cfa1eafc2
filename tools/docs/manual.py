#!/usr/bin/env python3
"""manual.py: writes the HTML manual from the comments of src/public, Markdown and the examples

    tools/docs/manual.py OUTPUT

The index leads to four parts: Learn, Do, Look up, Why. A page is a Markdown file: NAME.md of
tools/docs, or do/NAME.md. The API has a page for each public file; a contract is followed by a use
of its call. A link in a line of its own shows a program, or a section of one. The field at the top
of each page leads to a name. Names of the API become links, and so do pages that a comment names as
tools/docs/NAME.md. Programs are written as whole files too, examples/NAME.c. HOME_URL, if it is
set, is the address of one more link at the top.

Ends with 1 if a link leads nowhere, the index does not lead to a page, no page leads to a program,
a program is shown twice, a contract has no comment or no use, a measured figure is not that of its
file (figures.py), or the pages have too many words.
"""
import html
import json
import os
import re
import shutil
import sys

import figures
from contracts import api_pages, experimental
from markdown import anchor, markdown

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
MOST_WORDS = 45000
PROBLEMS = []
STYLE = """
body { font: 16px/1.5 sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; color: #222 }
pre { background: #f4f4f2; padding: .7em 1em; overflow-x: auto; font-size: 13px; line-height: 1.35 }
pre.use { background: #eef4ee; margin-top: -.7em }
code { background: #f4f4f2; font-size: 90% } pre code, pre a { background: none; font-size: 100% }
table { border-collapse: collapse; font-size: 14px }
td, th { border: 1px solid #ccc; padding: .2em .6em }
th { text-align: left; background: #f4f4f2 } a { color: #0645ad; text-decoration: none }
img { max-width: 100% }
a:hover { text-decoration: underline }
nav { border-bottom: 1px solid #ccc; padding-bottom: .5em }
nav input { font: inherit; width: 16em }
h2 { margin-top: 2em } h3 { margin-top: 1.5em }
"""
PARTS = ["Learn", "Do", "Look up", "Why"]


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def names_in(folder, ending):
    return sorted(name[:-len(ending)] for name in os.listdir(os.path.join(ROOT, folder))
                  if name.endswith(ending))


def page_files():
    """The page of each Markdown file that has one."""
    files = {"tools/docs/%s.md" % name: name for name in names_in("tools/docs", ".md")}
    files.update(("tools/docs/do/%s.md" % name, "do-" + name)
                 for name in names_in("tools/docs/do", ".md"))
    return files


# ---- programs ----

def sections(text):
    """The sections of a program: a line /* ---- NAME ---- */ begins one and ends the one before."""
    parts = re.split(r"^ */\* ---- (.+?) ---- \*/\n", text, flags=re.M)
    found = {}
    for name, body in zip(parts[1::2], parts[2::2]):
        lines = body.rstrip("\n").split("\n")
        indent = min(len(line) - len(line.lstrip()) for line in lines if line.strip())
        found[name] = "\n".join(line[indent:] for line in lines).strip("\n")
    return found


def whole_program(name):
    """The program with example.h in it, to be pasted: it needs the header of the library alone."""
    shared = read("tools/examples/example.h")
    shared = shared[shared.index('#include "sparse_local.h"'):shared.rindex("#endif")].strip()
    text = read("tools/examples/%s.c" % name)
    return text.replace('#include "example.h"', "#define SPARSE_LOCAL_IMPLEMENTATION\n" + shared)


class Page:
    """A Markdown file, as markdown() wants it: it knows where links lead and what they show."""

    def __init__(self, path, manual):
        self.path, self.manual = path, manual

    def resolved(self, target):
        return os.path.normpath(os.path.join(os.path.dirname(self.path), target))

    def link(self, target):
        """The address of a link; None for a file of the repository that has no page."""
        if re.match(r"https?:|#", target):
            return target
        path, _, part = target.partition("#")
        path = self.resolved(path)
        part = "#" + part if part else ""
        if path in self.manual.files:
            return self.manual.files[path] + ".html" + part
        if path == "src/public":
            return "api.html"
        public = re.match(r"src/public/(\w+)\.h$", path)
        if public:
            return "api-%s.html%s" % (public.group(1), part)
        program = re.match(r"tools/examples/(\w+\.(?:c|obj))$", path)
        if program:
            self.manual.linked.add(program.group(1))
            return "examples/" + program.group(1)
        if not os.path.exists(os.path.join(ROOT, path)):
            PROBLEMS.append("%s has a link to %s" % (self.path, target))
        return None

    def picture(self, target):
        self.manual.pictures.add(self.resolved(target))
        return os.path.basename(target)

    def shown(self, target):
        """A program of tools/examples or tools/adapters, or a section of it."""
        path, _, section = target.partition("#")
        path = self.resolved(path)
        if not re.match(r"tools/(examples|adapters)/\w+\.\w+$", path):
            return None
        whole_or_same = {"", section} if section else self.manual.shown.get(path, set())
        if whole_or_same & self.manual.shown.get(path, set()):
            PROBLEMS.append("%s is shown twice, in %s" % (target, self.path))
        self.manual.shown.setdefault(path, set()).add(section)
        self.link(target)
        text = read(path).replace('#include "example.h"\n', "")
        if section:
            text = sections(text).get(section)
            if text is None:
                PROBLEMS.append("%s: there is no section %s" % (self.path, target))
                return None
        out = "<pre>%s</pre>" % html.escape(text)
        name = os.path.basename(path)
        if not section and path.startswith("tools/examples/") and name.endswith(".c"):
            out += '<p>To paste: <a href="examples/%s">%s</a>.</p>' % (name, name)
        return out


# ---- the manual ----

class Manual:
    def __init__(self):
        self.files, self.pictures, self.linked, self.shown = page_files(), set(), set(), {}
        uses = sections(read("tools/examples/uses.c"))
        uses = {name: uses[name] for name in uses if name.startswith("sl_")}
        self.pages, contents, self.page_of_name, self.constants = api_pages(
            ROOT, read("src/sparse_local.in.h"), uses, PROBLEMS)
        for path, name in self.files.items():
            self.pages[name] = markdown(Page(path, self), read(path))
        self.pages["api"] += "<ul>%s</ul>" % "\n".join(contents)
        for name in self.pages:
            self.pages[name] = self.with_names(name)

    def with_names(self, page):
        """Names of the API as links, outside of tags, links and headings; in contracts names of
        pages, too."""
        pieces = re.split(r"(<a .*?</a>|<h[1-6].*?</h[1-6]>|<[^>]*>)", self.pages[page],
                          flags=re.S)
        pages = self.page_of_name
        for k in range(0, len(pieces), 2):
            pieces[k] = re.sub(r"\b(?:sl|SL)_\w+", lambda m: '<a href="%s.html#%s">%s</a>' % (
                pages[m.group(0)], m.group(0), m.group(0))
                if m.group(0) in pages else m.group(0), pieces[k])
        body = "".join(pieces)
        if not page.startswith("api"):
            return body
        return re.sub(r"tools/docs/(?:do/)?[a-z]+\.md", lambda m: '<a href="%s.html">%s</a>' % (
            self.files.get(m.group(0), m.group(0)), m.group(0)), body)

    def title(self, page):
        match = re.search(r"<h1.*?>(.*?)</h1>", self.pages[page])
        return html.unescape(re.sub("<[^>]*>", "", match.group(1))) if match else page

    def places(self):
        """Where each name of the API, each constant, macro and option is, and each page by its
        title."""
        first = sorted(self.files.values(), key=lambda page: not page.startswith("do-"))
        places = {self.title(page): page + ".html" for page in first}
        places.update((name, "%s.html#%s" % (page, name))
                      for name, page in sorted(self.page_of_name.items()))
        places.update(sorted(self.constants.items()))
        places.update((self.title(page), page + ".html") for page in self.pages)
        return places

    def words(self):
        return sum(len(html.unescape(re.sub("<[^>]*>", " ", body)).split())
                   for body in self.pages.values())

    def check_links(self):
        ids = {name: set(re.findall(r'id="([^"]+)"', body)) for name, body in self.pages.items()}
        targets = {}
        for name, body in self.pages.items():
            targets[name] = set()
            for target in re.findall(r'href="([^"]+)"', body):
                if target.startswith(("http", "examples/")):
                    continue
                page, _, part = target.partition("#")
                page = page[:-5] if page.endswith(".html") else page or name
                targets[name].add(page)
                if page not in ids or (part and part not in ids[page]):
                    PROBLEMS.append("%s.html has a link to %s" % (name, target))
        reached = targets["index"] | targets["api"] | {"index"}
        for name in sorted(set(self.pages) - reached):
            PROBLEMS.append("the index does not lead to %s.html" % name)

    def check_texts(self):
        """Do the texts mention what exists, and all programs?"""
        for name in names_in("tools/examples", ".c"):
            if name + ".c" not in self.linked:
                PROBLEMS.append("no page has a link to the program %s.c" % name)
        known = set(self.page_of_name)
        for name in names_in("tools/adapters", ".h"):
            known.update(re.findall(r"\bsl_\w+\b", read("tools/adapters/" + name + ".h")))
        for path in sorted(self.files) + ["src/public/intro.h"]:
            for name in sorted(set(re.findall(r"\bsl_\w+\b", read(path)))):
                if name not in known:
                    PROBLEMS.append("%s mentions %s, which is not public" % (path, name))
        rows = re.findall(r"^ \*  .*?\b(sl_\w+).*? (\w+\.h)", read("src/public/intro.h"), re.M)
        for name, file in rows:
            if self.page_of_name.get(name) != "api-" + file[:-2]:
                PROBLEMS.append("intro.h: %s is not in %s" % (name, file))
        marked = set().union(*(experimental(read("src/public/" + name + ".h"))
                               for name in names_in("src/public", ".h")))
        listed = read("tools/docs/promise.md").split("EXPERIMENTAL")[1].split("\n- ")[0]
        for name in sorted(marked ^ set(re.findall(r"`(sl_\w+)`", listed))):
            PROBLEMS.append("promise.md: %s is marked or listed as EXPERIMENTAL alone" % name)
        pages = {path: read(path) for path in sorted(self.files) + ["README.md"]}
        PROBLEMS.extend(figures.problems(pages))
        if self.words() > MOST_WORDS:
            PROBLEMS.append("the pages have %d words, at most %d" % (self.words(), MOST_WORDS))

    def write(self, output):
        home = html.escape(os.environ.get("HOME_URL", ""))
        home = ' &middot; <a href="%s">home</a>' % home if home else ""
        nav = '<nav><a href="index.html">sparse_local.h</a>: %s &middot; <input id="name" ' \
              'list="names" placeholder="a name or a topic" autocomplete="off">' \
              '<datalist id="names"></datalist></nav>' % (" &middot; ".join(
                  '<a href="index.html#%s">%s</a>' % (anchor(part), part)
                  for part in PARTS) + home)
        for name, body in self.pages.items():
            write(output, name + ".html",
                  '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
                  "<title>%s</title>\n<style>%s</style></head>\n<body>%s\n%s\n"
                  '<script src="search.js"></script></body></html>\n' % (
                      html.escape(re.sub("^(?!sparse_local.h)", "sparse_local.h: ",
                                         self.title(name))), STYLE, nav, body))
        write(output, "search.js", search_script(self.places()))
        for name in names_in("tools/examples", ".c"):
            write(output, "examples/%s.c" % name, whole_program(name))
        for name in names_in("tools/examples", ".obj"):
            shutil.copy(os.path.join(ROOT, "tools/examples", name + ".obj"),
                        os.path.join(output, "examples"))
        for path in self.pictures:
            shutil.copy(os.path.join(ROOT, path), output)


def search_script(places):
    """A script that fills the list of names and topics and goes to the one that is entered, or with
    Enter to the first that contains what is entered."""
    return """/* search.js: the field at the top of each page */
var places = %s;
var field = document.getElementById("name"), list = document.getElementById("names");
for (var name in places) {
    var option = document.createElement("option");
    option.value = name;
    list.appendChild(option);
}
field.addEventListener("input", function () {
    if (places.hasOwnProperty(field.value)) location.href = places[field.value];
});
field.addEventListener("change", function () {
    var wanted = field.value.toLowerCase();
    for (var name in places) {
        if (wanted !== "" && name.toLowerCase().indexOf(wanted) >= 0) {
            location.href = places[name];
            return;
        }
    }
});
""" % json.dumps(places, indent=0)


def write(output, name, text):
    with open(os.path.join(output, name), "w", encoding="utf-8") as file:
        file.write(text)


def main():
    output = sys.argv[1]
    os.makedirs(os.path.join(output, "examples"), exist_ok=True)
    manual = Manual()
    manual.check_links()
    manual.check_texts()
    manual.write(output)
    print("%d pages, %d words (at most %d), %d names of the API, %d programs in %s" % (
        len(manual.pages), manual.words(), MOST_WORDS, len(manual.page_of_name),
        len(names_in("tools/examples", ".c")), output))
    for problem in PROBLEMS:
        print("manual.py: " + problem, file=sys.stderr)
    return 1 if PROBLEMS else 0


sys.exit(main())
