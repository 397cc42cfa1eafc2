/* meshes.hpp: the triangle meshes that the programs of the recipes work on */
#ifndef WORLD_MESHES_HPP
#define WORLD_MESHES_HPP

#include <array>
#include <cmath>
#include <vector>

namespace world {

struct Mesh {
    std::vector<std::array<double, 3>> vertices;
    std::vector<std::array<int, 3>> faces;
};

/* Faces of a grid of rows x columns squares over vertices in rows of `stride`, which may close. */
inline void add_squares(Mesh &mesh, int rows, int columns, int last_row, int last_column) {
    const int stride = last_column;
    for (int r = 0; r < rows; r++) {
        for (int c = 0; c < columns; c++) {
            const int r1 = (r + 1) % last_row, c1 = (c + 1) % last_column;
            const int a = r * stride + c, b = r * stride + c1, d = r1 * stride + c,
                      e = r1 * stride + c1;
            mesh.faces.push_back({a, b, e});
            mesh.faces.push_back({a, e, d});
        }
    }
}

/* An open sheet of n x n squares with hills. */
inline Mesh sheet(int n) {
    Mesh mesh;
    for (int r = 0; r <= n; r++) {
        for (int c = 0; c <= n; c++) {
            const double x = double(c) / n, y = double(r) / n;
            mesh.vertices.push_back({x, y, 0.1 * std::sin(7 * x + 1) * std::cos(5 * y)});
        }
    }
    add_squares(mesh, n, n, n + 1, n + 1);
    return mesh;
}

/* A closed torus of 2 n x n squares with an uneven tube. */
inline Mesh torus(int n) {
    Mesh mesh;
    const double turn = 6.283185307179586;
    for (int r = 0; r < 2 * n; r++) {
        for (int c = 0; c < n; c++) {
            const double u = turn * r / (2 * n), v = turn * c / n;
            const double tube = 0.4 + 0.05 * std::sin(3 * u) * std::cos(v);
            const double away = 1 + tube * std::cos(v);
            mesh.vertices.push_back(
                {away * std::cos(u), away * std::sin(u), tube * std::sin(v)});
        }
    }
    add_squares(mesh, 2 * n, n, 2 * n, n);
    return mesh;
}

} // namespace world

#endif
