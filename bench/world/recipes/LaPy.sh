# LaPy: `use_cholmod` imports sksparse, for which sparse_local stands in, so that no line changes
#
# Needs a checkout of scikit-sparse 0.4 beside it, Cython, SuiteSparse, nibabel, plotly and psutil.
# The real size: heat geodesics of 80,000 faces, a torus, against CHOLMOD.

commit=d74c8db
timed="heat geodesics"

# LaPy reads its version where pip has installed it.
build() {
    install_python "$src" || return 1
    [ "$side" = ours ] || install_python "$(checkout scikit-sparse)"
}

# From a copy, because a build writes into the folder. A setuptools before 77 does not read such
# licences.
install_python() {
    rm -rf "$dir/copy" && cp -r "$1" "$dir/copy" &&
        sed -i "s/^license = '\(.*\)'/license = {text = '\1'}/; /^license-files/d" \
            "$dir/copy/pyproject.toml" &&
        SUITESPARSE_INCLUDE_DIR=/usr/include/suitesparse "$PYTHON" -m pip install -q \
            --no-deps --no-build-isolation --target "$dir/site" "$dir/copy"
}

# With ours sparse_local of build/python/site, from `make build/python/installed`, is sksparse.
python() {
    [ "$side" = theirs ] || set -- -c "import sys, runpy, sparse_local
sparse_local.stand_in('sksparse')
sys.argv = sys.argv[1:]
sys.path.insert(0, '')
if sys.argv[0] == '-m':
    sys.argv = sys.argv[1:]
    runpy.run_module(sys.argv[0], run_name='__main__', alter_sys=True)
else:
    runpy.run_path(sys.argv[0], run_name='__main__')" "$@"
    PYTHONPATH=$dir/site:$lib:$here/build/python/site MPLBACKEND=agg OPENBLAS_NUM_THREADS=1 \
        "$PYTHON" "$@"
}

own() {
    cd "$src" || return
    python -m pytest -q -p no:cacheprovider lapy/utils/tests
    [ $? -le 1 ]
}

features() { python "$recipes/LaPy.py" features; }
size() { python "$recipes/LaPy.py" size; }
