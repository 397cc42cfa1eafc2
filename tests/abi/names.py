"""names.py: the public names of the adapters, Python, JavaScript and Octave, and what has become of
those of a release (make abi)

    tests/abi/names.py ROOT              prints them, a line each, sorted
    tests/abi/names.py ROOT RECORD...    compares each record with them; prints what is broken

The lines:

    python sparse_local.Factor.plan(self, bset, xset, *, region=)      = : may be left out
    python sparse_local.StaleError: Error, Exception, RuntimeError, StateError        all its bases
    javascript AnalysisOptions.triangle: auto, lower, upper             words that are accepted
    octave sparse_local.refine returns (x=, e=)
    javascript Plan.nb                                      an attribute, a class, a type, a macro

The fields of an interface of JavaScript that has optional ones are parameters by name, those of a
struct of C parameters in their order. Calls that the header marks EXPERIMENTAL are left out. Python
is read by ast, the others by the form that their files have here. Not recorded: types, but for C
and C++; attributes in modules of Python without a stub; fields and template parameters of C++.
"""
import ast
import os
import re
import sys

PYTHON = "tools/python/sparse_local/"
MODULES = ["__init__.pyi", "gradients.pyi", "linalg.pyi", "mesh.pyi", "autograd.py", "qdldl.py",
           "sksparse/cholmod.py", "sksparse05/cholmod.py", "sksparse05/amd.py"]
C_HEADERS = ["sparse_local_mesh.h", "sparse_local_symmetric.h", "sparse_local_qdldl.h"]
CXX_HEADERS = ["sparse_local.hpp", "sparse_local_eigen.hpp"]
CXX_INTERNAL = ["of_complex", "real_parts"]  # public for other classes of the same file
OCTAVE = ["sparse_local.m", "sparse_local_plan.m", "sparse_local_constraints.m",
          "sparse_local_make.m", "gptoolbox/min_quad_with_fixed.m"]


def read(root, path):
    with open(os.path.join(root, path), encoding="utf-8") as file:
        return file.read()


def split(text, separator=","):
    """The parts of a list, without those of lists inside."""
    parts, depth, part = [], 0, ""
    for at, c in enumerate(text):
        if c == separator and depth == 0:
            parts.append(part)
            part = ""
            continue
        if c in "([{<" or c in ")]}" or c == ">" and text[at - 1] not in "=-":
            depth += 1 if c in "([{<" else -1
        part += c
    return [part.strip() for part in parts + [part] if part.strip()]


def inside(text, start):
    """What is in the bracket that opens at text[start]."""
    depth = 0
    for at in range(start, len(text)):
        depth += (text[at] in "([{") - (text[at] in ")]}")
        if depth == 0:
            return text[start + 1:at]
    raise ValueError("a bracket that stays open: " + text[start:start + 60])


def one_line(text):
    return " ".join(text.split())


# ---- Python ----

