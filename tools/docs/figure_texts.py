"""figure_texts.py: the text of each figure, made of the rows of its file

TEXTS has a function for each (NAME, FIGURE). Times have three digits, ratios two or one decimal.
"""
import math

LETTERS = {
    "CHOLMOD updown": "U", "CHOLMOD rowdel/rowadd": "R", "CHOLMOD METIS": "M",
    "CHOLMOD defaults": "C", "CHOLMOD supernodal": "S", "CHOLMOD simplicial": "s",
    "CHOLMOD solve2 Bset": "B", "CHOLMOD full solve": "F", "Eigen simplicial": "E",
    "Eigen defaults": "A",
}
# Of README.md: systems, and steps with the names that they have there.
SHORT_SYSTEMS = ["bunny", "grid 316x316", "grid 1000x1000", "volume 60x60x60"]
SHORT_STEPS = {
    "order + analyze + factor": "order, analyze, factor, by default: for many local solves",
    "the same, for one factor": "the same for one factor (`options.purpose`)",
    "refactor": "refactor",
    "full solve, 1 rhs": "full solve, 1 right-hand side",
    "one vertex, solve on a plan": "one vertex, on a plan",
    "patch of 1000, 2 rhs, solve on a plan": "patch of 1000, 2 right-hand sides, on a plan",
}
MOST_LOAD = 3  # processes, of a run of two threads
KKT_CLASSES = 7  # those of OSQP, which come first


def digits(x):
    """Three significant digits, of a number up to 1000."""
    return "%.*f" % (2 if x < 9.995 else 1 if x < 99.95 else 0, x)


def time_text(seconds):
    for unit, size in (("us", 1e-6), ("ms", 1e-3)):
        if seconds / size < 999.5:
            return "%s %s" % (digits(seconds / size), unit)
    return "%s s" % digits(seconds)


def ratio_text(ratio):
    return "%.*f" % (1 if ratio >= 0.995 else 2, ratio)


def count_text(n):
    return "%dk" % (int(n) / 1e3 + 0.5) if int(n) < 1e6 else "%.1fM" % (int(n) / 1e6)


def rows_text(head, rows, rule=None):
    """A table, in lines of its own."""
    lines = ["| %s |" % " | ".join(cells) for cells in [head] + rows]
    lines[0] = lines[0].replace("|  |", "| |")
    lines.insert(1, "|" + (rule or "---|" * len(head)))
    return "\n" + "\n".join(lines) + "\n"


def run(file):
    keys = file.keys
    return "%s, %s, %s, %s, commit %s" % (keys["date"], keys["machine"], keys["instruction set"],
                                          keys["compiler"], keys["commit"])


def values(file, key):
    return list(dict.fromkeys(row[key] for row in file.rows))


def titles(file, systems):
    return [""] + ["%s, n %s" % (name, count_text(next(
        row["n"] for row in file.rows if row["system"] == name))) for name in systems]


# ---- peers ----

def time_and_ratio(row):
    text = time_text(float(row["seconds"]))
    if row["peer"]:
        text += "; %sx" % ratio_text(float(row["peer_seconds"]) / float(row["seconds"]))
    return text


def peer_cell(row):
    text = time_and_ratio(row)
    if row["peer"]:
        text += " " + LETTERS[row["peer"]]
    if float(row["limit"]) > 0:
        text += "; %.0f%%" % (100 * float(row["limit"]))
    return text


def peers_table(file):
    systems = values(file, "system")
    return rows_text(titles(file, systems), [
        [step] + [peer_cell(file.where(system=name, step=step)) for name in systems]
        for step in values(file, "step")])


def short_table(file):
    return rows_text(titles(file, SHORT_SYSTEMS), [
        [label] + [time_and_ratio(file.where(system=name, step=step)) for name in SHORT_SYSTEMS]
        for step, label in SHORT_STEPS.items()])


def vertex_share(file):
    def seconds(step):
        return float(file.where(system="grid 1000x1000", step=step)["seconds"])
    return "1/%.0f" % (seconds("full solve, 1 rhs") / seconds("one vertex, solve on a plan"))


def core(file):
    return file.keys["one core"]


# ---- threads, kinds, small systems ----

def threads_table(file):
    systems = values(file, "system")

    def cell(call, name):
        row = file.where(system=name, call=call)
        return "%.1f" % (float(row["one_thread"]) / float(row["two_threads"]))
    return rows_text([""] + systems, [[call] + [cell(call, name) for name in systems]
                                      for call in values(file, "call")])


