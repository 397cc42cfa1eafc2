"""Methods have the words of C; errors name calls and options of this package, and nothing of C."""
import os
import re

import numpy as np
import pytest
import scipy.sparse as sp

import sparse_local as sl
from sparse_local import _library, _names
from sparse_local._options import ANALYSIS, NUMBERS
from systems import grid

HEADER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "csrc", "sparse_local.h")
NAN = float("nan")


def header():
    if not os.path.exists(HEADER):
        pytest.skip("no header beside the package")
    with open(HEADER) as file:
        return re.sub(r"/\*.*?\*/", "", file.read(), flags=re.DOTALL)


def texts():
    """All sentences that the library can print: its string literals with a space."""
    literal = r'"((?:[^"\\\n]|\\.)*)"'
    found = {"".join(re.findall(literal, whole.group())) for whole in
             re.finditer(literal + r"(?:\s*" + literal + ")*", header())}
    return sorted(text for text in found if " " in text and "%" not in text and
                  not text.startswith("sparse_local.h"))


def of_c():
    """What is not to be in a sentence: names with a prefix, and fields of structs in one, but for
    calls of this package."""
    text = header()
    fields = set()
    for body in re.findall(r"typedef struct sl_\w+ \{(.*?)\} sl_\w+;", text, re.DOTALL):
        fields.update(re.findall(r"\b(\w+)(?:\[\d+\])?[;,)]", body))
    assert {"p", "i", "x", "null_vector_count", "n_rows", "ordering", "weak"} <= fields
    own = set(ANALYSIS) | set(NUMBERS)
    calls = ["%s[.]%s" % (kind.__name__, name) for kind in (sl.Factor, sl.Constraints, sl.Region)
             for name in dir(kind) if not name.startswith("_")]
    alone = sorted(name for name in fields if "_" in name and name not in own)
    return re.compile(r"\b(?:sl|SL|sli|SLI)_|\bMETIS_|\boptions\.|\bNULL\b|\bsize_t\b|\bld[a-z]\b|"
                      r"(?<![\w.])(?!(?:%s)\b)\w+\.(?:%s)\b|\b(?:%s)\b" %
                      ("|".join(calls), "|".join(sorted(fields)), "|".join(alone)))


def test_no_text_of_the_library_keeps_a_name_of_c():
    pattern, named, dropped = of_c(), 0, set()
    found = texts()
    assert len(found) > 250 and "A is not square" in found
    for text in found:
        named += pattern.search(text) is not None
        ours = _names.in_own_names(text + " (row 3)", "STATUS")
        assert not pattern.search(ours), ours
        if ours == "STATUS (row 3)":
            dropped.add(text)
        elif not pattern.search(text) and not _names._WORDS.search(text):
            assert ours == text + " (row 3)"
    assert named > 100
    # what gives way to the text of the status is what no call of the package can pass
    impossible = re.compile(r"NULL|\bld[a-z] |size|is below 0|is not a value of|^R is B|P\.columns|"
                            r"isa|allocator|set\.|sl_load_flag|a reserved|SL_LOAD_TRUSTED")
    assert [text for text in dropped if not impossible.search(text)] == []


def test_each_name_is_used():
    """No entry of the list is left over: each is in a sentence of the library."""
    found = "\n".join(texts())
    assert [name for name in _names.NAMES if name not in found and
            name not in ("A.i", "options.ordering", "options.purpose", "options.signs")] == []


def test_methods_have_the_words_of_c():
    """sl_factor_rank_update is Factor.rank_update, and so all calls but those that a constructor,
    Factor.edit, Sum or no user's method makes."""
    kinds = {"factor": sl.Factor, "inverse": sl.Factor, "symbolic": sl.Analysis, "plan": sl.Plan,
             "region": sl.Region, "selected": sl.Selected, "constraints": sl.Constraints,
             "fixed": sl.FixedRows}
    other = set()
    for name in _library._CALLS:
        kind, _, word = name.partition("_")
        if kind in kinds and word != "create" and not hasattr(kinds[kind], word):
            other.add(name)
    assert other == {"symbolic_create_pivoted", "symbolic_edit", "symbolic_scatter",
                     "factor_create_sums", "factor_refactor_sums", "factor_defects",
                     "factor_pseudo_inverse"}


