#include "engine/distributed/distributed_cut.h"

#include <algorithm>

#include "engine/distributed/whole_mesh.h"
#include "engine/measure/surface_measures.h"
#include "engine/setup/automatic_choices.h"
#include "engine/setup/constraints.h"
#include "partition/cut/cut.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

/// So many faces, with all that cutting takes, rank 0 has room for.
constexpr std::int64_t most_faces = 1'000'000;

Cut cut_whole(const PolygonMesh& mesh, const std::vector<Index>& labels, const FlowOptions& options,
              std::vector<std::string>& choices)
{
    std::vector<std::string> ignored;
    const Topology topology = make_constrained_topology(mesh, options, run_serially, ignored);
    if (!labels.empty())
        return cut_by_labels(mesh, topology, labels);
    if (options.cut.subdomains > 0)
        return cut_into(mesh, topology, options.cut.subdomains);
    const SubdomainChoice choice = choose_subdomains(
        size_of(mesh), options.time_step, needs_of(options.laplacian, options.accuracy.tolerance.has_value()));
    choices.push_back(choice.reason + ".");
    return cut_into(mesh, topology, choice.count);
}

}  // namespace

DistributedCut cut_together(Conversation& talk, const RankSlice& slice, const FlowOptions& options)
{
    const SliceBounds bounds = gather_bounds(talk, slice);
    DistributedCut result;
    if (bounds.faces.back() > most_faces) {
        if (slice.labels.empty() && slice.n_faces() > 0)
            throw OptionError("the mesh is too large to be cut here: give its cut");
        result.labels = slice.labels;
        return result;
    }
    const PolygonMesh mesh = gather_mesh(talk, slice);
    const std::vector<Index> labels = gather_at_first(talk, slice.labels);
    Cut cut;
    talk.at_first_rank([&] { cut = cut_whole(mesh, labels, options, result.choices); });
    result.labels = hand_out(talk, cut.labels, slice);
    result.remarks = cut.remarks;
    return result;
}

}  // namespace seamflow
