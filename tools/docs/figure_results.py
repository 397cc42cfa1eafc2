"""figure_results.py: of what the bench writes, the rows and columns that figures are made of

RESULTS has for each file of tools/docs/figures the files that it is made of, the file about the
machine, and a function that makes rows of their texts. Times are in seconds.
"""
import csv

# Steps of peers.csv and their labels in tables. Both kinds of local solves have the same peers:
# cholmod_solve2 finds its reach in every call.
STEPS = {
    "order to factor": "order + analyze + factor",
    "order to factor, one factor": "the same, for one factor",
    "analyze": "analyze, order given",
    "first factor": "first factor",
    "refactor": "refactor",
    "full solve, 1 rhs": "full solve, 1 rhs",
    "full solve, 3 rhs": "full solve, 3 rhs",
    "full solve, 8 rhs": "full solve, 8 rhs",
    "vertex, 1 rhs, solve on a plan": "one vertex, solve on a plan",
    "vertex, 1 rhs, plan + solve": "one vertex, plan + solve",
    "patch 1000, 2 rhs, solve on a plan": "patch of 1000, 2 rhs, solve on a plan",
    "patch 1000, 2 rhs, plan + solve": "patch of 1000, 2 rhs, plan + solve",
    "edge update": "weight of an edge changed",
    "rank-8 update": "8 vertices changed",
    "pin, solve, release": "vertex pinned, solved beside it, released",
}
VARIANTS = ["ours, solve on a plan", "ours, plan + solve", "ours, one factor"]


def table(text):
    return list(csv.DictReader(text.splitlines()))


def step_of(row):
    return row["case"] + (", %s rhs" % row["nrhs"] if row["nrhs"] != "0" else "")


def is_disturbed(row, rows):
    """Whether a peer's ordering and factor, measured once, took more than twice as long as its
    slowest refactorization and all of ours together: another program took the time, or memory."""
    if row["case"] != "order to factor" or row["count"] != "1" or row["method"].startswith("ours"):
        return False
    here = [other for other in rows if other["system"] == row["system"]]
    ours = max(float(other["median_s"]) for other in here
               if other["case"] == row["case"] and other["method"] == "ours")
    again = max([float(other["median_s"]) for other in here if other["case"] == "refactor" and
                 other["method"].split(" ")[0] == row["method"].split(" ")[0]], default=1e99)
    return float(row["median_s"]) > 2 * (ours + again)


def peer_rows(text):
    """For each system and step: our median time, the fastest peer and its time, and the physical
    limit as a share of ours. One thread; no forced instruction set, no region. A disturbed peer is
    left out, which would flatter us."""
    rows = [row for row in table(text) if row["threads"] == "1"]
    for row in [row for row in rows if is_disturbed(row, rows)]:
        print("left out: %s, %s, %s took %s s" % (
            row["system"], row["case"], row["method"], row["median_s"]))
        rows.remove(row)
    best = {}
    for row in rows:
        key, seconds = (row["system"], step_of(row)), float(row["median_s"])
        if not row["method"].startswith("ours") and seconds < best.get(key, (1e99,))[0]:
            best[key] = seconds, row["method"].replace(", once", "")
    found = []
    for row in rows:
        step = step_of(row)
        peer_seconds, peer = best.get((row["system"], step), (0.0, ""))
        if row["method"] in VARIANTS:
            step += row["method"][4:]
        elif row["method"] not in ("ours", "ours, given order"):
            continue
        if step in STEPS:
            found.append({"system": row["system"].replace(".off.gz", ""), "n": row["n"],
                          "step": STEPS[step], "seconds": float(row["median_s"]), "peer": peer,
                          "peer_seconds": peer_seconds, "limit": float(row["limit_share"])})
    has_eight = {row["system"] for row in found if row["step"] == "full solve, 8 rhs"}
    return [row for row in found
            if row["step"] != "full solve, 3 rhs" or row["system"] not in has_eight]


def thread_rows(cold, two_threads):
    """For each system and call the least time of one thread and of two."""
    rows = table(two_threads)
    systems = list(dict.fromkeys(row["system"] for row in rows))
    calls = []
    for row in table(cold):
        if row["case"] == "many solves" and row["method"] in ("order", "together"):
            calls.append((row, "order" if row["method"] == "order"
                          else "order, analyze, factor, solve"))
    for row in rows:
        if row["case"] == "200 vertices":
            calls.append((row, "200 local solves by one call"))
        elif row["case"] != "order, analyze":
            calls.append((row, step_of(row)))
    seconds = {(row["system"], call, row["threads"]): float(row["min_s"]) for row, call in calls}
    return [{"system": system, "call": call, "one_thread": seconds[system, call, "1"],
             "two_threads": seconds[system, call, "2"]}
            for system in systems for call in dict.fromkeys(call for _, call in calls)]