def wrong_uses(tmp_path):
    """Calls that are refused, by a name of each."""
    A = grid(6)
    n = A.shape[0]
    F, L = sl.Factor(A), grid(6, 0.0)
    S = sl.Factor(L, null_pivots="skip")
    kkt = sp.csc_matrix(np.array([[0, 1, 2.0], [1, 0, 3], [2, 3, 0]]))
    pivoted = sl.Factor(kkt, pivoted=True)
    indefinite = A.tolil()
    indefinite[6, 6] = -50
    indefinite = indefinite.tocsc()
    regularized = sl.Factor(indefinite, regularization=1e-8)
    other = grid(6, 3.0).tolil()
    other[0, 20] = other[20, 0] = 0.25
    other = other.tocsc()
    nan_b = np.ones(n)
    nan_b[4] = NAN
    zero_row = A.tolil()
    zero_row[3, :] = 0
    zero_row[:, 3] = 0
    zero_row = zero_row.tocsc()
    closed = sl.Factor(A)
    closed_plan = closed.plan([1], [2])
    closed.close()
    changed = sl.Factor(A)
    region, pins = changed.region([0, 1, 2]), changed.constraints([3])
    selected = sl.Selected(changed)
    in_region = changed.plan([0], [1], region=region)
    changed.refactor(2 * A)
    failed = sl.Factor(A)
    with pytest.raises(sl.Error):
        failed.refactor(0 * A)
    unsorted = A.copy()
    unsorted.indices[5] = 400
    descends = A.copy()
    descends.indptr[5] = descends.indptr[4] - 1
    begins = A.copy()
    begins.indptr[0] = 1
    skew = A.tolil()
    skew[2, 1] = 7
    skew = skew.tocsc()
    file, junk = str(tmp_path / "f.slf"), str(tmp_path / "junk.slf")
    F.save(file)
    mapped = sl.Factor.load(file, map=True)
    with open(junk, "wb") as out:
        out.write(b"hello")
    with open(file, "rb") as whole, open(str(tmp_path / "short.slf"), "wb") as out:
        out.write(whole.read()[:-64])
    fixed = sl.FixedRows(A, [0, 5])
    part = F.submatrix(A, [1, 2, 3])
    total = sl.Sum([A, sp.identity(n, format="csc")])
    V = sp.csc_matrix(([1.0, 1.0], [0, n - 1], [0, 2]), shape=(n, 1))
    return {
        "not square": lambda: sl.Factor(A[:, :5]),
        "no sparse matrix": lambda: sl.Factor(np.eye(3)),
        "singular": lambda: sl.Factor(L),
        "singular, one triangle": lambda: sl.Factor(sp.tril(L, format="csc")),
        "singular, pivoted": lambda: sl.Factor(L, pivoted=True),
        "zero row": lambda: sl.Factor(zero_row),
        "zero row, pivoted": lambda: sl.Factor(zero_row, pivoted=True),
        "needs pivots": lambda: sl.Factor(kkt),
        "wrong sign": lambda: sl.Factor(indefinite, null_pivots="skip"),
        "not definite": lambda: sl.Factor(indefinite, definite=True),
        "cholesky": lambda: sl.cholesky(-A),
        "within the tolerance": lambda: sl.Factor(A, null_tolerance=100.0),
        "growth": lambda: sl.Factor(kkt + 1e-9 * sp.identity(3), growth_limit=10.0),
        "pivoted and skip": lambda: sl.Factor(kkt, pivoted=True, null_pivots="skip"),
        "pivoted and definite": lambda: sl.Factor(kkt, pivoted=True, definite=True),
        "complex storage": lambda: sl.Factor(A, storage="complex"),
        "regularized skip": lambda: sl.Factor(A, regularization=1e-8, null_pivots="skip"),
        "negative regularization": lambda: sl.Factor(A, regularization=-1.0),
        "regularization NaN": lambda: sl.Factor(A, regularization=NAN),
        "signs": lambda: sl.Factor(A, regularization=1e-8, signs=np.full(n, 2)),
        "tolerance NaN": lambda: sl.Factor(A, null_tolerance=NAN),
        "consistency NaN": lambda: sl.Factor(A, consistency_tolerance=NAN),
        "growth NaN": lambda: sl.Factor(A, growth_limit=NAN),
        "error NaN": lambda: sl.Factor(A, error_limit=NAN),
        "mass NaN": lambda: sl.Factor(L, null_pivots="skip", mass=np.full(n, NAN)),
        "null vector NaN": lambda: sl.Factor(L, null_pivots="skip", null_vector=np.full(n, NAN)),
        "33 null vectors": lambda: sl.Factor(L, null_pivots="skip", null_vector=np.ones((n, 33))),
        "mass too short": lambda: sl.Factor(L, null_pivots="skip", mass=np.ones(n - 1)),
        "block size": lambda: sl.Factor(A, block_size=5),
        "block size below 0": lambda: sl.Factor(A, block_size=-1),
        "ordering": lambda: sl.Factor(A, ordering="no"),
        "METIS": lambda: sl.Factor(A, ordering="metis"),
        "given without perm": lambda: sl.Factor(A, ordering="given"),
        "perm with another ordering": lambda: sl.Factor(A, ordering="nd", perm=np.arange(n)),
        "perm twice": lambda: sl.Factor(A, perm=np.zeros(n, int)),
        "perm out of range": lambda: sl.Factor(A, perm=np.arange(1, n + 1)),
        "purpose": lambda: sl.Factor(A, purpose="no"),
        "threads": lambda: sl.Factor(A, threads=0),
        "triangle": lambda: sl.Factor(A, triangle="both"),
        "row in A": lambda: sl.Factor(unsorted),
        "positions descend": lambda: sl.Factor(descends),
        "positions begin at 1": lambda: sl.Factor(begins),
        "skew": lambda: sl.Factor(skew),
        "NaN in A": lambda: sl.Factor(A * NAN),
        "b of another size": lambda: F.solve(np.ones(n + 1)),
        "NaN in b": lambda: F.solve(nan_b),
        "NaN in a local b": lambda: F.local([3], [NAN], [4]),
        "b without a solution": lambda: S.solve(np.ones(n)),
        "local b without a solution": lambda: S.local([3], [1.0], [4]),
        "x overflows": lambda: sl.Factor(sp.csc_matrix([[1e-300]])).solve([1e300]),
        "row out of range": lambda: F.local([n], [1.0], [0]),
        "row below 0": lambda: F.plan([0], [-1]),
        "rows that are reals": lambda: F.plan([0.5], [1]),
        "diagonal": lambda: F.diagonal([n]),
        "pairs": lambda: F.pairs([0], [n]),
        "block": lambda: F.block([0], [n]),
        "inverse with 2x2 pivots": lambda: pivoted.diagonal(),
        "selected with 2x2 pivots": lambda: sl.Selected(pivoted),
        "half a solve": lambda: sl.Factor(indefinite).solve_part("sqrtD", np.ones(n)),
        "half a solve with 2x2 pivots": lambda: pivoted.solve_part("sqrtD", np.ones(3)),
        "D twice": lambda: F.solve_part("D sqrtD", np.ones(n)),
        "parts of a plan": lambda: F.plan([0], [1]).solve_part("D", np.ones(1)),
        "columns of a plan": lambda: F.plan([0], [1]).columns("D"),
        "parts of a plan in a region": lambda: in_region.columns("L"),
        "plan of another analysis": lambda: F.plan([0], [1]).on(changed),
        "plan of another factor": lambda: plan_of(F, changed).solve([1.0]),
        "region of another analysis": lambda: F.plan([0], [1], region=region),
        "region out of date": lambda: in_region.solve([1.0]),
        "region with mass": lambda: sl.Factor(L, null_pivots="skip", mass=np.ones(n)).region([0]),
        "pins out of date": lambda: pins.solve(None, [1.0]),
        "pin twice": lambda: F.constraints([3, 3]),
        "pin out of range": lambda: F.constraints([n]),
        "pin NaN": lambda: F.constraints([3]).solve(None, [NAN]),
        "pins with a plan in a region": lambda: changed.constraints([3]).solve(
            [1.0], [1.0], plan=in_region),
        "equality NaN": lambda: F.constraints().add([1, 2], [1.0, NAN]),
        "dependent equality": lambda: F.constraints([1, 2]).add([1, 2], [1.0, 1.0]),
        "release": lambda: F.constraints([1]).release([4]),
        "release twice": lambda: F.constraints([1, 2]).release([1, 1]),
        "pins with both signs": lambda: sl.Factor(indefinite).constraints([1]),
        "pins with 2x2 pivots": lambda: pivoted.constraints([1]),
        "pins on a regularized factor": lambda: regularized.constraints([1]),
        "refactor with another pattern": lambda: F.refactor(other),
        "refactor with another size": lambda: F.refactor(grid(5)),
        "refactor with a NaN": lambda: sl.Factor(A).refactor(A * NAN),
        "refactor with zeros": lambda: sl.Factor(A).refactor(0 * A),
        "columns out of range": lambda: F.change_entries(A, columns=[n]),
        "change out of range": lambda: F.change_entries(A, rows=[n], columns=[0], deltas=[1.0]),
        "change by NaN": lambda: F.change_entries(A, rows=[0], columns=[0], deltas=[NAN]),
        "change of no entry": lambda: F.change_entries(None, [0], [n - 1], [1.0]),
        "change to singular": lambda: sl.Factor(sp.identity(n, format="csc")).change_entries(
            None, [0], [0], [-1.0]),
        "rank update of no entry": lambda: F.rank_update(V),
        "rank update of another size": lambda: F.rank_update(sp.csc_matrix((n + 1, 1))),
        "rank update by NaN": lambda: F.rank_update(V * NAN),
        "rank update, sigma": lambda: F.rank_update(V[:, :0], [1.0]),
        "rank update with null pivots": lambda: S.change_entries(None, [0], [0], [1.0]),
        "rank update with 2x2 pivots": lambda: pivoted.change_entries(None, [0], [1], [1.0]),
        "rank update in float": lambda: sl.Factor(A, storage="float").change_entries(
            None, [0], [0], [1.0]),
        "submatrix": lambda: F.submatrix(A, [1, 1]),
        "submatrix, range": lambda: F.submatrix(A, [n]),
        "submatrix twice": lambda: part.submatrix(A[1:4, 1:4], [0]),
        "refactor a submatrix": lambda: part.refactor(A[1:4, 1:4]),
        "save a submatrix": lambda: part.save(str(tmp_path / "r.slf")),
        "submatrix with 2x2 pivots": lambda: pivoted.submatrix(kkt, [0, 1]),
        "edit": lambda: F.edit(A, A, np.zeros(n, int)),
        "edit out of range": lambda: F.edit(A, A, np.full(n, n)),
        "edit with 2x2 pivots": lambda: pivoted.edit(kkt, kkt, [0, 1, 2]),
        "edit not square": lambda: F.edit(A, A[:, :5], np.arange(n)),
        "not certified": lambda: F.plan([0], [1]).solve_bounded([1.0]),
        "certify another matrix": lambda: F.certify(3 * A),
        "certify with 2x2 pivots": lambda: pivoted.certify(kkt),
        "certify both signs": lambda: sl.Factor(indefinite).certify(indefinite),
        "guarantee with null pivots": lambda: S.certify(L, certainty="guaranteed"),
        "guarantee in float": lambda: sl.Factor(A, storage="float").certify(
            A, certainty="guaranteed"),
        "refine, steps": lambda: F.refine(A, np.ones(n), np.ones(n), steps=-1),
        "refine NaN": lambda: F.refine(A, nan_b, np.ones(n)),
        "refine locally": lambda: regularized.plan([0], [1]).solve_regularized([1.0]),
        "refine locally, steps": lambda: F.plan([0], [1]).solve_regularized(
            [1.0], steps=-1),
        "entry that is not kept": lambda: sl.Selected(F, [0]).entries([0], [n - 1]),
        "selected out of range": lambda: sl.Selected(F, [n]),
        "selected of mapped": lambda: sl.load_set(
            saved_set(F, tmp_path), map=True).selected.refactor(),
        "saved set out of date": lambda: sl.save_set(str(tmp_path / "x.slf"), changed,
                                                     selected=selected),
        "saved region out of date": lambda: sl.save_set(
            str(tmp_path / "x.slf"), changed, regions=[region]),
        "saved set of two": lambda: sl.save_set(str(tmp_path / "x.slf"), F, selected=selected),
        "failed": lambda: failed.solve(np.ones(n)),
        "failed plan": lambda: failed.plan([0], [1]).solve([1.0]),
        "failed, saved": lambda: failed.save(str(tmp_path / "x.slf")),
        "closed": lambda: closed.solve(np.ones(n)),
        "closed plan": lambda: closed_plan.solve([1.0]),
        "mapped": lambda: mapped.refactor(A),
        "mapped, changed": lambda: mapped.change_entries(None, [0], [0], [1.0]),
        "no file": lambda: sl.Factor.load(str(tmp_path / "none.slf")),
        "no folder": lambda: F.save(str(tmp_path / "none" / "f.slf")),
        "a folder": lambda: sl.Factor.load(str(tmp_path)),
        "a folder, mapped": lambda: sl.Factor.load(str(tmp_path), map=True),
        "junk": lambda: sl.Factor.load(junk),
        "junk, mapped": lambda: sl.Factor.load(junk, map=True),
        "truncated": lambda: sl.Factor.load(str(tmp_path / "short.slf")),
        "junk bytes": lambda: sl.Factor.from_bytes(b"hello"),
        "fixed out of range": lambda: sl.FixedRows(A, [n]),
        "fixed twice": lambda: sl.FixedRows(A, [1, 1]),
        "fixed, singular": lambda: sl.FixedRows(sp.block_diag([L, L], format="csc"), [0]),
        "fixed, indefinite": lambda: sl.FixedRows(indefinite, [0], definite=True),
        "fixed, block size": lambda: sl.FixedRows(A, [0], block_size=5),
        "fixed, pattern": lambda: fixed.refactor(other),
        "fixed, size": lambda: fixed.refactor(grid(5)),
        "fixed, NaN": lambda: fixed.solve(None, [1.0, NAN]),
        "fixed, NaN in b": lambda: fixed.solve(nan_b, [1.0, 2.0]),
        "fixed, failed": lambda: failed_fixed(A).solve([1.0]),
        "sum of two sizes": lambda: sl.Sum([A, kkt]),
        "sum of a rectangle": lambda: sl.Sum([A[:, :5]]),
        "sum of nothing": lambda: sl.Sum([]),
        "sum, singular": lambda: sl.Sum([L]).factor([1.0]),
        "sum by NaN": lambda: total.factor([1.0, NAN]),
        "sum, a factor twice": lambda: total.refactor([total.factor([1., 1.])] * 2,
                                                      [[1., 1.], [1., 1.]]),
        "triplets": lambda: sl.from_triplets(2, [0, 9], [0, 1], [1.0, 1.0]),
        "triplets, negative size": lambda: sl.from_triplets(-1, [], [], []),
        "Hermitian": lambda: sl.Factor(sp.csc_matrix(np.array([[1j, 0], [0, 1]]))),
        "batch": lambda: sl.solve_batch([(F, np.ones(n)), (S, np.ones(n))]),
        "batch, failed": lambda: sl.solve_batch([(failed, np.ones(n))]),
        "logdet of a failed factor": lambda: failed.logdet(),
        "pivot rows": lambda: F.pivot_rows("no"),
    }


