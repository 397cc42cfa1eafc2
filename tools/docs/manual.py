#!/usr/bin/env python3
"""manual.py: writes the HTML manual from the comments of src/public, Markdown and the examples

    tools/docs/manual.py OUTPUT

Pages: index (the guide), api, the chapters of tools/docs, format, tests, platforms, changelog.
Names of the API become links, and so do chapters that a comment names as tools/docs/NAME.md. Ends
with 1 if a link leads nowhere, a public name has no comment, or a file that a comment gives as its
example is missing.
"""
import html
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
h2 { margin-top: 2em } h3 { margin-top: 1.5em }
"""
CHAPTERS = [("algorithms", "Algorithms"), ("ordering", "Orderings"),
            ("singular", "Singular systems"), ("bounds", "Bounds of errors"),
            ("derivatives", "Derivatives"),
            ("indefinite", "Indefinite and KKT systems"),
            ("float", "L in float"), ("inverse", "Entries of the inverse"),
            ("changes", "Changes of a matrix"), ("files", "Files")]
PAGES = [("index", "Guide"), ("api", "API")] + CHAPTERS + [
    ("format", "Format"), ("tests", "Tests"), ("platforms", "Platforms"),
    ("changelog", "Changelog")]


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


def api_page(manifest):
    """The body of the API page, and the names that it defines."""
    files = re.findall(r'#include "public/(\w+\.h)"', manifest)
    parts, contents, names = [], [], []
    for file in files:
        text = read("src/public/" + file)
        title = re.match(r"/\* (\w+\.h): (.*?) \*/", text).group(2)
        parts.append('<h2 id="%s">%s: %s</h2>' % (file, file, html.escape(title)))
        found = []
        for entry in parse_header(text.split("\n", 1)[1]):
            if entry.name and entry.name.startswith("SL_PUBLIC"):
                continue
            if entry.name:
                names.append(entry.name)
                found.append(entry.name)
                parts.append('<h3 id="%s">%s</h3>' % (entry.name, entry.name))
                # a view is described at the struct that it returns
                if not (entry.comment or entry.name.endswith("_view") or
                        entry.code.startswith("#")) and "SL_API" in entry.code:
                    PROBLEMS.append("%s has no comment" % entry.name)
            if entry.code:
                parts.append("<pre>%s</pre>" % html.escape(entry.code))
            if entry.comment:
                text_of = comment_text(entry.comment)
                for example in re.findall(r"Example +(.*)", text_of):
                    for path in re.findall(r"[\w/]+\.c\b", example):
                        path = path if "/" in path else "tests/core/" + path
                        if not os.path.exists(os.path.join(ROOT, path)):
                            PROBLEMS.append("%s gives the example %s" % (entry.name, path))
                parts.append("<pre>%s</pre>" % html.escape(text_of))
        contents.append('<li><a href="#%s">%s</a>: %s</li>' % (
            file, file, ", ".join('<a href="#%s">%s</a>' % (n, n) for n in found)))
    return "<h1>API</h1><ul>%s</ul>" % "".join(contents) + "\n".join(parts), names


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
    text = re.sub(r"@(\w+)", r'<a href="index.html#example-\1">\1</a>', text)
    while "\0" in text:
        text = re.sub("\0(\\d+)\0", lambda m: kept[int(m.group(1))], text)
    return text


def picture(path, text):
    """A picture of the repository, which is copied beside the pages."""
    PICTURES.append(path)
    return '<img src="%s" alt="%s">' % (os.path.basename(path), html.escape(text))


def page_of(target):
    """A link between Markdown files of the repository as one between pages."""
    target = re.sub(r"^tools/docs/([a-z]+)\.md$", r"\1.html", target)
    return {"FORMAT.md": "format.html", "../src/FORMAT.md": "format.html",
            "src/FORMAT.md": "format.html", "tests/README.md": "tests.html"}.get(target, target)


def anchor(title):
    return re.sub(r"[^\w]+", "-", title.lower()).strip("-")


def table(lines):
    rows = [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in lines]
    out = ["<table>"]
    for number, row in enumerate(rows):
        if number == 1:
            continue
        tag = "th" if number == 0 else "td"
        out.append("<tr>%s</tr>" % "".join("<%s>%s</%s>" % (tag, inline(c), tag) for c in row))
    return "\n".join(out + ["</table>"])


def markdown(text):
    """HTML of headings, paragraphs, lists, tables, code, and the @ lines of the guide."""
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
        elif line.startswith("@"):
            out.append(included(*line[1:].split()))
        elif line.strip():
            while k < len(lines) and lines[k].strip() and not re.match(r"[#|@]|- |```", lines[k]):
                k += 1
            out.append("<p>%s</p>" % inline(" ".join(lines[start:k])))
    return "\n".join(out)


def examples():
    folder = os.path.join(ROOT, "tools/examples")
    return sorted(name[:-2] for name in os.listdir(folder) if name.endswith(".c"))


def included(kind, name=None):
    """@file PATH, @example NAME, @examples: source code in the page."""
    if kind == "examples":
        return "\n".join('<h3 id="example-%s">%s</h3>%s' % (e, e, included("example", e))
                         for e in examples())
    path = "tools/examples/%s.c" % name if kind == "example" else name
    return "<pre>%s</pre>" % html.escape(read(path))


# ---- pages ----

def link_names(body, names):
    """Names of the API as links, outside of tags, links and headings."""
    known = set(names)
    pieces = re.split(r"(<a .*?</a>|<h[1-6].*?</h[1-6]>|<[^>]*>)", body, flags=re.S)
    for k in range(0, len(pieces), 2):
        pieces[k] = re.sub(r"\b(?:sl|SL)_\w+", lambda m: '<a href="api.html#%s">%s</a>' % (
            m.group(0), m.group(0)) if m.group(0) in known else m.group(0), pieces[k])
    return "".join(pieces)


def link_chapters(body):
    """Names of chapters in comments as links."""
    return re.sub(r"tools/docs/([a-z]+)\.md", r'<a href="\1.html">tools/docs/\1.md</a>', body)


def section(text, title):
    """One section of a Markdown file, as a page."""
    match = re.search(r"^## %s\n(.*?)(?=^## |\Z)" % title, text, re.M | re.S)
    return "# %s\n%s" % (title, match.group(1))


def check_links(pages):
    ids = {name: set(re.findall(r'id="([^"]+)"', body)) for name, body in pages.items()}
    for name, body in pages.items():
        for target in re.findall(r'href="([^"]+)"', body):
            if target.startswith("http"):
                continue
            page, _, part = target.partition("#")
            page = page[:-5] if page.endswith(".html") else page or name
            if page not in ids or (part and part not in ids[page]):
                PROBLEMS.append("%s.html has a link to %s" % (name, target))


def main():
    output = sys.argv[1]
    os.makedirs(output, exist_ok=True)
    api, names = api_page(read("src/sparse_local.in.h"))
    pages = {"index": markdown(read("tools/docs/guide.md")), "api": api,
             "format": markdown(read("src/FORMAT.md")), "tests": markdown(read("tests/README.md")),
             "platforms": markdown(section(read("README.md"), "Platforms")),
             "changelog": markdown(read("CHANGELOG.md"))}
    for name, _ in CHAPTERS:
        pages[name] = markdown(read("tools/docs/%s.md" % name))
    for name in pages:
        pages[name] = link_names(pages[name], names)
    pages["api"] = link_chapters(pages["api"])
    check_links(pages)
    guide = read("tools/docs/guide.md")
    for name in examples():
        if "@" + name not in guide:
            PROBLEMS.append("the guide does not mention the example %s" % name)
    written = [("guide", guide), ("intro.h", read("src/public/intro.h"))]
    written += [(name, read("tools/docs/%s.md" % name)) for name, _ in CHAPTERS]
    for page, text in written:
        for name in sorted(set(re.findall(r"\bsl_\w+\b", text)) - set(names)):
            PROBLEMS.append("%s mentions %s, which is not public" % (page, name))
    rows = re.findall(r"^ \*  .*?\b(sl_\w+).*? (\w+\.h)", read("src/public/intro.h"), re.M)
    for name, file in rows:
        if not re.search(r"\b%s\(" % name, read("src/public/" + file)):
            PROBLEMS.append("intro.h: %s is not in %s" % (name, file))
    nav = "<nav>sparse_local.h: %s</nav>" % " &middot; ".join(
        '<a href="%s.html">%s</a>' % page for page in PAGES)
    for name, title in PAGES:
        with open(os.path.join(output, name + ".html"), "w", encoding="utf-8") as file:
            file.write('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
                       "<title>sparse_local.h: %s</title>\n<style>%s</style></head>\n<body>%s\n%s\n"
                       "</body></html>\n" % (title, STYLE, nav, pages[name]))
    for path in PICTURES:
        shutil.copy(os.path.join(ROOT, path), output)
    print("%d pages, %d names of the API, %d examples in %s" % (len(pages), len(names),
                                                               len(examples()), output))
    for problem in PROBLEMS:
        print("manual.py: " + problem, file=sys.stderr)
    return 1 if PROBLEMS else 0


sys.exit(main())