def threads_load(file):
    """A warning if two threads had no two cores: alone they have a load of up to two."""
    load = float(file.keys["load"].replace("unknown", "0"))
    return "" if load < MOST_LOAD else (
        " **Other programs ran at the same time (load %.0f): these rows are not those of two free "
        "cores.**" % load)


def mean_and_worst(rows, key):
    numbers = [float(row[key]) for row in rows]
    mean = math.exp(sum(math.log(number) for number in numbers) / len(numbers))
    return "%.2f (%.2f)" % (mean, (max if key in ("nnz_l", "path") else min)(numbers))


def kinds_table(file):
    columns = {"ratio": "order + analyze + factor", "ratio_one": "the same, for one factor",
               "ratio_order": "order", "ratio_order_one": "order, for one factor",
               "nnz_l": "nnz(L)", "path": "path weight"}
    lines = []
    for group in values(file, "group") + ["all"]:
        rows = [row for row in file.rows if group in (row["group"], "all")]
        lines.append(["%s, %d" % (group, len(rows))] +
                     [mean_and_worst(rows, key) for key in columns])
    return rows_text(["kinds of systems"] + list(columns.values()), lines)


def slower_kinds(file):
    """Systems on which the fastest peer is faster, with its time as a multiple of ours."""
    lines = ["Of %d systems of many kinds the fastest of them is faster at these, with its time as "
             "a multiple of ours:" % len(file.rows), ""]
    for key, label in (("ratio", "by default"), ("ratio_one", "for one factor")):
        rows = sorted((row for row in file.rows if float(row[key]) < 0.995),
                      key=lambda row: float(row[key]))
        lines.append("- %s: %s." % (label, "; ".join(
            "%s %.2fx" % (row["system"], float(row[key])) for row in rows) or "none"))
    return "\n" + "\n".join(lines) + "\n"


def small_table(file):
    lines = []
    for row in file.rows:
        peer, letter = float(row["peer_s"]), row["peer"]
        cells = ["{:,}".format(int(row["n"]))]
        for key in ("ours_s", "one_s"):
            cells += [time_text(float(row[key])),
                      "%sx %s" % (ratio_text(peer / float(row[key])), letter)]
        lines.append(cells + [time_text(float(row["vertex_s"]))])
    return rows_text(["rows", "by default", "peer", "for one factor", "peer",
                      "local solve at a vertex"], lines, "--:|" * 6)


def slower_small(file):
    """Up to which number of rows a peer is faster by default, and by how much at most."""
    less = [(row["n"], float(row["ours_s"]) - float(row["peer_s"])) for row in file.rows]
    less = [(n, seconds) for n, seconds in less if seconds > 0]
    if not less:
        return "but at none that was measured"
    return "up to %s rows, by at most %s" % (
        less[-1][0], time_text(max(seconds for _, seconds in less)))


# ---- quadratic programs, eigenvectors ----

def kkt_table(file):
    lines = []
    for name in values(file, "class")[:KKT_CLASSES]:
        cells = [name]
        for step in ("refactor", "solve"):
            for size in ("small", "larger"):
                row = file.where(**{"class": name, "size": size})
                cells.append("%.2f" % (float(row[step]) / float(row[step + "_ldl"])))
        lines.append(cells)
    return rows_text(["class", "refactor, small", "refactor, larger", "solve, small",
                      "solve, larger"], lines, "---|" + "--:|" * 4)


def osqp_table(file):
    """Ratios of runs that take the same number of steps; a dash for others."""
    def ratio(row, *keys):
        same = all(row["ours_" + key] == row["qdldl_" + key] for key in ("steps", "changes"))
        ours, theirs = (sum(float(row[who + key]) for key in keys) for who in ("ours_", "qdldl_"))
        return "%.2f" % (ours / theirs) if same or keys == ("setup",) else "-"
    lines = []
    for name in values(file, "class"):
        rows = [row for row in file.rows if row["class"] == name]
        lines.append([name, "; ".join("{:,}".format(int(row["rows"])) for row in rows)] +
                     ["; ".join(ratio(row, *keys) for row in rows)
                      for keys in (("setup",), ("solve",), ("setup", "solve"))])
    return rows_text(["class", "rows of the KKT system", "setup", "solve", "all"], lines)


