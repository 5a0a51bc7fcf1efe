#include "engine/distributed/cut/distributed_cut.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "engine/distributed/cut/chunk_cut.h"
#include "engine/distributed/cut/chunks.h"
#include "engine/distributed/cut/face_homes.h"
#include "engine/distributed/cut/mending.h"
#include "engine/measure/remarks.h"
#include "engine/measure/surface_measures.h"
#include "engine/setup/automatic_choices.h"
#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/workers.h"
#include "partition/cut/cut.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

using Number = std::int64_t;

void put(Packer& packer, const std::string& text)
{
    packer.put_all(std::span(text));
}

std::string get_text(Unpacker& unpacker)
{
    const auto text = unpacker.get_all<char>();
    return {text.begin(), text.end()};
}

/// Broadcasts the cut that one rank found.
DistributedCut broadcast(Communicator& comm, const DistributedCut& found, bool is_own)
{
    Packer packer;
    if (is_own) {
        packer.put(found.n_parts);
        packer.put(found.repaired_faces);
        put(packer, found.choice);
        for (const std::string& remark : found.remarks)
            put(packer, remark);
    }
    DistributedCut cut;
    for (const Bytes& bytes : comm.allgather(packer.take())) {
        if (bytes.empty())
            continue;
        Unpacker unpacker(bytes);
        cut.n_parts = unpacker.get<Index>();
        cut.repaired_faces = unpacker.get<std::int64_t>();
        cut.choice = get_text(unpacker);
        while (!unpacker.is_at_end())
            cut.remarks.push_back(get_text(unpacker));
    }
    return cut;
}

/// The sum of one number of each rank.
Number sum_of(Communicator& comm, Number own)
{
    Number sum = 0;
    for (const Number of_rank : comm.gather_all(std::vector<Number>{own}))
        sum += of_rank;
    return sum;
}

/// Adds the ends of half-edges without twins.
/// @param crossing ascending: those whose twins are in other chunks.
void add_boundary(const MeshPart& part, const Topology& topology, std::span<const Index> crossing,
                  std::vector<Number>& vertices)
{
    const PolygonMesh& mesh = part.mesh;
    const auto is_open = [&](Index h) { return topology.twin[h] < 0 && !std::ranges::binary_search(crossing, h); };
    for (const Index h : select(run_in_parallel, mesh.n_corners(), is_open))
        for (const Index v : {mesh.face_vertices[h], mesh.face_vertices[topology.next(mesh, h)]})
            vertices.push_back(part.vertex_numbers[v]);
}

/// A cut that all ranks make together.
class TogetherCut {
  public:
    /// @param given the labels of the range; empty: the options say how to cut.
    TogetherCut(Communicator& comm, RankSlice& slice, const FlowOptions& options, const CutUnits& units,
                std::optional<std::vector<Index>> given)
        : comm_(comm)
        , slice_(slice)
        , bounds_(gather_bounds(comm, slice))
        , options_(options)
        , units_(units)
        , given_(std::move(given))
        , may_join_(options.motion.weld.has_value())
        , n_still_(sum_of(comm, slice.n_still))
    {
        require_corners(slice, bounds_, comm.rank());
    }

    DistributedCut run()
    {
        std::optional<DistributedCut> cut;
        // Repeated if seams were joined or faces had to be left out.
        while (!cut && bounds_.faces.back() > 0)
            cut = bounds_.faces.back() <= units_.faces_of_chunk ? by_one_rank() : by_all_ranks();
        if (!cut)
            cut.emplace();
        if (!seams_.remark.empty())
            cut->remarks.push_back(seams_.remark);
        if (const Number n = sum_of(comm_, std::ssize(left_out_.faces)); n > 0)
            cut->remarks.push_back(remark_on_repeated_faces(n));
        cut->seams = std::move(seams_);
        cut->left_out = std::move(left_out_);
        return *std::move(cut);
    }

  private:
    /// The number of parts asked for, or the one that suits the mesh.
    Index number_of_parts(double area, std::string& reason) const
    {
        if (options_.cut.subdomains > 0)
            return options_.cut.subdomains;
        MeshSize size;
        size.vertices = static_cast<Index>(
            std::min<Number>(bounds_.vertices.back() - n_still_ - seams_.n_copies, std::numeric_limits<Index>::max()));
        size.area = area;
        const bool is_converged =
            options_.accuracy.approach == Approach::Converged || options_.accuracy.tolerance.has_value();
        const SubdomainChoice choice =
            choose_subdomains(size, options_.time_step, needs_of(options_.laplacian, is_converged));
        reason = choice.reason + ".";
        return choice.count;
    }

