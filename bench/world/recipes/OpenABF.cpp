/* OpenABF.cpp: angles of a sheet by ABF and ABF++, and its parameters by LSCM
 *
 *     program SQUARES [size]
 */
#ifdef WORLD_OURS
#include "sparse_local_eigen.hpp"
#endif
#include "meshes.hpp"
#include "report.h"

#include <OpenABF/OpenABF.hpp>

#include <cstdlib>
#include <string>

typedef OpenABF::detail::ABF::Mesh<double> Mesh;
#ifdef WORLD_OURS
typedef sl::SimplicialLDLT<Eigen::SparseMatrix<double>> Solver;
#else
typedef Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> Solver;
#endif
typedef OpenABF::ABF<double, Mesh, Solver> ABF;
typedef OpenABF::ABFPlusPlus<double, Mesh, Solver> ABFPlusPlus;
typedef OpenABF::AngleBasedLSCM<double, Mesh, Solver> LSCM;

static Mesh::Pointer sheet(int squares) {
    const world::Mesh from = world::sheet(squares);
    Mesh::Pointer mesh = Mesh::New();
    for (const auto &v : from.vertices) mesh->insert_vertex(v[0], v[1], v[2]);
    for (const auto &f : from.faces) mesh->insert_face(f[0], f[1], f[2]);
    return mesh;
}

static void angles(const char *feature, const Mesh::Pointer &mesh) {
    for (const auto &edge : mesh->edges()) report(feature, edge->alpha);
}

static void parameters(const char *feature, const Mesh::Pointer &mesh) {
    for (const auto &vertex : mesh->vertices()) {
        report(feature, vertex->pos[0]);
        report(feature, vertex->pos[1]);
    }
}

int main(int argc, char **argv) {
    const int squares = std::atoi(argv[1]);
    if (argc > 2) {
        Mesh::Pointer mesh = sheet(squares);
        const double begin = seconds();
        std::size_t iterations;
        double gradient;
        ABFPlusPlus::Compute(mesh, iterations, gradient);
        LSCM::Compute(mesh);
        report_time(seconds() - begin);
        parameters("size", mesh);
        return 0;
    }
    std::size_t iterations;
    double gradient;
    /* ABF reads beyond its solution where more than one vertex lies inside */
    Mesh::Pointer mesh = sheet(2);
    ABF::Compute(mesh, iterations, gradient);
    angles("abf", mesh);
    mesh = sheet(squares);
    ABFPlusPlus::Compute(mesh, iterations, gradient);
    angles("abf++", mesh);
    LSCM::Compute(mesh);
    parameters("lscm_after_abf++", mesh);
    mesh = sheet(squares);
    LSCM::Compute(mesh);
    parameters("lscm", mesh);
}
