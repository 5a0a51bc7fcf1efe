#include "engine/distributed/cut/mending.h"

#include <algorithm>
#include <map>
#include <utility>

#include "engine/distributed/cut/band.h"
#include "engine/distributed/cut/loose_parts.h"
#include "engine/tasks/parallel_executor.h"
#include "partition/index_lists.h"
#include "partition/labels.h"
#include "partition/repair/pinches.h"

namespace seamflow {

namespace {

using Number = std::int64_t;

/// Rounds after which pinched parts are merged.
constexpr int max_rounds = 12;
/// Mending at a vertex looks at the second layer around it, and at vertices of the first there may be more to mend.
constexpr int layers_around_pinches = 4;

/// A face and the part that it moves to.
struct Moved {
    Number face;
    Index label;
};

/// Mends a cut round by round. Every function is called by all ranks together; data of rank 0 alone is empty at the
/// others.
class Mender {
  public:
    Mender(Communicator& comm, const SlicedCut& cut, SlicedDefects defects, Index n_parts)
        : comm_(comm)
        , cut_(cut)
        , parts_(std::move(defects.parts))
        , queue_(std::move(defects.vertices))
        , n_parts_(n_parts)
    {
    }

    void run()
    {
        for (int round = 0;; ++round) {
            join_loose();
            const std::vector<Number> pinched = keep_pinched();
            if (!anywhere(!pinched.empty()))
                return;
            if (round >= max_rounds) {
                merge_pinched_at(pinched);
                queue_ = pinched;
            } else {
                mend_at(pinched);
            }
        }
    }

  private:
    [[nodiscard]] bool anywhere(bool at_first)
    {
        return comm_.broadcast(std::vector<std::uint8_t>{at_first ? std::uint8_t{1} : std::uint8_t{0}}).front() != 0;
    }

    [[nodiscard]] Band band_around(const std::vector<Number>& vertices, int layers)
    {
        return gather_band(comm_, cut_.slice, cut_.bounds, vertices, layers);
    }

    /// Looks at the parts that may not be connected.
    void join_loose()
    {
        if (parts_.empty())
            return;
        const LooseFaces all = gather_loose(comm_, cut_, parts_);
        parts_.clear();
        if (!anywhere(!all.faces.empty()))
            return;
        std::vector<Number> corners = all.corners;
        sort_unique(corners);
        const Band band = band_around(corners, 1);
        std::vector<Moved> moved;
        if (comm_.rank() == 0) {
            const IndexLists components = components_in(band, all);
            const std::vector<Index> joined = join_to_neighbours(band, components, n_parts_);
            for (Index component = 0; component < components.size(); ++component)
                for (const Index f : components[component])
                    moved.push_back({band.part.face_numbers[f], joined[component]});
        }
        n_parts_ = comm_.broadcast(std::vector<Index>{n_parts_}).front();
        apply(moved);
        queue_.insert(queue_.end(), corners.begin(), corners.end());
        sort_unique(queue_);
    }

    /// Empties the queue. @returns its vertices at which a part is pinched, ascending.
    std::vector<Number> keep_pinched()
    {
        if (!anywhere(!queue_.empty()))
            return {};
        Band band = band_around(queue_, 1);
        queue_.clear();
        const Topology topology = make_topology(band.part.mesh, run_in_parallel);
        std::vector<Index> labels = band.part.labels;
        const Index n_labels = compact_labels(labels);
        PinchMender pinches(band.part.mesh, topology, labels, n_labels);
        std::vector<Number> pinched;
        for (Index v = 0; v < band.part.mesh.n_vertices(); ++v)
            if (band.is_whole[v] != 0 && pinches.pinches_at(v) > 0)
                pinched.push_back(band.part.vertex_numbers[v]);
        return pinched;
    }

    void mend_at(const std::vector<Number>& pinched)
    {
        const Band band = band_around(pinched, layers_around_pinches);
        std::vector<Moved> moved;
        std::vector<Index> touched;
        if (comm_.rank() == 0)
            mend_within(band, pinched, moved, touched);
        parts_ = comm_.broadcast(touched);
        apply(moved);
    }

    /// @param moved receives the faces whose labels change, @param touched their previous labels, ascending.
    void mend_within(const Band& band, const std::vector<Number>& pinched, std::vector<Moved>& moved,
                     std::vector<Index>& touched);
    void merge_pinched_at(const std::vector<Number>& pinched);

