#include "samples/runs/named_files.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "partition/formats/edge_files.h"
#include "partition/formats/index_files.h"

namespace seamflow {

namespace {

/// The labels of the faces that are in the mesh.
std::vector<Index> labels_of_faces(const std::filesystem::path& path, Index n_faces, const std::vector<Index>& left_out)
{
    std::vector<Index> labels = read_labels(path, n_faces + static_cast<Index>(left_out.size()));
    auto next = left_out.begin();
    Index f = 0;
    std::erase_if(labels, [&](Index) {
        const bool is_left_out = next != left_out.end() && *next == f;
        next += is_left_out ? 1 : 0;
        ++f;
        return is_left_out;
    });
    return labels;
}

}  // namespace

void read_named_files(SmoothCommand& command, const PolygonMesh& mesh, const std::vector<Index>& left_out)
{
    const Index n = mesh.n_vertices();
    if (!command.labels.empty())
        command.options.cut.labels = labels_of_faces(command.labels, mesh.n_faces(), left_out);
    MotionOptions& motion = command.options.motion;
    if (!command.fix.empty())
        motion.fixed_vertices = read_vertex_set(command.fix, n, command.fix_property);
    if (!command.attach_weights.empty())
        motion.attachment_weights = read_vertex_weights(command.attach_weights, n, command.attach_property);
    if (!command.region.empty())
        motion.strength = read_vertex_strengths(command.region, n, command.region_property);
    if (!command.edges.empty())
        motion.feature_edges = read_edges(command.edges, n);
}

}  // namespace seamflow