    /// @param boundary see join_seams. @returns whether seams were joined.
    bool join(const std::vector<Number>& boundary)
    {
        seams_ = join_seams(comm_, slice_, bounds_, boundary, *options_.motion.weld);
        return !seams_.vertices.empty();
    }

    /// @returns nothing where seams were joined, or faces had to be left out.
    std::optional<DistributedCut> by_one_rank()
    {
        slice_.labels.assign(at(slice_.n_faces()), 0);
        MeshPart part = deal(comm_, slice_);
        const bool is_own = part.mesh.n_faces() > 0;
        const Topology topology = make_topology(part.mesh, run_in_parallel);
        if (std::vector<Number> boundary; std::exchange(may_join_, false)) {
            add_boundary(part, topology, {}, boundary);
            if (join(boundary))
                return {};
        }
        if (std::vector<Repetition> repeated; may_repeat_) {
            find_repetitions(part, topology, repeated);
            may_repeat_ = false;
            if (leave_out_repeated(comm_, repeated, slice_, given_, left_out_)) {
                bounds_ = gather_bounds(comm_, slice_);
                return {};
            }
        }
        const std::vector<Index> given =
            given_ ? fetch_labels(comm_, *given_, bounds_, part.face_numbers) : std::vector<Index>{};
        DistributedCut found;
        if (is_own) {
            Cut cut = given_ ? cut_by_labels(part.mesh, topology, given, run_in_parallel)
                             : cut_into(part.mesh, topology, number_of_parts(total_area(part.mesh), found.choice),
                                        run_in_parallel);
            part.labels = std::move(cut.labels);
            found.n_parts = cut.n_parts;
            found.repaired_faces = cut.repaired_faces;
            found.remarks = std::move(cut.remarks);
        }
        const MeshPart* const own[] = {&part};
        std::vector<std::uint8_t> twins;
        send_home(
            comm_, bounds_, own, [](std::size_t, Index) { return false; }, slice_, twins);
        return broadcast(comm_, found, is_own);
    }

    /// @returns nothing where seams were joined, or faces had to be left out.
    std::optional<DistributedCut> by_all_ranks()
    {
        label_chunks(comm_, slice_, bounds_, units_.faces_of_chunk);
        std::vector<Chunk> chunks = deal_chunks(comm_, slice_, bounds_);
        if (std::vector<Number> boundary; std::exchange(may_join_, false)) {
            for (const Chunk& chunk : chunks)
                add_boundary(chunk.part, chunk.topology, chunk.crossing, boundary);
            if (join(boundary))
                return {};
        }
        if (std::vector<Repetition> repeated; may_repeat_) {
            // Faces with the same corners are in the same chunk.
            for (const Chunk& chunk : chunks)
                find_repetitions(chunk.part, chunk.topology, repeated);
            may_repeat_ = false;
            if (leave_out_repeated(comm_, repeated, slice_, given_, left_out_)) {
                bounds_ = gather_bounds(comm_, slice_);
                return {};
            }
        }
        DistributedCut found;
        SlicedDefects defects;
        Index n_parts = 0;
        Index n_components = 0;
        Index k = 1;
        if (!given_) {
            k = number_of_parts(area_of(chunks), found.choice);
            if (k == 1)
                return uncut(std::move(found));
            const double weight = static_cast<double>(sum_of(comm_, std::ssize(slice_.corners))) -
                                  2.0 * static_cast<double>(bounds_.faces.back());
            ChunkCut cut = cut_chunks(comm_, bounds_, chunks, weight, sensible_parts(bounds_.faces.back(), k),
                                      units_.chunks_of_block);
            n_parts = cut.n_parts;
            n_components = cut.n_components;
            defects.parts = std::move(cut.suspects);
        } else {
            std::vector<Index> closed = *given_;
            n_parts = compact_labels_together(comm_, closed);
            if (n_parts == 1)
                return uncut(std::move(found));
            label_by(closed, chunks);
            defects.parts.resize(n_parts);
            std::iota(defects.parts.begin(), defects.parts.end(), 0);
        }
        defects.vertices = gather_pinch_candidates(comm_, bounds_, chunks);
        mend(std::move(chunks), std::move(defects), n_parts, found);
        if (given_)
            found.remarks = remarks_on_labels(n_parts, largest_given(), found.repaired_faces, found.n_parts);
        else if (std::string remark = remark_on_number(bounds_.faces.back(), k, found.n_parts, n_components);
                 !remark.empty())
            found.remarks.push_back(std::move(remark));
        return found;
    }

