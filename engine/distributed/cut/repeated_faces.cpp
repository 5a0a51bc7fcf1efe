#include "engine/distributed/cut/repeated_faces.h"

#include <algorithm>
#include <utility>

#include "engine/distributed/cut/face_homes.h"
#include "engine/distributed/parts/still_faces.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/index_lists.h"
#include "partition/inspection/mesh_inspection.h"

namespace seamflow {

void find_repetitions(const MeshPart& part, const Topology& topology, std::vector<Repetition>& found)
{
    const auto is_suspicious = [&](Index v) { return topology.kind[v] == VertexKind::NonManifold; };
    const auto candidates = select(run_in_parallel, part.mesh.n_faces(),
                                   [&](Index f) { return std::ranges::any_of(part.mesh.face(f), is_suspicious); });
    for (const auto& [face, first] : find_repeated_faces(part.mesh, candidates))
        found.push_back({part.face_numbers[face], part.face_numbers[first]});
}

bool leave_out_repeated(Communicator& comm, const std::vector<Repetition>& own, RankSlice& slice,
                        std::optional<std::vector<Index>>& labels, RepeatedFaces& left_out)
{
    std::int64_t n_found = 0;
    for (const std::int64_t of_rank : comm.gather_all(std::vector<std::int64_t>{std::ssize(own)}))
        n_found += of_rank;
    if (n_found == 0)
        return false;
    const SliceBounds bounds = gather_bounds(comm, slice);
    std::vector<std::vector<Repetition>> to_homes(comm.size());
    for (const Repetition& repetition : own)
        to_homes[range_of(bounds.faces, repetition.face)].push_back(repetition);
    std::vector<Bytes> sent;
    for (const auto& of_home : to_homes)
        sent.push_back(packed(of_home));
    std::vector<Repetition> here;
    for (const Bytes& bytes : comm.exchange(std::move(sent))) {
        const auto of_rank = unpacked<Repetition>(bytes);
        here.insert(here.end(), of_rank.begin(), of_rank.end());
    }
    std::ranges::sort(here, {}, &Repetition::face);
    for (const auto& [face, first] : here) {
        left_out.faces.push_back(static_cast<Index>(face - bounds.faces[comm.rank()]));
        left_out.firsts.push_back(first);
    }
    if (labels)
        labels = labels_without(*labels, left_out.faces);
    leave_out(left_out.faces, slice);
    return true;
}

std::vector<Index> labels_of_all_faces(Communicator& comm, const RankSlice& slice, const RepeatedFaces& left_out)
{
    std::vector<Index> labels;
    auto left = slice.labels.begin();
    auto next = left_out.faces.begin();
    while (left != slice.labels.end() || next != left_out.faces.end()) {
        const bool is_left_out = next != left_out.faces.end() && at(*next) == labels.size();
        labels.push_back(is_left_out ? -1 : *left);
        if (is_left_out)
            ++next;
        else
            ++left;
    }
    SliceBounds bounds{{}, {0}};
    for (const std::int64_t n : comm.gather_all(std::vector<std::int64_t>{std::ssize(labels)}))
        bounds.faces.push_back(bounds.faces.back() + n);
    std::vector<std::int64_t> firsts = left_out.firsts;
    sort_unique(firsts);
    const std::vector<Index> found = fetch_labels(comm, labels, bounds, firsts);
    for (std::size_t i = 0; i < left_out.faces.size(); ++i)
        labels[left_out.faces[i]] = found[place_in(firsts, left_out.firsts[i])];
    return labels;
}

}  // namespace seamflow
