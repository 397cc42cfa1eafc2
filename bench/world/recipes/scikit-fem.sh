# scikit-fem: its direct solver calls ours
#
# The real size: a Laplacian of 66,000 rows.

commit=365167e
timed="\`solve\` by SuperLU"

build() { $PYTHON -c 'import meshio, pytest, scipy'; }

# With ours sparse_local of build/python/site, from `make build/python/installed`.
python() {
    PYTHONPATH=$src:$lib:$here/build/python/site MPLBACKEND=agg OPENBLAS_NUM_THREADS=1 \
        "$PYTHON" "$@"
}

# the tests that solve; docs.examples is found from the folder
own() {
    cd "$src" || return
    python -m pytest -q -p no:cacheprovider \
        tests/test_examples.py tests/test_manufactured.py tests/test_utils.py
    [ $? -le 1 ] # 1: a test has failed, which is counted
}

features() { python "$recipes/scikit-fem.py" features; }
size() { python "$recipes/scikit-fem.py" size; }
