#!/usr/bin/env python3
"""manual.py: writes the HTML manual from the comments of src/public, Markdown and the examples

    tools/docs/manual.py OUTPUT

Pages: index (the guide), api (all names), api-NAME for each public file, the chapters of
tools/docs, format, tests, changelog, and the READMEs of other languages. The field at the top of
each page leads to a name. Names of the API become links, and so do chapters that a comment names
as tools/docs/NAME.md. The examples are written as whole programs too, examples/NAME.c. Ends with 1
if a link leads nowhere, a public name has no comment, or a file that a comment gives as its
example is missing.
"""
import html
import json
import os
import re
import shutil
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
PROBLEMS, PICTURES = [], []
STYLE = """
body { font: 16px/1.5 sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; color: #222 }
pre { background: #f4f4f2; padding: .7em 1em; overflow-x: auto; font-size: 13px; line-height: 1.35 }
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
CHAPTERS = [("algorithms", "Algorithms"), ("ordering", "Orderings"),
            ("singular", "Singular systems"), ("bounds", "Bounds of errors"),
            ("derivatives", "Derivatives"), ("accuracy", "Accuracy"),
            ("indefinite", "Indefinite and KKT systems"),
            ("float", "L in float"), ("inverse", "Entries of the inverse"),
            ("fixed", "Rows at given values"),
            ("changes", "Changes of a matrix"), ("files", "Files"), ("errors", "What can go wrong"),
            ("program", "The program"), ("web", "In browsers"), ("doors", "Other languages"),
            ("features", "Features"), ("speed", "Speed"), ("platforms", "Platforms"),
            ("promise", "What stays")]
# READMEs of folders of tools: pages that "Other languages" leads to
DOORS = [("python", "Python"), ("octave", "Octave and MATLAB"), ("npm", "JavaScript"),
         ("cluster", "Clusters")]
PAGES = [("index", "Guide"), ("api", "API")] + CHAPTERS + [
    ("format", "Format"), ("tests", "Tests"), ("changelog", "Changelog")]


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


# ---- the API ----

class Entry:
    """A declaration, its names, and the comment before it."""

    def __init__(self, comment, code):
        self.comment, self.code = comment, code
        self.name = declared_name(code)


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


def comment_text(comment):
    """The text of a C comment without its stars."""
    body = re.sub(r"^/\*+ ?|\s*\*+/$", "", comment.strip())
    return "\n".join(re.sub(r"^ \*(  ?)?", "", line) for line in body.split("\n"))


def api_entry(entry):
    """The HTML of a declaration and its comment."""
    parts = ['<h3 id="%s">%s</h3>' % (entry.name, entry.name)] if entry.name else []
    # a view is described at the struct that it returns
    if entry.name and "SL_API" in entry.code and not (
            entry.comment or entry.name.endswith("_view") or entry.code.startswith("#")):
        PROBLEMS.append("%s has no comment" % entry.name)
    if entry.code:
        parts.append("<pre>%s</pre>" % html.escape(entry.code))
    if entry.comment:
        text = comment_text(entry.comment)
        for example in re.findall(r"Example +(.*)", text):
            for path in re.findall(r"[\w/]+\.c\b", example):
                path = path if "/" in path else "tests/core/" + path
                if not os.path.exists(os.path.join(ROOT, path)):
                    PROBLEMS.append("%s gives the example %s" % (entry.name, path))
        parts.append("<pre>%s</pre>" % html.escape(text))
    return "\n".join(parts)


def api_pages(manifest):
    """The bodies of the page of all names and of one page a public file; the page of each name."""
    pages, contents, page_of_name = {}, [], {}
    for file in re.findall(r'#include "public/(\w+)\.h"', manifest):
        page = "api-" + file
        text = read("src/public/%s.h" % file)
        title = html.escape(re.match(r"/\* (\w+\.h): (.*?) \*/", text).group(2))
        entries = [entry for entry in parse_header(text.split("\n", 1)[1])
                   if not (entry.name or "").startswith("SL_PUBLIC")]
        found = [entry.name for entry in entries if entry.name]
        page_of_name.update((name, page) for name in found)
        pages[page] = "<h1>%s.h: %s</h1>\n%s" % (file, title,
                                                "\n".join(api_entry(e) for e in entries))
        contents.append('<li><a href="%s.html">%s.h</a>: %s<br>%s</li>' % (
            page, file, title, ", ".join(found)))
    pages["api"] = "<h1>API</h1><ul>%s</ul>" % "\n".join(contents)
    return pages, page_of_name


# ---- Markdown, as far as the files use it ----

def inline(text):
    """Code, links and bold in one line."""
    kept = []

    def keep(markup):
        kept.append(markup)
        return "\0%d\0" % (len(kept) - 1)

    text = re.sub(r"`([^`]+)`", lambda m: keep("<code>%s</code>" % html.escape(m.group(1))), text)
    text = re.sub(r"!\[([^\]]*)\]\(([^)]+)\)",
                  lambda m: keep(picture(m.group(2), m.group(1))), text)
    text = re.sub(r"\[([^\]]+)\]\(([^)\s]+)\)", lambda m: keep('<a href="%s">%s</a>' % (
        page_of(m.group(2)), html.escape(m.group(1)))), text)
    text = re.sub(r"\*\*([^*]+)\*\*", r"<b>\1</b>", html.escape(text, quote=False))
    while "\0" in text:
        text = re.sub("\0(\\d+)\0", lambda m: kept[int(m.group(1))], text)
    return text


def picture(path, text):
    """A picture of the repository, which is copied beside the pages."""
    PICTURES.append(os.path.join("tools/docs", path))
    return '<img src="%s" alt="%s">' % (os.path.basename(path), html.escape(text))


def page_of(target):
    """A link between files of the repository as one between pages."""
    target = re.sub(r"^(?:\.\./)*", "", target)
    for pattern, page in ((r"(?:tools/docs/)?guide\.md", "index.html"),
                          (r"(?:tools/docs/)?([a-z]+)\.md", r"\1.html"),
                          (r"examples/(\w+)\.c", r"index.html#example-\1"),
                          (r"src/public/(\w+)\.h", r"api-\1.html"), (r"src/public", "api.html"),
                          (r"(?:src/)?FORMAT\.md", "format.html"),
                          (r"tests/README\.md", "tests.html"),
                          (r"web/README\.md", "npm.html"),
                          (r"(python|octave|cluster)/README\.md", r"\1.html"),
                          (r"CHANGELOG\.md", "changelog.html")):
        target = re.sub("^%s(?=#|$)" % pattern, page, target)
    return target


def anchor(title):
    return re.sub(r"[^\w]+", "-", title.lower()).strip("-")


def table(lines):
    rows = [[cell.strip().replace(r"\|", "|")
             for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))] for line in lines]
    out = ["<table>"]
    for number, row in enumerate(rows):
        if number == 1:
            continue
        tag = "th" if number == 0 else "td"
        out.append("<tr>%s</tr>" % "".join("<%s>%s</%s>" % (tag, inline(c), tag) for c in row))
    return "\n".join(out + ["</table>"])


def markdown(text):
    """HTML of headings, paragraphs, lists, tables, code; a link in a line of its own may become
    what it leads to."""
    out, lines, k = [], re.sub(r"<!--.*?-->", "", text, flags=re.S).split("\n"), 0
    while k < len(lines):
        line = lines[k]
        start = k
        k += 1
        if line.startswith("```"):
            while not lines[k].startswith("```"):
                k += 1
            out.append("<pre>%s</pre>" % html.escape("\n".join(lines[start + 1:k])))
            k += 1
        elif line.startswith("#"):
            level, title = len(line) - len(line.lstrip("#")), line.lstrip("# ")
            out.append('<h%d id="%s">%s</h%d>' % (level, anchor(title), inline(title), level))
        elif line.startswith("|"):
            while k < len(lines) and lines[k].startswith("|"):
                k += 1
            out.append(table(lines[start:k]))
        elif line.startswith("- "):
            while k < len(lines) and (lines[k].startswith("- ") or lines[k].startswith("  ")):
                k += 1
            items = re.split(r"\n- ", "\n" + "\n".join(lines[start:k]))[1:]
            out.append("<ul>%s</ul>" % "".join("<li>%s</li>" % inline(" ".join(item.split()))
                                               for item in items))
        elif line.startswith("    ") and line.strip():
            while k < len(lines) and (lines[k].startswith("    ") or not lines[k].strip()):
                k += 1
            code = "\n".join(text[4:] for text in lines[start:k])
            out.append("<pre>%s</pre>" % html.escape(code.rstrip()))
        elif included(line):
            out.append(included(line))
        elif line.strip():
            while k < len(lines) and lines[k].strip() and not re.match(r"[#|]|- |```", lines[k]):
                k += 1
            out.append("<p>%s</p>" % inline(" ".join(lines[start:k])))
    return "\n".join(out)


def examples():
    folder = os.path.join(ROOT, "tools/examples")
    return sorted(name[:-2] for name in os.listdir(folder) if name.endswith(".c"))


def whole_example(name):
    """The program with example.h in it, to be pasted: it needs the header of the library alone."""
    shared = read("tools/examples/example.h")
    shared = shared[shared.index('#include "sparse_local.h"'):shared.rindex("#endif")].strip()
    text = read("tools/examples/%s.c" % name)
    return text.replace('#include "example.h"', "#define SPARSE_LOCAL_IMPLEMENTATION\n" + shared)


def included(line):
    """What a line that is nothing but a link shows: the examples, one without what examples share,
    or a file of tools/adapters."""
    link = re.match(r"\[[^\]]+\]\(\.\./(examples|adapters)(?:/(\w+)(\.\w+))?\)$", line)
    if not link:
        return None
    folder, name, ending = link.groups()
    if not name:
        title = '<h3 id="example-%s"><a href="examples/%s.c">%s.c</a></h3><pre>%s</pre>'
        return "\n".join(title % (e, e, e, html.escape(whole_example(e))) for e in examples())
    text = "<pre>%s</pre>" % html.escape(
        read("tools/%s/%s%s" % (folder, name, ending)).replace('#include "example.h"\n', ""))
    if folder == "examples":
        text += '<p>The same to paste: <a href="examples/%s.c">%s.c</a>.</p>' % (name, name)
    return text


# ---- pages ----

def link_names(body, page_of_name):
    """Names of the API as links, outside of tags, links and headings."""
    pieces = re.split(r"(<a .*?</a>|<h[1-6].*?</h[1-6]>|<[^>]*>)", body, flags=re.S)
    for k in range(0, len(pieces), 2):
        pieces[k] = re.sub(r"\b(?:sl|SL)_\w+", lambda m: '<a href="%s.html#%s">%s</a>' % (
            page_of_name[m.group(0)], m.group(0), m.group(0))
            if m.group(0) in page_of_name else m.group(0), pieces[k])
    return "".join(pieces)


def link_chapters(body):
    """Names of chapters in comments as links."""
    return re.sub(r"tools/docs/([a-z]+)\.md", r'<a href="\1.html">tools/docs/\1.md</a>', body)


def check_links(pages):
    ids = {name: set(re.findall(r'id="([^"]+)"', body)) for name, body in pages.items()}
    for name, body in pages.items():
        for target in re.findall(r'href="([^"]+)"', body):
            if target.startswith("http") or target.startswith("examples/"):
                continue
            page, _, part = target.partition("#")
            page = page[:-5] if page.endswith(".html") else page or name
            if page not in ids or (part and part not in ids[page]):
                PROBLEMS.append("%s.html has a link to %s" % (name, target))


def search_script(page_of_name):
    """A script that fills the list of names and goes to the one that is entered."""
    return """/* search.js: the field at the top of each page */