def eigen_table(file):
    lines = []
    for row in file.rows:
        cells = ["%s eigenpairs" % row["pairs"] if row["pairs"] != "0" else "refactor + diagonal"]
        cells += [time_text(float(row[key])) for key in ("adf", "signatures")]
        adf, short, long = ("%.0f %%" % (100 * float(row[key]))
                            for key in ("adf_median", "short_median", "long_median"))
        exact = row["pairs"] == "0"
        lines.append(cells + (["exact"] * 2 if exact else [adf, "%s, %s" % (short, long)]))
    return rows_text(["", "time: auto-diffusion", "time: signatures", "error: auto-diffusion",
                      "error: signatures"], lines)


# ---- the compiler ----

def size(what):
    return lambda file: "%.0f kB" % (float(file.where(what=what)["object_bytes"]) / 1e3)


def size_less(macro):
    def text(file):
        less = [float(file.where(what=what)["object_bytes"]) for what in ("core", "core " + macro)]
        return "%.0f kB" % ((less[0] - less[1]) / 1e3)
    return text


def development(file):
    seconds = [float(file.where(what=what)["compile_s"])
               for what in ("core -O0 SL_NO_SIMD", "core")]
    return "1/%.0f of the time" % (seconds[1] / seconds[0])


def plain_factor(file):
    ratios = sorted(float(row["plain"]) / float(row["optimized"]) for row in file.rows)
    return "%.1f to %.1f times as long" % (ratios[0], ratios[-1])


# ---- a raster ----

RASTER_STEPS = [("analysis", "order and structure of L"), ("killed factor", "factor, killed"),
                ("factor", "factor, again, saved"), ("dask", "{pairs:,} pairs, Dask"),
                ("mpi", "the same, MPI"), ("map", "checks, currents, picture")]


def bytes_text(text):
    size = float(text) / 1e9
    if not size:
        return ""
    return "%s GB" % digits(size) if size >= 0.1 else "%s MB" % digits(1e3 * size)


def long_text(seconds):
    for unit, size in (("hours", 3600.0), ("minutes", 60.0)):
        if seconds > 3 * size:
            return "%s %s" % (digits(seconds / size), unit)
    return time_text(seconds)


def raster_table(file):
    rows = []
    for step, label in RASTER_STEPS:
        row = file.where(step=step)
        rows.append([label.format(pairs=int(row["pairs"])), long_text(float(row["seconds"])),
                     long_text(float(row["processor_s"])), bytes_text(row["peak"]),
                     bytes_text(row["bytes"])])
    head = ["", "time", "of processors", "in memory", "file"]
    return rows_text(head, rows, "---|--:|--:|--:|--:|")


def pair_seconds(step):
    def seconds(file):
        row = file.where(step=step)
        return float(row["processor_s"]) / int(row["pairs"])
    return seconds


def raster_load(file):
    return " while the machine had other work (load %.0f)" % float(file.keys["load"]) if float(
        file.keys["load"]) > MOST_LOAD else ""


TEXTS = {
    ("peers", "vertex share"): vertex_share,
    ("peers", "short table"): short_table,
    ("peers", "one core"): core,
    ("peers", "table"): peers_table,
    ("peers_harmonic", "table"): peers_table,
    ("two_threads", "table"): threads_table,
    ("two_threads", "load"): threads_load,
    ("peers_kinds", "table"): kinds_table,
    ("peers_kinds", "slower"): slower_kinds,
    ("peers_small", "table"): small_table,
    ("peers_small", "slower"): slower_small,
    ("peers_kkt", "table"): kkt_table,
    ("osqp", "table"): osqp_table,
    ("eigenpairs", "table"): eigen_table,
    ("raster", "load"): raster_load,
    ("raster", "table"): raster_table,
    ("raster", "pair"): lambda file: time_text(pair_seconds("tasks of 1e8 pairs")(file)),
    ("raster", "many"): lambda file: long_text(1e8 * pair_seconds("tasks of 1e8 pairs")(file)),
    ("raster", "random"): lambda file: time_text(pair_seconds("random pairs")(file)),
    ("sizes", "core"): size("core"),
    ("sizes", "all"): size("all"),
    ("sizes", "no singular"): size_less("SL_NO_SINGULAR"),
    ("sizes", "no AVX512"): size_less("SL_NO_AVX512"),
    ("sizes", "no SIMD"): size_less("SL_NO_SIMD"),
    ("sizes", "development"): development,
    ("optimization", "factor"): plain_factor,
}
TEXTS.update({(name, "run"): run for name in {name for name, _ in TEXTS}})
