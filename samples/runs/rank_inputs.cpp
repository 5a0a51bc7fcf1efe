#include "samples/runs/rank_inputs.h"

#include <algorithm>

#include "engine/distributed/parts/deal.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "engine/distributed/ranks/packing.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/errors.h"
#include "partition/formats/index_files.h"
#include "partition/index_lists.h"
#include "samples/files/mesh_results.h"

namespace seamflow {

int threads_of_rank(Communicator& comm, const std::string& host, const SmoothCommand& command)
{
    int n_here = 0;
    for (const Bytes& bytes : comm.allgather(packed(std::vector<char>(host.begin(), host.end())))) {
        const auto other = unpacked<char>(bytes);
        n_here += std::ranges::equal(other, host) ? 1 : 0;
    }
    const int threads = command.options.resources.threads;
    return command.chooses_threads ? std::max(1, threads / n_here) : threads;
}

std::vector<Index> read_labels(Communicator& comm, const SmoothCommand& command, const FaultLog& faults,
                               std::span<const std::int64_t> bounds)
{
    std::vector<Index> labels;
    comm.at_first_rank(
        [&] { labels = labels_of_faces(command.labels, static_cast<Index>(bounds.back()), faults.faces_left_out); });
    return hand_out(comm, labels, bounds);
}

std::vector<std::int64_t> read_fixed(Communicator& comm, const SmoothCommand& command, std::int64_t n_vertices)
{
    std::vector<std::int64_t> own;
    comm.at_first_rank([&] {
        if (command.fix.empty())
            return;
        const auto fixed = read_vertex_set(command.fix, static_cast<Index>(n_vertices), command.fix_property);
        own.assign(fixed.begin(), fixed.end());
    });
    return comm.gather_all(own);
}

void hold_in_part(const JoinedSeams& seams, std::vector<std::int64_t>& fixed, MeshPart& part)
{
    std::vector<std::int64_t> firsts;
    for (const SeamVertex& one : seams.vertices)
        if (std::ranges::binary_search(fixed, one.vertex))
            firsts.push_back(one.first);
    fixed.insert(fixed.end(), firsts.begin(), firsts.end());
    sort_unique(fixed);
    part.fixed.resize(part.vertex_numbers.size());
    std::ranges::transform(part.vertex_numbers, part.fixed.begin(),
                           [&](std::int64_t number) { return std::ranges::binary_search(fixed, number) ? 1 : 0; });
}

std::vector<double> read_weights(Communicator& comm, const SmoothCommand& command, std::int64_t n_vertices)
{
    std::vector<double> weights;
    comm.at_first_rank([&] {
        if (!command.attach_weights.empty())
            weights =
                read_vertex_weights(command.attach_weights, static_cast<Index>(n_vertices), command.attach_property);
    });
    return weights;
}

std::vector<double> read_strengths(Communicator& comm, const SmoothCommand& command, const PolygonMesh* whole,
                                   RunRecord& run, std::int64_t n_vertices)
{
    std::vector<double> strengths;
    comm.at_first_rank([&] {
        if (command.feather && whole == nullptr)
            throw OptionError(
                "--feather needs distances on the whole mesh, which no rank has read: let rank 0 read all "
                "of INPUT with a larger --whole-up-to, or use smooth");
        strengths = read_region(command, static_cast<Index>(n_vertices));
        if (whole != nullptr)
            feather(command, *whole, run_in_parallel, run, strengths);
    });
    return strengths;
}

std::vector<double> deal_to_vertices(Communicator& comm, std::vector<double> of_all, const JoinedSeams& seams,
                                     OfSeam of_seam, std::span<const std::int64_t> numbers,
                                     std::span<const std::int64_t> bounds)
{
    if (comm.broadcast(std::vector<char>{static_cast<char>(of_all.empty() ? 0 : 1)}).front() == 0)
        return {};
    if (comm.rank() == 0)
        for (const SeamVertex& one : seams.vertices) {
            double& first = of_all[static_cast<std::size_t>(one.first)];
            const double own = of_all[static_cast<std::size_t>(one.vertex)];
            first = of_seam == OfSeam::Least ? std::min(first, own) : std::max(first, own);
        }
    const std::vector<double> own = hand_out(comm, of_all, bounds);
    std::vector<double> dealt(numbers.size());
    fetch_rows(comm, {own, 1}, numbers, bounds, dealt);
    return dealt;
}

}  // namespace seamflow
