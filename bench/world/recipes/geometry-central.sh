# geometry-central: its class PositiveDefiniteSolver, without SuiteSparse
#
# Sources and own tests of what solves, and of point clouds. Needs a checkout of happly beside it.
# Fields, transport on these meshes, and "signed2" are solved by its SquareSolver with either side.
# The real size: heat geodesics of 200,000 faces, a torus.

commit=56152a8
timed="heat geodesics"

files="numerical/*.cpp pointcloud/*.cpp utilities/*[!3].cpp
    surface/*_geometry*.cpp surface/*_heat_*.cpp surface/*surface_mesh*.cpp surface/bary*.cpp
    surface/boundary_*.cpp surface/direction_*.cpp surface/heat_*.cpp surface/intrinsic_m*.cpp
    surface/meshio.cpp surface/polygon_*helpers.cpp surface/simple_*.cpp surface/surface_point.cpp
    surface/trace_geodesic.cpp surface/tufted_*.cpp
    ../test/src/l*_test*.cpp ../test/src/point_cloud_test.cpp"

# An object of theirs serves ours too, if its source is the same: headers do not change.
build() {
    happly=$(checkout happly) || return 1
    set -- -DNDEBUG -I"$src/include" -I"$src/deps/nanoflann/include" -I"$src/deps/nanort/include" \
        -I"$happly" -I/usr/include/eigen3 -DGC_TEST_ASSETS_ABS_PATH="\"$src/test/assets\""
    mkdir -p "$dir/objects"
    for file in $(cd "$src/src" && echo $files); do
        object=objects/$(basename "$file" .cpp).o
        if [ "$side" = ours ] && cmp -s "$src/src/$file" "$work/theirs/src/src/$file"; then
            cp "$work/theirs/$object" "$dir/$object"
        else
            cxx_object "$@" -I"$src/test/include" "$src/src/$file" -o "$dir/$object"
        fi || return 1
    done
    objects=$(ls "$dir"/objects/*.o | grep -v _test)
    cxx "$@" "$recipes/geometry-central.cpp" $objects -o "$dir/program" &&
        cxx "$dir"/objects/*.o -lgtest_main -lgtest -lpthread -o "$dir/tests"
}

own() { cd "$dir" && ./tests; }
features() { "$dir/program" 20; }
size() { "$dir/program" 224 size; }