def columns(text, names, numbers):
    return [dict([(key, row[key]) for key in names] + [(key, float(row[key])) for key in numbers])
            for row in table(text)]


def kind_rows(text):
    return columns(text, ["group", "system", "n"],
                   ["ratio", "ratio_one", "ratio_order", "ratio_order_one", "nnz_l", "path"])


def small_rows(text):
    """With the faster of the peers, by its letter in tables."""
    rows = columns(text, ["n"], ["ours_s", "one_s", "vertex_s", "cholmod_s", "eigen_s"])
    for row in rows:
        peers = (row.pop("cholmod_s"), "C"), (row.pop("eigen_s"), "A")
        row["peer_s"], row["peer"] = min(peers)
    return rows


def kkt_rows(text):
    """A small and a larger system of each class: refactorization and solve, ours and QDLDL's."""
    seconds = {}
    for row in table(text):
        if row["method"] in ("ours", "LDL with AMD") and row["case"] != "analyze":
            key = row["system"], int(row["n"])
            seconds.setdefault(key, {})[row["case"], row["method"]] = float(row["median_s"])
    found = []
    for (system, n), of in seconds.items():
        sizes = sorted(size for name, size in seconds if name == system)
        found.append({"class": system, "size": ["small", "larger"][sizes.index(n)], "n": n,
                      "refactor": of["refactor", "ours"],
                      "refactor_ldl": of["refactor", "LDL with AMD"],
                      "solve": of["full solve", "ours"],
                      "solve_ldl": of["full solve", "LDL with AMD"]})
    return found


def osqp_rows(*texts):
    """The least times of setup and solve, in two runs with QDLDL and two with ours."""
    found = {}
    for number, text in enumerate(texts):
        for line in text.splitlines():
            name, size, rows, _, steps, changes, setup, solve, _ = line.split(",")
            row = found.setdefault((name, size), {"class": name, "size": size, "rows": rows})
            who = "qdldl" if number < 2 else "ours"
            row[who + "_steps"] = steps
            row[who + "_changes"] = changes
            for key, value in ((who + "_setup", setup), (who + "_solve", solve)):
                row[key] = min(float(value), row.get(key, 1e99))
    return list(found.values())


def eigen_rows(times, errors):
    """Seconds and errors by the number of eigenpairs; 0: the exact diagonal."""
    error_of = {row["pairs"]: row for row in table(errors)}
    found = {}
    for row in table(times):
        pairs = row["method"].split(" ")[0] if "eigenpairs" in row["method"] else "0"
        of = found.setdefault(pairs, {"pairs": pairs})
        of["adf" if row["case"] == "auto-diffusion" else "signatures"] = float(row["median_s"])
        for key in ("adf_median", "short_median", "long_median"):
            of[key] = float(error_of[pairs][key]) if pairs != "0" else 0.0
    return list(found.values())


def size_rows(text):
    return table(text)


def optimization_rows(optimized, plain):
    """First factors on one thread, by -O2 and by -O0."""
    seconds = [{row["system"]: float(row["min_s"]) for row in table(text)
                if row["case"] == "many solves" and row["method"] == "first factor"
                and row["threads"] == "1"} for text in (optimized, plain)]
    return [{"system": system, "optimized": seconds[0][system], "plain": seconds[1][system]}
            for system in seconds[0]]


def raster_rows(text):
    """The steps of raster.py, as it writes them."""
    return columns(text, ["step", "pairs"], ["seconds", "processor_s", "peak", "bytes"])


def measured(rows_of, machine, *sources):
    return sources, machine + ".machine.txt", rows_of


RESULTS = {
    "peers": measured(peer_rows, "peers", "peers.csv"),
    "peers_harmonic": measured(peer_rows, "peers_harmonic", "peers_harmonic.csv"),
    "two_threads": measured(thread_rows, "two_threads", "cold.csv", "two_threads.csv"),
    "peers_kinds": measured(kind_rows, "peers_kinds", "peers_kinds.csv"),
    "peers_small": measured(small_rows, "peers_small", "peers_small.csv"),
    "peers_kkt": measured(kkt_rows, "peers_kkt", "peers_kkt.csv"),
    "osqp": measured(osqp_rows, "osqp", "theirs.1e-3.1.csv", "theirs.1e-3.2.csv",
                     "ours.1e-3.1.csv", "ours.1e-3.2.csv"),
    "eigenpairs": measured(eigen_rows, "eigenpairs", "eigenpairs.csv", "eigenpairs_errors.csv"),
    "raster": measured(raster_rows, "raster", "raster.csv"),
    "sizes": measured(size_rows, "sizes", "sizes.csv"),
    "optimization": measured(optimization_rows, "O2/cold", "O2/cold.csv", "O0/cold.csv"),
}
