"""markdown.py: HTML of Markdown, as far as the texts of the manual use it

`page` is what the texts ask of the manual: link(target) gives the address of a link, or None if it
leads to no page, and resolved(target) its path in the repository; picture(target) gives the address
of a picture; shown(target) the text that a link in a line of its own shows, or None.
"""
import html
import re


def anchor(title):
    return re.sub(r"[^\w]+", "-", title.lower()).strip("-")


def link(page, text, target):
    address = page.link(target)
    if address:
        return '<a href="%s">%s</a>' % (address, html.escape(text))
    path = page.resolved(target)
    return html.escape(text if text in path else "%s (%s)" % (text, path))


def inline(page, text):
    """Code, links and bold in one line."""
    kept = []

    def keep(markup):
        kept.append(markup)
        return "\0%d\0" % (len(kept) - 1)

    text = re.sub(r"`([^`]+)`", lambda m: keep("<code>%s</code>" % html.escape(m.group(1))), text)
    text = re.sub(r"!\[([^\]]*)\]\(([^)]+)\)", lambda m: keep('<img src="%s" alt="%s">' % (
        page.picture(m.group(2)), html.escape(m.group(1)))), text)
    text = re.sub(r"\[([^\]]+)\]\(([^)\s]+)\)",
                  lambda m: keep(link(page, m.group(1), m.group(2))), text)
    text = re.sub(r"\*\*([^*]+)\*\*", r"<b>\1</b>", html.escape(text, quote=False))
    while "\0" in text:
        text = re.sub("\0(\\d+)\0", lambda m: kept[int(m.group(1))], text)
    return text


def table(page, lines):
    rows = [[cell.strip().replace(r"\|", "|")
             for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))] for line in lines]
    out = ["<table>"]
    for number, row in enumerate(rows):
        if number != 1:
            tag = "th" if number == 0 else "td"
            cells = ("<%s>%s</%s>" % (tag, inline(page, c), tag) for c in row)
            out.append("<tr>%s</tr>" % "".join(cells))
    return "\n".join(out + ["</table>"])


def items(page, lines, kind):
    texts = re.split(r"\n(?:- |\d+\. )", "\n" + "\n".join(lines))[1:]
    return "<%s>%s</%s>" % (kind, "".join("<li>%s</li>" % inline(page, " ".join(text.split()))
                                          for text in texts), kind)


def block_end(lines, k):
    """The line after the block that begins in line k, which is not code or a heading."""
    line = lines[k]
    if line.startswith("|"):
        belongs = lambda text: text.startswith("|")
    elif re.match(r"- |\d+\. ", line):
        belongs = lambda text: re.match(r"- |\d+\. |  ", text)
    elif line.startswith("    "):
        belongs = lambda text: text.startswith("    ") or not text.strip()
    else:
        belongs = lambda text: text.strip() and not re.match(r"[#|]|- |```", text)
    k += 1
    while k < len(lines) and belongs(lines[k]):
        k += 1
    return k


def block(page, lines):
    first = lines[0]
    if first.startswith("|"):
        return table(page, lines)
    if re.match(r"- |\d+\. ", first):
        return items(page, lines, "ul" if first.startswith("-") else "ol")
    if first.startswith("    "):
        return "<pre>%s</pre>" % html.escape("\n".join(text[4:] for text in lines).rstrip())
    return "<p>%s</p>" % inline(page, " ".join(lines))


def markdown(page, text):
    """HTML of headings, paragraphs, lists, tables, code; a link in a line of its own may become
    what it leads to."""
    out, lines, k = [], re.sub(r"<!--.*?-->", "", text, flags=re.S).split("\n"), 0
    while k < len(lines):
        line, start = lines[k], k
        alone = re.match(r"\[[^\]]+\]\(([^)\s]+)\)$", line)
        shown = page.shown(alone.group(1)) if alone else None
        k += 1
        if line.startswith("```"):
            k = lines.index("```", k) + 1
            out.append("<pre>%s</pre>" % html.escape("\n".join(lines[start + 1:k - 1])))
        elif line.startswith("#"):
            level, title = len(line) - len(line.lstrip("#")), line.lstrip("# ")
            out.append('<h%d id="%s">%s</h%d>' % (level, anchor(title), inline(page, title),
                                                  level))
        elif shown:
            out.append(shown)
        elif line.strip():
            k = block_end(lines, start)
            out.append(block(page, lines[start:k]))
    return "\n".join(out)