class Module:
    """The names of one file, by ast."""

    def __init__(self, root, path, prefix):
        self.root, self.path, self.prefix, self.lines = root, path, prefix, []
        self.tree = ast.parse(read(root, PYTHON + path))
        self.nodes, self.imported = {}, {}
        for node in self.tree.body:
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                self.nodes[node.name] = node
            elif isinstance(node, ast.ImportFrom) and node.level > 0:
                for name in node.names:
                    self.imported[name.asname or name.name] = (node, name.name)
            elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
                self.nodes[node.targets[0].id] = node
        self.public = {name for name, node in self.nodes.items()
                       if isinstance(node, ast.ClassDef) and not name.startswith("_")}
        if "__all__" in self.nodes:
            self.public |= set(ast.literal_eval(self.nodes["__all__"].value))

    def found(self, name):
        """The module that defines a name, and its node there."""
        if name in self.nodes:
            return self, self.nodes[name]
        if name not in self.imported:
            return None, None
        node, name = self.imported[name]
        folder = os.path.dirname(self.path)
        for _ in range(node.level - 1):
            folder = os.path.dirname(folder)
        path = os.path.join(folder, *(node.module or "__init__").split(".")) + ".py"
        if not os.path.exists(os.path.join(self.root, PYTHON, path)):
            return None, None
        return Module(self.root, path, self.prefix).found(name)

    def bases(self, node):
        """The names of the bases of a class, and of theirs."""
        names = set()
        for base in node.bases:
            names.add(ast.unparse(base))
            where, above = self.found(ast.unparse(base))
            if isinstance(above, ast.ClassDef):
                names |= where.bases(above)
        return names

    def words(self, name, annotation):
        """The strings that an annotation accepts."""
        nodes = list(ast.walk(annotation or ast.Constant(None)))
        for node in nodes:  # _Triangle = Literal[...]
            alias = self.nodes.get(getattr(node, "id", None))
            if isinstance(alias, ast.Assign):
                nodes += ast.walk(alias.value)
        words = {constant.value for node in nodes if isinstance(node, ast.Subscript) and
                 ast.unparse(node.value) == "Literal" for constant in ast.walk(node.slice)
                 if isinstance(constant, ast.Constant)}
        if words:
            self.lines.append("%s: %s" % (name, ", ".join(sorted(words))))

    def fields(self, node):
        return [field.target.id for field in node.body if isinstance(field, ast.AnnAssign)]

    def function(self, name, node, is_constructor=False):
        a = node.args
        plain = a.posonlyargs + a.args
        required = len(plain) - len(a.defaults)
        parts = [arg.arg + "=" * (k >= required) for k, arg in enumerate(plain)][is_constructor:]
        if a.vararg or a.kwonlyargs:
            parts.append("*" + (a.vararg.arg if a.vararg else ""))
        parts += [arg.arg + "=" * (default is not None)
                  for arg, default in zip(a.kwonlyargs, a.kw_defaults)]
        if a.kwarg:
            parts.append("**" + a.kwarg.arg)
        self.lines.append("%s(%s)" % (name, ", ".join(parts)))
        for arg in plain + a.kwonlyargs:
            self.words("%s %s" % (name, arg.arg), arg.annotation)
        result = self.nodes.get(getattr(node.returns, "id", None))
        if isinstance(result, ast.ClassDef) and result.name.startswith("_"):
            self.lines.append("%s returns (%s)" % (name, ", ".join(self.fields(result))))

    def kind(self, name, node):
        bases = self.bases(node)
        if "NamedTuple" in bases:
            self.lines.append("%s(%s)" % (name, ", ".join(self.fields(node))))
            return
        self.lines.append("%s: %s" % (name, ", ".join(sorted(bases))) if bases else name)
        for member in node.body:
            if isinstance(member, ast.AnnAssign) and not member.target.id.startswith("_"):
                self.lines.append(name + "." + member.target.id)
            if not isinstance(member, ast.FunctionDef):
                continue
            marks = [ast.unparse(mark) for mark in member.decorator_list]
            if member.name == "__init__":
                if "Made by" not in (ast.get_docstring(node) or ""):  # Made by analyze
                    self.function(name, member, True)
            elif member.name.startswith("_") and not member.name.startswith("__"):
                continue
            elif "property" in marks:
                self.lines.append(name + "." + member.name)
            else:
                self.function(name + "." + member.name, member)

    def all(self):
        for name in self.public:
            where, node = self.found(name)
            if node is None:
                raise ValueError("%s: %s is in __all__ only" % (self.path, name))
            where = where if where is self else Module(where.root, where.path, self.prefix)
            called = self.prefix + name
            if isinstance(node, ast.ClassDef):
                where.kind(called, node)
            elif isinstance(node, ast.FunctionDef):
                where.function(called, node)
            else:
                where.lines.append(called)
            if where is not self:
                self.lines += where.lines
        return self.lines


def python(root):
    lines = []
    for path in MODULES:
        module = re.sub(r"\.pyi?$", "", path).replace("/", ".")
        prefix = "sparse_local." + ("" if module == "__init__" else module + ".")
        lines += Module(root, path, prefix).all()
    return lines


# ---- JavaScript ----

