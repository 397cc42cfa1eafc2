/* geometry-central.cpp: what geometry-central solves by PositiveDefiniteSolver
 *
 *     program SQUARES [size]
 */
#include "meshes.hpp"
#include "report.h"

#include <geometrycentral/numerical/linear_solvers.h>
#include <geometrycentral/pointcloud/point_cloud_heat_solver.h>
#include <geometrycentral/surface/boundary_first_flattening.h>
#include <geometrycentral/surface/direction_fields.h>
#include <geometrycentral/surface/heat_method_distance.h>
#include <geometrycentral/surface/polygon_mesh_heat_solver.h>
#include <geometrycentral/surface/signed_heat_method.h>
#include <geometrycentral/surface/surface_mesh_factories.h>
#include <geometrycentral/surface/vector_heat_method.h>

#include <cstdlib>
#include <memory>
#include <string>

using namespace geometrycentral;
using namespace geometrycentral::surface;

struct Surface {
    std::unique_ptr<ManifoldSurfaceMesh> mesh;
    std::unique_ptr<VertexPositionGeometry> geometry;
};

static std::vector<Vector3> positions(const world::Mesh &from) {
    std::vector<Vector3> points;
    for (const auto &v : from.vertices) points.push_back(Vector3{v[0], v[1], v[2]});
    return points;
}

static Surface take(const world::Mesh &from) {
    std::vector<std::vector<size_t>> polygons;
    for (const auto &f : from.faces) {
        polygons.push_back({size_t(f[0]), size_t(f[1]), size_t(f[2])});
    }
    Surface surface;
    std::tie(surface.mesh, surface.geometry) =
        makeManifoldSurfaceMeshAndGeometry(polygons, positions(from));
    return surface;
}

static void number(const std::string &feature, double x) {
    report(feature.c_str(), x);
}

static void number(const std::string &feature, const Vector2 &x) {
    report(feature.c_str(), x.x);
    report(feature.c_str(), x.y);
}

template <class Data> static void show(const std::string &feature, const Data &x) {
    for (size_t k = 0; k < x.size(); k++) number(feature, x[k]);
}

/* The vertices of a square path in the middle of the sheet, which ends where it begins. */
static std::vector<Vertex> path(const Surface &sheet, int squares) {
    const int first = squares / 4, side = squares / 2;
    std::vector<Vertex> vertices;
    for (int k = 0; k <= 4 * side; k++) {
        const int along = k % side, turn = k / side % 4;
        const int column = turn == 0 ? along : turn == 1 ? side : turn == 2 ? side - along : 0;
        const int row = turn == 0 ? 0 : turn == 1 ? along : turn == 2 ? side : side - along;
        vertices.push_back(
            sheet.mesh->vertex(size_t((first + row) * (squares + 1) + first + column)));
    }
    return vertices;
}

static void on_mesh(const Surface &surface, const std::string &of) {
    const Vertex source = surface.mesh->vertex(70), other = surface.mesh->vertex(155);
    const std::vector<std::tuple<Vertex, double>> values = {{source, 2}, {other, -1}};
    HeatMethodDistanceSolver heat(*surface.geometry);
    show("heat" + of, heat.computeDistance(std::vector<Vertex>{source, other}));
    VectorHeatMethodSolver vectors(*surface.geometry);
    show("extend" + of, vectors.extendScalar(values));
    show("transport" + of, vectors.transportTangentVector(source, Vector2{1, 2}));
    show("logmap" + of, vectors.computeLogMap(source));
    show("smoothest_field" + of, computeSmoothestVertexDirectionField(*surface.geometry));
}

static void signed_distances(const Surface &sheet, int squares) {
    Curve curve;
    for (Vertex v : path(sheet, squares)) curve.nodes.push_back(SurfacePoint(v));
    SignedHeatSolver solver(*sheet.geometry);
    const LevelSetConstraint constraints[] = {
        LevelSetConstraint::None, LevelSetConstraint::ZeroSet, LevelSetConstraint::Multiple};
    for (int k = 0; k < 3; k++) {
        SignedHeatOptions options;
        options.levelSetConstraint = constraints[k];
        show("signed" + std::to_string(k), solver.computeDistance({curve}, options));
    }
    SignedHeatOptions options;
    options.softLevelSetWeight = 10;
    show("signed_soft", solver.computeDistance({curve}, options));
}

static void on_polygons(const Surface &surface, int squares) {
    const Vertex source = surface.mesh->vertex(70), other = surface.mesh->vertex(155);
    PolygonMeshHeatSolver solver(*surface.geometry);
    show("polygon_heat", solver.computeDistance(source));
    show("polygon_extend", solver.extendScalars({{source, 2}, {other, -1}}));
    show("polygon_transport", solver.transportTangentVector(source, Vector2{1, 2}));
    show("polygon_signed", solver.computeSignedDistance({path(surface, squares)}));
}

static void on_points(const world::Mesh &from) {
    pointcloud::PointCloud cloud(from.vertices.size());
    pointcloud::PointData<Vector3> at(cloud);
    const std::vector<Vector3> points = positions(from);
    for (size_t k = 0; k < points.size(); k++) at[k] = points[k];
    pointcloud::PointPositionGeometry geometry(cloud, at);
    pointcloud::PointCloudHeatSolver solver(cloud, geometry);
    const pointcloud::Point source = cloud.point(70), other = cloud.point(155);
    show("points_heat", solver.computeDistance(source));
    show("points_extend", solver.extendScalars({{source, 2}, {other, -1}}));
    show("points_transport", solver.transportTangentVector(source, Vector2{1, 2}));
    show("points_logmap", solver.computeLogMap(source));
}

int main(int argc, char **argv) {
    const int squares = std::atoi(argv[1]);
    const Surface torus = take(world::torus(squares));
    if (argc > 2) {
        const double begin = seconds();
        HeatMethodDistanceSolver solver(*torus.geometry);
        const VertexData<double> x = solver.computeDistance(torus.mesh->vertex(0));
        report_time(seconds() - begin);
        show("size", x);
        return 0;
    }
    const Surface sheet = take(world::sheet(squares));
    on_mesh(torus, "_closed");
    on_mesh(sheet, "_open");
    signed_distances(sheet, squares);
    on_polygons(sheet, squares);
    on_points(world::torus(squares));
    show("bff", parameterizeBFF(*sheet.mesh, *sheet.geometry));
}
