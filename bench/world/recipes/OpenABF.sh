# OpenABF: the solver is a template argument of its classes, so that no line changes
#
# Its own tests call no solver. Ours is sl::SimplicialLDLT, theirs the default, SparseLU.
# The real size: ABF++ and LSCM of 80,000 faces, against SparseLU.

commit=ac56161
timed="ABF++ and LSCM"

build() {
    program=$recipes/OpenABF.cpp
    cxx -I"$src/include" -I/usr/include/eigen3 "$program" -o "$dir/program" || return 1
    for test in TestHalfEdgeMesh TestMath TestVec; do
        cxx -I"$src/include" -I/usr/include/eigen3 "$src/tests/src/$test.cpp" \
            -lgmock_main -lgmock -lgtest -lpthread -o "$dir/$test" || return 1
    done
}

own() {
    for test in TestHalfEdgeMesh TestMath TestVec; do
        "$dir/$test"
    done
}

features() { "$dir/program" 20; }
size() { "$dir/program" 200 size; }