    /// @param moved of rank 0.
    void apply(const std::vector<Moved>& moved)
    {
        const auto& faces = cut_.bounds.faces;
        std::vector<std::vector<Moved>> to_homes(comm_.size());
        for (const Moved& face : moved)
            to_homes[range_of(faces, face.face)].push_back(face);
        std::vector<Bytes> sent;
        for (const auto& of_home : to_homes)
            sent.push_back(packed(of_home));
        for (const auto& [face, label] : unpacked<Moved>(comm_.exchange(std::move(sent)).front()))
            cut_.slice.labels[face - faces[comm_.rank()]] = label;
    }

    Communicator& comm_;
    SlicedCut cut_;
    /// Parts that may not be connected, at all ranks.
    std::vector<Index> parts_;
    /// Vertices to look at, ascending; at rank 0.
    std::vector<Number> queue_;
    Index n_parts_;
};

void Mender::mend_within(const Band& band, const std::vector<Number>& pinched, std::vector<Moved>& moved,
                         std::vector<Index>& touched)
{
    const PolygonMesh& mesh = band.part.mesh;
    const Topology topology = make_topology(mesh, run_in_parallel);
    std::vector<Index> values = band.part.labels;
    sort_unique(values);
    std::vector<Index> labels = band.part.labels;
    PinchMender mender(mesh, topology, labels, compact_labels(labels));
    mender.count_faces();
    const std::vector<Index> before = labels;
    // Whether the band covers mending at a vertex.
    const auto is_in_sight = [&](Index v) {
        const auto is_whole = [&](Index corner) { return band.is_whole[corner] != 0; };
        return std::ranges::all_of(topology.corners_at(v), [&](Index corner) {
            return std::ranges::all_of(mesh.face(topology.face_of[corner]), is_whole);
        });
    };
    std::vector<Index> next;
    for (const Number number : pinched)
        next.push_back(place_in(band.part.vertex_numbers, number));
    for (int round = 0; round < max_rounds && !next.empty(); ++round) {
        std::vector<Index> faces;
        std::vector<Index> labels_before;
        for (const Index v : std::exchange(next, {}))
            if (is_in_sight(v))
                mender.mend(v, faces, labels_before);
            else
                queue_.push_back(band.part.vertex_numbers[v]);
        for (const Index f : faces)
            next.insert(next.end(), mesh.face(f).begin(), mesh.face(f).end());
        sort_unique(next);
        for (const Index f : faces)
            for (const Index v : mesh.face(f))
                queue_.push_back(band.part.vertex_numbers[v]);
    }
    sort_unique(queue_);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        if (labels[f] != before[f]) {
            moved.push_back({band.part.face_numbers[f], values[labels[f]]});
            touched.push_back(values[before[f]]);
        }
    sort_unique(touched);
}

/// Merges each pinched part with one of those between its fans.
void Mender::merge_pinched_at(const std::vector<Number>& pinched)
{
    const Band band = band_around(pinched, 1);
    // Pairs of labels, one after the other: the second becomes the first.
    std::vector<Index> pairs;
    if (comm_.rank() == 0) {
        const Topology topology = make_topology(band.part.mesh, run_in_parallel);
        std::vector<Index> values = band.part.labels;
        sort_unique(values);
        std::vector<Index> labels = band.part.labels;
        PinchMender pinches(band.part.mesh, topology, labels, compact_labels(labels));
        pinches.count_faces();
        std::map<Index, Index> merged_into;
        const auto root_of = [&](Index label) {
            for (auto found = merged_into.find(label); found != merged_into.end(); found = merged_into.find(label))
                label = found->second;
            return label;
        };
        for (const Number number : pinched) {
            const auto v = place_in(band.part.vertex_numbers, number);
            const auto [larger, smaller] = pinches.pinched_and_between(v);
            const Index root = root_of(values[larger]);
            if (const Index other = root_of(values[smaller]); other != root)
                merged_into[other] = root;
        }
        for (const auto& [from, to] : merged_into) {
            pairs.push_back(root_of(to));
            pairs.push_back(from);
        }
    }
    pairs = comm_.broadcast(pairs);
    std::map<Index, Index> name;
    for (std::size_t i = 0; i < pairs.size(); i += 2)
        name[pairs[i + 1]] = pairs[i];
    for (Index& label : cut_.slice.labels)
        if (const auto found = name.find(label); found != name.end())
            label = found->second;
}

}  // namespace

void mend_together(Communicator& comm, SlicedCut cut, SlicedDefects defects, Index n_parts)
{
    Mender(comm, cut, std::move(defects), n_parts).run();
}

Index compact_labels_together(Communicator& comm, std::vector<Index>& labels)
{
    std::vector<Index> names = labels;
    sort_unique(names);
    names = comm.gather_all(names);
    sort_unique(names);
    for_each(run_in_parallel, static_cast<Index>(labels.size()),
             [&](Index f) { labels[f] = place_in(names, labels[f]); });
    return static_cast<Index>(names.size());
}

}  // namespace seamflow
