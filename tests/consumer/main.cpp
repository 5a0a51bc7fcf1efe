// A program outside the project: smooths a bump on a grid of squares with the installed library.

#include <array>
#include <cmath>
#include <iostream>

#include <seamflow/engine/mean_curvature_flow.h>
#include <seamflow/partition/version.h>

namespace {

constexpr int side = 20;

seamflow::PolygonMesh make_bump()
{
    seamflow::PolygonMesh mesh;
    mesh.vertices.resize(side * side, 3);
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            mesh.vertices.row(i * side + j) << i, j,
                3.0 * std::exp(-0.1 * (std::pow(i - 9.5, 2) + std::pow(j - 9.5, 2)));
    for (int i = 0; i + 1 < side; ++i)
        for (int j = 0; j + 1 < side; ++j)
            mesh.add_face(std::array{i * side + j, (i + 1) * side + j, (i + 1) * side + j + 1, i * side + j + 1});
    return mesh;
}

}  // namespace

int main()
{
    seamflow::PolygonMesh mesh = make_bump();
    const double before = mesh.vertices.col(2).maxCoeff();
    seamflow::FlowOptions options;
    options.radius = 5.0;
    options.steps = 3;
    options.cut.subdomains = 4;
    const seamflow::FlowReport report = seamflow::mean_curvature_flow(mesh, options);
    const double after = mesh.vertices.col(2).maxCoeff();
    std::cout << "seamflow " << seamflow::version << ": " << report.cut.n_sub_meshes() << " sub-meshes, height from "
              << before << " to " << after << '\n';
    return report.cut.n_sub_meshes() == 4 && after > 0.0 && after < 0.8 * before ? 0 : 1;
}