var page_of_name = %s;
var field = document.getElementById("name"), list = document.getElementById("names");
for (var name in page_of_name) {
    var option = document.createElement("option");
    option.value = name;
    list.appendChild(option);
}
field.addEventListener("input", function () {
    if (page_of_name.hasOwnProperty(field.value)) {
        location.href = page_of_name[field.value] + ".html#" + field.value;
    }
});
""" % json.dumps(page_of_name, indent=0, sort_keys=True)


def check_texts(page_of_name):
    """Do the guide, the chapters and intro.h mention what exists, and all examples?"""
    guide = read("tools/docs/guide.md")
    for name in examples():
        if "(../examples/%s.c)" % name not in guide:
            PROBLEMS.append("the guide does not mention the example %s" % name)
    written = [("guide", guide), ("intro.h", read("src/public/intro.h"))]
    written += [(name, read("tools/docs/%s.md" % name)) for name, _ in CHAPTERS]
    for page, text in written:
        for name in sorted(set(re.findall(r"\bsl_\w+\b", text)) - set(page_of_name)):
            PROBLEMS.append("%s mentions %s, which is not public" % (page, name))
    rows = re.findall(r"^ \*  .*?\b(sl_\w+).*? (\w+\.h)", read("src/public/intro.h"), re.M)
    for name, file in rows:
        if page_of_name.get(name) != "api-" + file[:-2]:
            PROBLEMS.append("intro.h: %s is not in %s" % (name, file))


def write(output, name, text):
    with open(os.path.join(output, name), "w", encoding="utf-8") as file:
        file.write(text)


def main():
    output = sys.argv[1]
    os.makedirs(os.path.join(output, "examples"), exist_ok=True)
    pages, page_of_name = api_pages(read("src/sparse_local.in.h"))
    titles = dict(PAGES + DOORS, **{page: page[4:] + ".h" for page in pages if page != "api"})
    pages.update({"index": markdown(read("tools/docs/guide.md")),
                  "format": markdown(read("src/FORMAT.md")),
                  "tests": markdown(read("tests/README.md")),
                  "changelog": markdown(read("CHANGELOG.md"))})
    for name, _ in CHAPTERS:
        pages[name] = markdown(read("tools/docs/%s.md" % name))
    for name, _ in DOORS:
        folder = "web" if name == "npm" else name
        pages[name] = markdown(read("tools/%s/README.md" % folder))
    for name in pages:
        pages[name] = link_names(pages[name], page_of_name)
        if name.startswith("api"):
            pages[name] = link_chapters(pages[name])
    check_links(pages)
    check_texts(page_of_name)
    nav = '<nav>sparse_local.h: %s &middot; <input id="name" list="names" placeholder="a name of ' \
          'the API" autocomplete="off"><datalist id="names"></datalist></nav>' % " &middot; ".join(
              '<a href="%s.html">%s</a>' % page for page in PAGES)
    for name in pages:
        write(output, name + ".html",
              '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
              "<title>sparse_local.h: %s</title>\n<style>%s</style></head>\n<body>%s\n%s\n"
              '<script src="search.js"></script></body></html>\n' % (titles[name], STYLE, nav,
                                                                     pages[name]))
    write(output, "search.js", search_script(page_of_name))
    for name in examples():
        write(output, "examples/%s.c" % name, whole_example(name))
    for path in PICTURES:
        shutil.copy(os.path.join(ROOT, path), output)
    print("%d pages, %d names of the API, %d examples in %s" % (len(pages), len(page_of_name),
                                                               len(examples()), output))
    for problem in PROBLEMS:
        print("manual.py: " + problem, file=sys.stderr)
    return 1 if PROBLEMS else 0


sys.exit(main())