def js_object(name, body, lines):
    """A type whose fields are parameters by name: {p: Numbers, x?: Numbers}."""
    parts = []
    for field in split(body.replace(",", ";"), ";"):
        key = field.replace("readonly ", "").split(":")[0].strip()
        parts.append(key.rstrip("?") + "=" * key.endswith("?"))
    lines.append("%s(*, %s)" % (name, ", ".join(parts)))


def js_words(name, kind, lines):
    words = re.findall('"([^"]*)"', kind)
    if words:
        lines.append("%s: %s" % (name, ", ".join(sorted(words))))


def js_function(name, arguments, lines):
    parts = []
    for argument in split(arguments):
        key, kind = (part.strip() for part in argument.split(":", 1))
        parts.append(key.rstrip("?") + "=" * key.endswith("?"))
        js_words(name + " " + key.rstrip("?"), kind, lines)
        if kind.startswith("{"):
            js_object(name + " " + key.rstrip("?"), inside(kind, 0), lines)
    lines.append("%s(%s)" % (name, ", ".join(parts)))


def javascript(root):
    text = one_line(re.sub(r"/\*.*?\*/", "", read(root, "tools/web/sparse_local.d.ts"), flags=re.S))
    lines = []
    for found in re.finditer(r"export (class|interface) (\w+)([^{]*)\{", text):
        kind, name, bases = found.groups()
        body = inside(text, found.end() - 1)
        base = re.search(r"extends (\w+)", re.sub(r"<.*?>", "", bases))
        lines.append("%s: %s" % (name, base.group(1)) if base else name)
        if kind == "interface" and "?:" in body:
            js_object(name, body, lines)
        for member in split(body, ";"):
            member = member.replace("readonly ", "")
            method = re.match(r"([\w.\[\]]+)(?:<[^(]*>)?\(", member)
            if member.startswith("private "):
                continue
            if method:
                js_function(name + "." + method.group(1), inside(member, method.end() - 1), lines)
            else:
                key, values = member.split(":", 1)
                lines.append(name + "." + key.strip().rstrip("?"))
                js_words(name + "." + key.strip().rstrip("?"), values, lines)
    for found in re.finditer(r"export (function|type|default) (\w+)(\()?", text):
        if found.group(1) == "function":
            js_function(found.group(2), inside(text, found.end() - 1), lines)
        else:
            lines.append("default" if found.group(1) == "default" else found.group(2))
    return lines


# ---- Octave ----

def octave_function(prefix, text, lines):
    head = re.match(r" *function (?:(.*?) = )?(\w+)(?:\((.*?)\))?", text)
    results, name, arguments = head.groups()
    counts = [int(n) for n in re.findall(r"nargin < (\d+)", text)]
    counts += [int(n) + 1 for n in re.findall(r"nargin > (\d+)", text)]
    parts = []
    for k, part in enumerate(split(arguments or ""), 1):
        parts.append("*" + part if part == "varargin" else part + "=" * (k >= min(counts or [99])))
    lines.append("%s(%s)" % (prefix + name, ", ".join(parts)))
    if results and results != "this":
        lines.append("%s returns (%s)" % (prefix + name, ", ".join(
            part + "=" for part in split(results.strip("[]")))))


