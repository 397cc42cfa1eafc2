#!/usr/bin/env python3
"""test_names.py: names.py finds the names of each language, and notices what breaks them"""
import os
import unittest

import names

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
STUB = names.PYTHON + "__init__.pyi"
ADAPTERS = "tools/adapters/"
TYPES = "tools/web/sparse_local.d.ts"

# (file, a text in it, what takes its place, what is said of it)
BREAKS = [
    (STUB, "def bilinear(", "def bi_linear(", "Factor.bilinear(self, cset, c, bset, b): is gone"),
    (STUB, "B: ArrayLike, xset: _Rows | None) -> _Array: ...\n    def plan",
     "xset: _Rows | None, B: ArrayLike) -> _Array: ...\n    def plan",
     "Factor.local(self, bset, B, xset): parameter 3 was B"),
    (names.PYTHON + "mesh.pyi", "def boundary(triangles", "def boundary(faces",
     "mesh.boundary(triangles): parameter 1 was triangles"),
    (names.PYTHON + "linalg.pyi", "permc_spec: str | None = ..., use_umfpack: bool = ...",
     "permc_spec: str | None = ...", "spsolve(A, b, permc_spec=, use_umfpack=): parameter 4 was"),
    (STUB, "count: int | None = ..., *, rng:", "count: int | None = ..., *, generator:",
     "Factor.sample(self, count=, *, rng=, pseudo=): the keyword rng is gone"),
    (STUB, "bset: _Rows | None, xset: _Rows | None, *,\n             region",
     "bset: _Rows | None, *, xset: _Rows | None, region",
     "Factor.plan(self, bset, xset, *, region=): parameter 3 was xset"),
    (STUB, "def version()", "def version(of: str)", "version(): of is new and cannot be left out"),
    (STUB, "class StaleError(StateError)", "class StaleError(Error)",
     "StaleError: without RuntimeError, StateError"),
    (STUB, "class PatternError(Error, ValueError)", "class PatternError(Error)",
     "MalformedError: without ValueError"),
    (STUB, "    selected: Selected | None\n    regions: list[Region]\n",
     "    regions: list[Region]\n    selected: Selected | None\n",
     "load_set returns (factor, selected, regions): parameter 2 was selected"),
    (STUB, '"nd", "metis"', '"metis"', "sparse_local.Factor ordering: without nd"),
    (STUB, "    @classmethod\n    def from_bytes(cls", "    def from_bytes(self",
     "is_complex=, definite=): parameter 1 was cls"),
    (STUB, "    @property\n    def inertia(", "    def inertia(",
     "Factor.inertia: is something else now"),
    (names.PYTHON + "gradients.pyi", "    weights: NDArray[np.float64]\n", "",
     "gradients.Stored.weights: is gone"),
    (names.PYTHON + "autograd.py", "def diagonal(self, values, rows=None)",
     "def diagonal(self, values, rows)",
     "System.diagonal(self, values, rows=): rows can no longer be left out"),
    (names.PYTHON + "sksparse/_errors.py", "class CholmodInvalidError(CholmodError)",
     "class CholmodInvalidError(Exception)",
     "sksparse.cholmod.CholmodInvalidError: without CholmodError"),
    (TYPES, '"auto" | "lower" | "upper"', '"lower" | "upper"',
     "AnalysisOptions.triangle: without auto"),
    (TYPES, "x?: null, factor?: Factor", "factor?: Factor", "Plan.solve(b, x=, factor=): x can"),
    (TYPES, "blockSize?:", "block?:", "AnalysisOptions.blockSize: is gone"),
    (TYPES, "mass?: Numbers;", "mass: Numbers;", "mass can no longer be left out"),
    (TYPES, "extends Error", "", "SparseLocalError: Error: is something else now"),
    ("tools/octave/sparse_local.m", "[l, s] = logdet(", "[s, l] = logdet(",
     "sparse_local.logdet returns (l=, s=): parameter 1 was l"),
    ("tools/octave/sparse_local.m", "if nargin < 3, sigma", "if isempty(sigma), sigma",
     "sparse_local.rank_update(this, V, sigma=): sigma can no longer be left out"),
    ("tools/octave/sparse_local_constraints.m", "count = 0;", "pins = 0;",
     "sparse_local_constraints.count: is gone"),
    ("tools/octave/mex_options.h", '"signs") == 0', '"sign") == 0',
     "sparse_local options: without signs"),
    ("tools/octave/mex_errors.h", '"stale", ', "", "sparse_local errors: without stale"),
    (ADAPTERS + "sparse_local_mesh.h", "const sl_mesh *surface, double m, double l,\n",
     "const sl_mesh *surface, double l, double m,\n", "parameter 3 was double m"),
    (ADAPTERS + "sparse_local_mesh.h", "    sl_int n_vertices;\n    sl_int n_faces;\n",
     "    sl_int n_faces;\n    sl_int n_vertices;\n", "parameter 1 was sl_int n_vertices"),
    (ADAPTERS + "sparse_local_symmetric.h", "#define SL_SYMMETRIC_GROWTH",
     "#define SL_SYMMETRIC_LIMIT", "SL_SYMMETRIC_GROWTH: is gone"),
    (ADAPTERS + "sparse_local_qdldl.h", "void QDLDL_solve(QDLDL_int n,", "void QDLDL_solve(int n,",
     "parameter 1 was QDLDL_int n"),
    (ADAPTERS + "sparse_local.hpp", "SL_RESULT change_entries(", "SL_RESULT change(",
     "sl::Factor::change_entries(const sl_csc &A, const Rows &columns): is gone"),
    (ADAPTERS + "sparse_local.hpp", "Factor : public Handle<sl_factor>", "Factor",
     "sl::Factor: Handle: is something else now"),
    (ADAPTERS + "sparse_local_eigen.hpp", "Solver &setShift(double offset, double scale = 1)",
     "Solver &setShift(double offset, double scale)", "double scale can no longer be left out"),
]