def plan_of(F, other):
    """A plan of F that is told to solve with a factor of another analysis."""
    plan = F.plan([0], [1])
    plan._factor = other
    return plan


def saved_set(F, folder):
    path = str(folder / "set.slf")
    sl.save_set(path, F, selected=sl.Selected(F))
    return path


def failed_fixed(A):
    fixed = sl.FixedRows(A, [0])
    with pytest.raises(sl.Error):
        fixed.refactor(0 * A)
    return fixed


def test_wrong_uses_are_refused_in_names_of_python(tmp_path):
    pattern, said, taken = of_c(), set(), []
    for name, call in wrong_uses(tmp_path).items():
        try:
            call()
        except (sl.Error, TypeError, ValueError) as error:
            text = str(error)
        else:
            taken.append(name)
            continue
        assert not pattern.search(text), (name, text)
        print(name, '|', '|', text)
        assert len(text) > 8, (name, text)
        said.add(text)
    assert set(taken) <= {"METIS"}, taken  # which may be compiled in
    assert len(said) > 100


@pytest.mark.filterwarnings("error")
def test_stand_ins_advise_nothing_that_they_do_not_take():
    from sparse_local import qdldl
    from sparse_local.sksparse import cholmod
    from sparse_local.sksparse05 import cholmod as newer
    A = grid(6)
    skew, indefinite, empty = A.tolil(), A.tolil(), sp.csc_matrix((6, 6))
    skew[2, 1], indefinite[6, 6] = 7, -50
    skew, indefinite, nan = skew.tocsc(), indefinite.tocsc(), A * NAN
    kkt = sp.csc_matrix(np.array([[0, 1, 2.0], [1, 0, 3], [2, 3, 0]]))
    theirs = re.compile(r"pivoted|null_pivots|definite=|triangle=|mass|null_tolerance|Factor\.")
    said = set()
    for B in (skew, indefinite, empty, nan, kkt, A[:, :5]):
        for call in (lambda: cholmod.cholesky(B), lambda: cholmod.cholesky(B, mode="supernodal"),
                     lambda: newer.cholesky(B), lambda: newer.cho_factor(B),
                     lambda: newer.ldl(B), lambda: qdldl.Solver(B).solve(np.ones(B.shape[0]))):
            try:
                call()
            except Exception as error:
                text = str(error)
                assert not theirs.search(text) and not of_c().search(text), text
                said.add(text)
    assert len(said) > 5
