#include "samples/figures/mesh_source.h"

#include <algorithm>

#include "partition/formats/mesh_io.h"
#include "samples/files/mesh_input.h"

namespace seamflow {

namespace {

namespace fs = std::filesystem;

/// The file with that name in a folder, with or without its prefix; empty if there is none.
FigureMesh read_file(const FigureSource& source, const fs::path& path)
{
    FigureMesh result;
    result.name = path.filename().string();
    result.mesh = read_mesh(path).mesh;
    require_faces(path, result.mesh.n_faces());
    result.is_theirs = result.mesh.n_vertices() == source.vertices;
    if (result.is_theirs)
        result.authors = source.authors;
    const Index first = result.authors ? result.authors->first_part : result.mesh.n_faces() / 2;
    result.labels = halves_by_number(result.mesh, first);
    result.cut = "first " + std::to_string(first) + " faces" + (result.authors ? " (the authors')" : "");
    return result;
}

}  // namespace

fs::path find_file(std::string_view name, const fs::path& folder)
{
    for (const std::string prefix : {"", "ddm__"}) {
        fs::path path = folder / (prefix + std::string(name));
        if (!folder.empty() && fs::exists(path))
            return path;
    }
    return {};
}

FigureMesh load(const FigureSource& source, const fs::path& folder)
{
    if (const fs::path path = find_file(source.file, folder); !path.empty())
        return read_file(source, path);
    FigureMesh result;
    result.name = "generated";
    result.mesh = source.generate(source.vertices);
    result.labels = halves_by_rows(result.mesh, source.axis);
    result.cut = source.axis == 1 ? "lower half in y" : "lower half in z";
    return result;
}

std::vector<Index> halves_by_rows(const PolygonMesh& mesh, Eigen::Index axis)
{
    const auto height = mesh.vertices.col(axis);
    const double middle = (height.minCoeff() + height.maxCoeff()) / 2.0;
    std::vector<Index> labels;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        double sum = 0.0;
        for (const Index v : mesh.face(f))
            sum += height(v) - middle;
        labels.push_back(sum < 0.0 ? 0 : 1);
    }
    return labels;
}

std::vector<Index> halves_by_number(const PolygonMesh& mesh, Index first)
{
    std::vector<Index> labels(mesh.n_faces(), 1);
    std::fill_n(labels.begin(), std::clamp(first, Index{0}, mesh.n_faces()), 0);
    return labels;
}

}  // namespace seamflow
