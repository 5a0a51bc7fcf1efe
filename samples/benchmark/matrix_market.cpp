#include "samples/benchmark/matrix_market.h"

#include "partition/io/output_file.h"

namespace seamflow {

namespace {

namespace fs = std::filesystem;

template <class Derived>
void write_array(const fs::path& path, const Eigen::DenseBase<Derived>& array)
{
    OutputFile file(path);
    file.text(std::is_integral_v<typename Derived::Scalar> ? "%%MatrixMarket matrix array integer general\n"
                                                           : "%%MatrixMarket matrix array real general\n");
    file.number(array.rows());
    file.text(" ");
    file.number(array.cols());
    file.text("\n");
    for (Eigen::Index c = 0; c < array.cols(); ++c)
        for (Eigen::Index r = 0; r < array.rows(); ++r) {
            file.number(array(r, c));
            file.text("\n");
        }
    file.commit();
}

/// Whether an entry of a pattern, by row and column, counts.
bool counts(SystemForm form, Index row, Index column)
{
    return form == SystemForm::AsTheyStand || row >= column;
}

Index count_entries(const SparsePattern& pattern, SystemForm form)
{
    Index n = 0;
    for (Index c = 0; c < pattern.n(); ++c)
        for (Index i = pattern.column_offsets[c]; i < pattern.column_offsets[c + 1]; ++i)
            n += counts(form, pattern.rows[i], c) ? 1 : 0;
    return n;
}

}  // namespace

void write_matrix(const fs::path& path, const WholeSystem& system, SystemForm form)
{
    const SparsePattern& pattern = system.pattern();
    OutputFile file(path);
    file.text("%%MatrixMarket matrix coordinate real ");
    file.text(form == SystemForm::Symmetric ? "symmetric\n" : "general\n");
    const auto line = [&](Index row, Index column, auto value) {
        file.number(row);
        file.text(" ");
        file.number(column);
        file.text(" ");
        file.number(value);
        file.text("\n");
    };
    line(system.n(), system.n(), count_entries(pattern, form));
    for (Index c = 0; c < pattern.n(); ++c)
        for (Index i = pattern.column_offsets[c]; i < pattern.column_offsets[c + 1]; ++i)
            if (counts(form, pattern.rows[i], c))
                line(pattern.rows[i] + 1, c + 1, system.values()[i]);
    file.commit();
}

void export_first_step(const fs::path& folder, const PolygonMesh& mesh, const FlowOptions& options)
{
    const Topology topology = make_topology(mesh);
    const auto write_form = [&](SystemForm form, const std::string& name) {
        WholeSystem system(mesh, topology, options.laplacian, form, StorageOrder::ByColumns);
        system.assemble(mesh.vertices, options.time_step);
        write_matrix(folder / (name + ".mtx"), system, form);
        write_array(folder / (name + "_rhs.mtx"), system.right_hand_side());
        return system.vertices();
    };
    write_form(SystemForm::AsTheyStand, "system");
    write_array(folder / "positions.mtx", mesh.vertices);
    if (options.laplacian == Laplacian::PtackovaVelho)
        return;
    const std::vector<Index> vertices = write_form(SystemForm::Symmetric, "symmetric");
    const Eigen::Map<const Eigen::VectorX<Index>> numbers(vertices.data(), static_cast<Eigen::Index>(vertices.size()));
    write_array(folder / "symmetric_vertices.mtx", (numbers.array() + 1).eval());
}

}  // namespace seamflow