def octave(root):
    lines = []
    for path in OCTAVE:
        text = read(root, "tools/octave/" + path)
        own = os.path.basename(path)[:-2]
        if not text.startswith("classdef"):
            octave_function("", re.split(r"\nfunction ", text)[0], lines)
            continue
        lines.append("%s: %s" % (own, re.match(r"classdef \w+ < (\w+)", text).group(1)))
        for kind, marks, body in re.findall(r"^    (properties|methods)(.*?)\n(.*?)^    end$", text,
                                            re.S | re.M):
            if "Hidden" in marks or "private" in marks and kind == "methods":
                continue
            if kind == "properties":
                lines += [own + "." + name for name in re.findall(r"^        (\w+)", body, re.M)]
                continue
            for function in re.split(r"^(?=        function )", body, flags=re.M)[1:]:
                made = re.search(r"function this = ", function)
                octave_function("" if made else own + ".", function, lines)
    options = read(root, "tools/octave/mex_options.h")
    lines.append("sparse_local options: " + ", ".join(
        sorted(set(re.findall(r'strcmp\(name, "(\w+)"\)', options)))))
    for name, body in re.findall(r'strcmp\(name, "(\w+)"\) == 0\) \{(.*?)\n    \}', options, re.S):
        for words in re.findall(r'word_in\(name, value, "(.*?)"', body):
            lines.append("sparse_local option %s: %s" % (name, ", ".join(sorted(words.split("|")))))
    errors = re.search(r"ids\[\] = \{(.*?)\}", read(root, "tools/octave/mex_errors.h"), re.S)
    errors = re.findall(r'"(\w+)"', errors.group(1))
    lines.append("sparse_local errors: " + ", ".join(sorted(errors)))
    return lines


# ---- C and C++ ----

def without_comments(text):
    return re.sub(r"//[^\n]*", "", re.sub(r"/\*.*?\*/", "", text, flags=re.S))


def parameter(text):
    """A parameter of C or C++, = in the place of its default."""
    text = one_line(text)
    return text.split(" = ")[0] + "=" * (" = " in text)


def c(root):
    """What has a contract, which begins with two stars, and all of QDLDL."""
    lines = []
    for path in C_HEADERS:
        text = re.split(r"\n#ifdef \w+_IMPLEMENTATION", read(root, "tools/adapters/" + path))[0]
        lines += ["typedef " + kind for kind in re.findall(r"^typedef ([^{};]+);", text, re.M)]
        lines += re.findall(r"^#define (QDLDL_\w+)", text, re.M)
        for found in re.finditer(r"^/\*\*.*?\*/\n", text, re.S | re.M):
            rest = text[found.end():]
            if rest.startswith("#define"):
                lines.append(rest.split()[1])
                continue
            head = one_line(rest[:re.search("[;{]", rest).start()]).replace("static inline ", "")
            if head.startswith("typedef"):
                body = inside(rest, rest.index("{")).split("/* what follows is private")[0]
                ends = "," if " enum " in head else ";"
                fields = [one_line(part).replace(",", "=,") + "="
                          for part in without_comments(body).split(ends) if part.strip()]
                lines.append("%s(%s)" % (head[8:], ", ".join(fields)))
            else:
                lines.append(re.sub(r"\*\*?(?=\w+\()", "* ", head))
    return lines


def cxx_class(name, body, is_public, lines):
    """The public calls of a class, which begin at the first indent."""
    body = body.split("\n")
    for k, line in enumerate(body):
        mark = re.match(r" *(public|private|protected):$", line)
        if mark:
            is_public = mark.group(1) == "public"
        text = "\n".join(body[k:])
        call = re.match(r"    (?! |typedef|using|enum|static_assert|struct)"
                        r"(?:template <[^(]*?>\s+)?[^(;{}]*?"
                        r"(~?\w+|operator[^\w(]+|operator \w+)\(", text)
        if not call or not is_public or call.group(1).startswith(("_", "~")) or \
                call.group(1) in CXX_INTERNAL:
            continue
        arguments = inside(text, call.end() - 1)
        after = text[call.end() + len(arguments) + 1:].split("\n", 1)[0]
        if "= delete" not in after:
            lines.append("%s::%s(%s)" % (name, call.group(1),
                                         ", ".join(parameter(a) for a in split(arguments))))


def cxx(root):
    lines = []
    for path in CXX_HEADERS:
        text = read(root, "tools/adapters/" + path)
        text = re.sub(r"^namespace (internal|detail) \{.*?^\} // namespace \1$", "", text,
                      flags=re.S | re.M)
        text = without_comments(text)
        for found in re.finditer(r"^(?:template <[^;{]*?>\s+)?(class|struct) (\w+)([^;{]*)\{$",
                                 text, re.M):
            kind, name, bases = found.groups()
            bases = [base.split("<")[0].split()[-1] for base in split(bases.strip().lstrip(":"))
                     if "protected" not in base]
            lines.append("sl::%s: %s" % (name, ", ".join(bases)) if bases else "sl::" + name)
            cxx_class("sl::" + name, inside(text, found.end() - 1), kind == "struct", lines)
    return lines


