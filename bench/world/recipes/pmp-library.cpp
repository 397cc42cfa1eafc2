/* pmp-library.cpp: every algorithm of pmp-library that solves, on open and closed meshes
 *
 *     program SQUARES [size]
 */
#include "meshes.hpp"
#include "report.h"

#include <pmp/algorithms/fairing.h>
#include <pmp/algorithms/geodesics.h>
#include <pmp/algorithms/hole_filling.h>
#include <pmp/algorithms/parameterization.h>
#include <pmp/algorithms/smoothing.h>
#include <pmp/surface_mesh.h>

#include <cstdlib>
#include <string>

static pmp::SurfaceMesh take(const world::Mesh &from) {
    pmp::SurfaceMesh mesh;
    for (const auto &v : from.vertices) mesh.add_vertex(pmp::Point(v[0], v[1], v[2]));
    for (const auto &f : from.faces) {
        mesh.add_triangle(pmp::Vertex(f[0]), pmp::Vertex(f[1]), pmp::Vertex(f[2]));
    }
    return mesh;
}

static void points(const std::string &feature, const pmp::SurfaceMesh &mesh) {
    for (auto v : mesh.vertices()) {
        for (int k = 0; k < 3; k++) report(feature.c_str(), mesh.position(v)[k]);
    }
}

static void parameters(const std::string &feature, pmp::SurfaceMesh &mesh) {
    auto tex = mesh.get_vertex_property<pmp::TexCoord>("v:tex");
    for (auto v : mesh.vertices()) {
        for (int k = 0; k < 2; k++) report(feature.c_str(), tex[v][k]);
    }
}

static void distances(const std::string &feature, pmp::SurfaceMesh &mesh) {
    auto distance = mesh.get_vertex_property<pmp::Scalar>("geodesic:distance");
    for (auto v : mesh.vertices()) report(feature.c_str(), distance[v]);
}

/* The sheet with the vertices of its middle selected, which fairing moves. */
static pmp::SurfaceMesh selected(int squares) {
    pmp::SurfaceMesh mesh = take(world::sheet(squares));
    auto chosen = mesh.add_vertex_property<bool>("v:selected", false);
    for (auto v : mesh.vertices()) {
        const pmp::Point &p = mesh.position(v);
        chosen[v] = p[0] > 0.2 && p[0] < 0.8 && p[1] > 0.2 && p[1] < 0.8;
    }
    return mesh;
}

int main(int argc, char **argv) {
    const int squares = std::atoi(argv[1]);
    if (argc > 2) {
        pmp::SurfaceMesh mesh = take(world::torus(squares));
        const double begin = seconds();
        pmp::geodesics_heat(mesh, {pmp::Vertex(0)});
        report_time(seconds() - begin);
        distances("size", mesh);
        return 0;
    }
    for (bool closed : {false, true}) {
        const std::string of = closed ? "_closed" : "_open";
        const pmp::SurfaceMesh mesh = take(closed ? world::torus(squares) : world::sheet(squares));
        pmp::SurfaceMesh work = mesh;
        pmp::geodesics_heat(work, {pmp::Vertex(3), pmp::Vertex(70)});
        distances("heat" + of, work);
        for (bool uniform : {false, true}) {
            work = mesh;
            pmp::implicit_smoothing(work, 0.01, 2, uniform);
            points((uniform ? "smooth_uniform" : "smooth") + of, work);
        }
    }
    for (int k = 1; k <= 3; k++) {
        pmp::SurfaceMesh mesh = selected(squares);
        pmp::fair(mesh, k);
        points("fair" + std::to_string(k), mesh);
    }
    pmp::SurfaceMesh mesh = take(world::sheet(squares));
    pmp::harmonic_parameterization(mesh);
    parameters("harmonic", mesh);
    pmp::harmonic_parameterization(mesh, true);
    parameters("harmonic_uniform", mesh);
    mesh = take(world::sheet(squares));
    pmp::lscm_parameterization(mesh);
    parameters("lscm", mesh);
    mesh = take(world::torus(squares));
    for (int k = 0; k < 30; k++) mesh.delete_face(pmp::Face(k));
    mesh.garbage_collection();
    pmp::Halfedge border;
    for (auto h : mesh.halfedges()) {
        if (mesh.is_boundary(h)) border = h;
    }
    pmp::fill_hole(mesh, border);
    points("hole", mesh);
}