# (file, a text in it, what takes its place, a line that is new)
ADDS = [
    (STUB, "def version()", "def version(of: str = ..., *, long: bool = ...)",
     "version(of=, *, long=)"),
    (STUB, "class Plan:", "class Plan:\n    def new(self, x: int) -> None: ...",
     "Plan.new(self, x)"),
    (STUB, '"nd", "metis"', '"best", "nd", "metis"', "analyze ordering: best, given"),
    (STUB, "class IoError(Error)", "class IoError(Error, OSError)", "IoError: Error, Exception, "),
    (STUB, "class IoError(Error)", "class NewError(Error): ...\nclass IoError(Error)",
     "NewError: Error, Exception"),
    (STUB, "class MalformedError(PatternError)", "class MalformedError(Error, PatternError)", ""),
    (STUB, "*, rng: np.random.Generator | None = ...,", "rng: np.random.Generator | None = ..., *,",
     "Factor.sample(self, count=, rng=, *, pseudo=)"),
    (STUB, "was: _Sparse", "new: int = ..., was: _Sparse", "deltas=, *, new=, was=)"),
    (TYPES, "blockSize?:", "best?: boolean; blockSize?:", "AnalysisOptions.best"),
    (TYPES, "nnzL: number;", "nnzL: number; seconds?: number;", "FactorStats.seconds"),
    (TYPES, "constraints(rows?: Numbers)", "constraints(rows?: Numbers, values?: Numbers)",
     "Factor.constraints(rows=, values=)"),
    ("tools/octave/sparse_local.m", "[l, s] = logdet(", "[l, s, more] = logdet(",
     "logdet returns (l=, s=, more=)"),
    (ADAPTERS + "sparse_local.hpp", "    sl_int n() const {", "    sl_int m() const {\n    }\n"
     "    sl_int n() const {", "sl::Symbolic::m()"),
    (ADAPTERS + "sparse_local_mesh.h", "    size_t face_stride;\n",
     "    size_t face_stride;\n    int more;\n", "size_t face_stride=, int more=)"),
]


class Names(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.present = names.names(ROOT)

    def changed(self, path, old, new):
        """The names with a change of one file."""
        plain = names.read

        def read(root, name):
            text = plain(root, name)
            if name == path:
                self.assertTrue(old in text, "there is no " + old)
                text = text.replace(old, new)
            return text
        names.read = read
        try:
            return names.names(ROOT)
        finally:
            names.read = plain

    def test_nothing_has_changed(self):
        self.assertEqual(list(names.broken(self.present, self.present)), [])

    def test_breaks(self):
        for path, old, new, what in BREAKS:
            with self.subTest(path + ": " + old):
                said = list(names.broken(self.present, self.changed(path, old, new)))
                self.assertTrue(any(what in line for line in said), said)

    def test_additions(self):
        for path, old, new, line in ADDS:
            with self.subTest(path + ": " + old):
                after = self.changed(path, old, new)
                self.assertTrue(any(line in other for other in after))
                self.assertEqual(list(names.broken(self.present, after)), [])

    def test_names_of_each_language(self):
        for line in ["python sparse_local.Factor.solve(self, B, *, rows=)",
                     "python sparse_local.sksparse.cholmod.Factor.solve_A(self, b)",
                     "javascript Factor.plan(bset, xset)", "javascript load(source=)",
                     "octave sparse_local_plan(F, bset, xset)",
                     "c++ sl::BasicSolver::plan(const RowSet &bset, const RowSet &xset)",
                     "c++ sl::Plan::nb()", "c void sl_symmetric_free(sl_symmetric *M)"]:
            self.assertIn(line, self.present)

    def test_every_public_file_is_read(self):
        known = [names.PYTHON + path for path in names.MODULES] + \
            [ADAPTERS + path for path in names.C_HEADERS + names.CXX_HEADERS] + \
            ["tools/octave/" + path for path in names.OCTAVE]
        # its names are those of geometry-central
        known += [ADAPTERS + "sparse_local_geometry_central.hpp"]
        for top, ends in [(names.PYTHON, (".py", ".pyi")), (ADAPTERS, (".h", ".hpp")),
                          ("tools/octave/", ".m")]:
            for folder, _, files in os.walk(os.path.join(ROOT, top)):
                for name in files:
                    path = os.path.relpath(os.path.join(folder, name), ROOT)
                    if name.endswith(ends) and not name.startswith("_") and \
                            "/tests/" not in path and "/examples/" not in path:
                        self.assertTrue(path in known or path + "i" in known, path)

    def test_private_and_experimental_names_are_left_out(self):
        for word in ["certify", "solve_bounded", "work_of", "_check_kind", "keep_order",
                     "sl_qdldl_", "MatrixArrays::", "sparse_local.id"]:
            self.assertFalse([line for line in self.present if word in line], word)


if __name__ == "__main__":
    unittest.main()