# ---- all of them ----

def experimental(root):
    """The last words of the calls that may change in any version: certify, solve_bounded."""
    contracts = re.findall(r"^/\*\*[^\n]*EXPERIMENTAL.*?\*/\n(.*?;)", read(root, "sparse_local.h"),
                           re.S | re.M)
    return {name for text in contracts for name in re.findall(r"sl_[a-z]+_(\w+)\(", text)}


def names(root):
    languages = {"c": c, "c++": cxx, "javascript": javascript, "octave": octave, "python": python}
    lines = [name + " " + line for name, language in languages.items() for line in language(root)]
    left_out = experimental(root)
    return sorted({line for line in lines
                   if not left_out & set(re.split(r"[.: (]+", line.split("(")[0]))})


# ---- a record and the present ----

def described(line):
    """(what it is of, "(" or ":" or "", its list)"""
    if line.endswith(")"):
        name = line[:line.index("(")]
        return name, "(", split(line[len(name) + 1:-1])
    name, colon, words = line.partition(": ")
    return name, colon.strip(), words.split(", ") if colon else []


def by_position(parts):
    """{position: name}, {name: may be left out} and {stars} of parameters."""
    placed, optional, stars, is_keyword = [], {}, set(), False
    for part in parts:
        if part.startswith("*"):
            is_keyword = True
            stars |= {"**" if part.startswith("**") else "*args"} if part != "*" else set()
            continue
        name = part.rstrip("=")
        optional[name] = part.endswith("=")
        if not is_keyword:
            placed.append(name)
    return placed, optional, stars


def changed(old, new):
    """What a caller of the one finds broken in the other, or None."""
    placed, optional, stars = by_position(old)
    new_placed, new_optional, new_stars = by_position(new)
    for k, name in enumerate(placed):
        if k >= len(new_placed) or new_placed[k] != name:
            return "parameter %d was %s" % (k + 1, name)
    if "*args" in stars and len(new_placed) > len(placed):
        return "%s is new before the others" % new_placed[len(placed)]
    for name in optional:
        if name not in new_optional:
            return "the keyword %s is gone" % name
        if optional[name] and not new_optional[name]:
            return "%s can no longer be left out" % name
    for name in new_optional:
        if name not in optional and not new_optional[name]:
            return "%s is new and cannot be left out" % name
    for star in stars - new_stars:
        return "%s is gone" % star
    return None


def broken(record, present):
    """A line for each recorded name that has changed."""
    there = {}
    for line in present:
        name, kind, parts = described(line)
        there.setdefault((name, kind), []).append(parts)
    bare = {name for name, _ in there}
    for line in record:
        name, kind, parts = described(line)
        others = there.get((name, kind))
        if others is None:
            if not kind and (name, ":") in there: # a class that has a base now
                continue
            yield "%s: %s" % (line, "is something else now" if name in bare else "is gone")
        elif kind == ":":
            gone = set(parts) - set(others[0])
            if gone:
                yield "%s: without %s" % (name, ", ".join(sorted(gone)))
        elif kind == "(":
            whys = [changed(parts, other) for other in others]
            if None not in whys:
                now = ["(%s)" % ", ".join(other) for other in others]
                yield "%s: %s; now %s" % (line, whys[-1], " or ".join(now))


def main():
    root, records = sys.argv[1], sys.argv[2:]
    present = names(root)
    if not records:
        print("\n".join(present))
    failed = 0
    for path in records:
        with open(path, encoding="utf-8") as file:
            lines = [line for line in file.read().splitlines() if not line.startswith("#")]
            for line in broken(lines, present):
                print("%s: %s" % (os.path.basename(path), line))
                failed = 1
    return failed


if __name__ == "__main__":
    sys.exit(main())