    /// Sums chunk by chunk, independently of the number of ranks.
    double area_of(const std::vector<Chunk>& chunks)
    {
        std::vector<double> areas;
        for (const Chunk& chunk : chunks)
            areas.push_back(total_area(chunk.part.mesh));
        double area = 0.0;
        for (const double of_chunk : comm_.gather_all(areas))
            area += of_chunk;
        return area;
    }

    DistributedCut uncut(DistributedCut found)
    {
        slice_.labels.assign(at(slice_.n_faces()), 0);
        found.n_parts = 1;
        return found;
    }

    void label_by(const std::vector<Index>& labels, std::vector<Chunk>& chunks)
    {
        std::vector<Number> faces;
        for (const Chunk& chunk : chunks)
            faces.insert(faces.end(), chunk.part.face_numbers.begin(), chunk.part.face_numbers.end());
        sort_unique(faces);
        const std::vector<Index> found = fetch_labels(comm_, labels, bounds_, faces);
        for (Chunk& chunk : chunks)
            for (std::size_t f = 0; f < chunk.part.face_numbers.size(); ++f)
                chunk.part.labels[f] = found[place_in(faces, chunk.part.face_numbers[f])];
    }

    /// @param chunks with their labels, which are sent to the ranges.
    void mend(std::vector<Chunk> chunks, SlicedDefects defects, Index n_parts, DistributedCut& found)
    {
        std::vector<const MeshPart*> parts;
        for (const Chunk& chunk : chunks)
            parts.push_back(&chunk.part);
        std::vector<std::uint8_t> twins;
        const auto has_twin = [&](std::size_t i, Index h) {
            return chunks[i].topology.twin[h] >= 0 || std::ranges::binary_search(chunks[i].crossing, h);
        };
        send_home(comm_, bounds_, parts, has_twin, slice_, twins);
        chunks = {};
        const std::vector<Index> before = slice_.labels;
        mend_together(comm_, {slice_, bounds_, twins}, std::move(defects), n_parts);
        Number moved = 0;
        for (std::size_t f = 0; f < before.size(); ++f)
            moved += before[f] != slice_.labels[f] ? 1 : 0;
        found.repaired_faces = sum_of(comm_, moved);
        found.n_parts = compact_labels_together(comm_, slice_.labels);
    }

    [[nodiscard]] Index largest_given()
    {
        const auto largest = std::ranges::max_element(*given_);
        const auto of_all = comm_.gather_all(std::vector<Index>{largest != given_->end() ? *largest : Index{0}});
        return *std::ranges::max_element(of_all);
    }

    Communicator& comm_;
    RankSlice& slice_;
    SliceBounds bounds_;
    const FlowOptions& options_;
    const CutUnits& units_;
    std::optional<std::vector<Index>> given_;
    bool may_join_;
    Number n_still_;
    bool may_repeat_ = true;
    JoinedSeams seams_;
    RepeatedFaces left_out_;
};

DistributedCut run(Communicator& comm, RankSlice& slice, const FlowOptions& options, const CutUnits& units,
                   std::optional<std::vector<Index>> given)
{
    DistributedCut cut;
    Workers workers(options.resources.threads);
    workers.execute([&] { cut = TogetherCut(comm, slice, options, units, std::move(given)).run(); });
    return cut;
}

}  // namespace

DistributedCut cut_together(Communicator& comm, RankSlice& slice, const FlowOptions& options, const CutUnits& units)
{
    return run(comm, slice, options, units, {});
}

DistributedCut cut_together_by_labels(Communicator& comm, RankSlice& slice, const FlowOptions& options,
                                      const CutUnits& units)
{
    return run(comm, slice, options, units, std::exchange(slice.labels, {}));
}

}  // namespace seamflow
