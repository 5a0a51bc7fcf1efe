#include "partition/repair/pinches.h"

#include <algorithm>
#include <numeric>

#include "partition/connected_components.h"
#include "partition/index_lists.h"
#include "partition/labels.h"

namespace seamflow {

namespace {

/// The number of runs minus the number of labels at an interior vertex.
/// @pre Faces of at least two labels meet at v (see is_mixed).
Index excess_runs_at_interior(const PolygonMesh& mesh, const Topology& topology, const std::vector<Index>& labels,
                              Index v)
{
    const auto label_of = [&](Index halfedge) { return labels[topology.face_of[halfedge]]; };
    const auto corners = topology.corners_at(v);
    // Twice the number of edges at v between two faces of one part.
    std::size_t n_half_joints = 0;
    for (const Index corner : corners)
        for (const Index spoke : {corner, topology.previous(mesh, corner)})
            n_half_joints += label_of(topology.twin[spoke]) == label_of(corner) ? 1 : 0;
    // Each run has one face more than edges between two of its faces.
    const std::size_t n_runs = corners.size() - n_half_joints / 2;
    // There are at least two labels, so that with two runs none is pinched.
    if (n_runs == 2)
        return 0;
    std::vector<Index> around;
    labels_around(topology, labels, v, around);
    return static_cast<Index>(n_runs - around.size());
}

/// The label into which a label has finally been merged. Halves the chain of labels between them.
/// @param parent the label into which each label was merged; itself if it was not.
Index merged_into(std::vector<Index>& parent, Index label)
{
    while (parent[label] != label) {
        parent[label] = parent[parent[label]];
        label = parent[label];
    }
    return label;
}

}  // namespace

bool may_be_pinched(const PolygonMesh& mesh, const Topology& topology, const std::vector<Index>& labels, Index v)
{
    return is_mixed(topology, labels, v) &&
           (topology.kind[v] != VertexKind::Interior || excess_runs_at_interior(mesh, topology, labels, v) > 0);
}

PinchMender::PinchMender(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels, Index n_labels)
    : mesh_(mesh)
    , topology_(topology)
    , labels_(labels)
    , n_faces_(n_labels)
    , last_call_with_label_(n_labels, 0)
{
}

void PinchMender::count_faces(const Executor& exec)
{
    n_faces_ = sums_by_value(
        exec, mesh_.n_faces(), static_cast<Index>(n_faces_.size()), [&](Index f) { return labels_[f]; },
        [](Index) { return 1; });
}

/// Sets runs_.
void PinchMender::find_runs(const Fan& fan)
{
    runs_.clear();
    for (std::size_t i = 0; i < fan.corners.size(); ++i) {
        const Index label = labels_[topology_.face_of[fan.corners[i]]];
        if (runs_.empty() || runs_.back().label != label)
            runs_.push_back({label, i, 0});
        ++runs_.back().count;
    }
    if (fan.closed && runs_.size() > 1 && runs_.front().label == runs_.back().label) {
        runs_.front().begin = runs_.back().begin;
        runs_.front().count += runs_.back().count;
        runs_.pop_back();
    }
}

/// Returns the number of runs minus the number of labels in runs_; if that is not zero, sets pinched_label_ to a label
/// with several runs.
Index PinchMender::count_excess_runs()
{
    ++call_;
    Index excess = 0;
    for (const Run& run : runs_) {
        if (last_call_with_label_[run.label] == call_) {
            ++excess;
            pinched_label_ = run.label;
        }
        last_call_with_label_[run.label] = call_;
    }
    return excess;
}

Index PinchMender::pinches_at(Index v)
{
    if (!is_mixed(topology_, labels_, v))
        return 0;
    if (topology_.kind[v] == VertexKind::Interior)
        return excess_runs_at_interior(mesh_, topology_, labels_, v);
    Index excess = 0;
    for (const Fan& fan : fans_at(mesh_, topology_, v, {}, 0)) {
        find_runs(fan);
        excess += count_excess_runs();
    }
    return excess;
}

/// The first fan at v with a pinch; its runs are in runs_. A fan without faces if there is no pinch.
Fan PinchMender::find_pinch(Index v)
{
    if (pinches_at(v) > 0)
        for (Fan& fan : fans_at(mesh_, topology_, v, {}, 0)) {
            find_runs(fan);
            if (count_excess_runs() > 0)
                return std::move(fan);
        }
    return {};
}

/// A candidate move: the faces of the runs first_run to last_run - 1 get another label. Run numbers beyond the last run
/// of the fan begin again at its first.
void PinchMender::propose(const Fan& fan, std::size_t first_run, std::size_t last_run, Index label)
{
    Move& move = moves_.emplace_back();
    move.label = label;
    for (std::size_t r = first_run; r < last_run; ++r) {
        const Run& run = runs_[r % runs_.size()];
        for (std::size_t i = run.begin; i < run.begin + run.count; ++i)
            move.faces.push_back(topology_.face_of[fan.corners[i % fan.corners.size()]]);
    }
}

/// Proposes to fill the smallest gap between two runs of the pinched part.
void PinchMender::propose_filling(const Fan& fan)
{
    const std::size_t n = runs_.size();
    const std::size_t end = fan.closed ? 2 * n : n;
    std::size_t gap_begin = 0;
    std::size_t gap_end = 0;
    std::size_t fewest = fan.corners.size() + 1;
    std::size_t run_before = end;
    std::size_t faces_since = 0;
    for (std::size_t r = 0; r < end; ++r) {
        if (runs_[r % n].label != pinched_label_) {
            faces_since += runs_[r % n].count;
            continue;
        }
        if (run_before < end && faces_since < fewest) {
            fewest = faces_since;
            gap_begin = run_before + 1;
            gap_end = r;
        }
        run_before = r;
        faces_since = 0;
    }
    propose(fan, gap_begin, gap_end, pinched_label_);
}

/// Candidate moves: the smallest run of the pinched part gets the label of the run before or after it.
void PinchMender::propose_giving(const Fan& fan)
{
    const std::size_t n = runs_.size();
    std::size_t smallest = n;
    for (std::size_t r = 0; r < n; ++r)
        if (runs_[r].label == pinched_label_ && (smallest == n || runs_[r].count < runs_[smallest].count))
            smallest = r;
    if (fan.closed || smallest + 1 < n)
        propose(fan, smallest, smallest + 1, runs_[(smallest + 1) % n].label);
    if (fan.closed || smallest > 0)
        propose(fan, smallest, smallest + 1, runs_[(smallest + n - 1) % n].label);
}

/// Moves a face to another part, and updates n_faces_.
void PinchMender::set_label(Index f, Index label)
{
    --n_faces_[labels_[f]];
    ++n_faces_[label];
    labels_[f] = label;
}

/// The number of pinches at the vertices of the faces.
Index PinchMender::pinches_around(const std::vector<Index>& faces)
{
    nearby_.clear();
    for (const Index f : faces)
        nearby_.insert(nearby_.end(), mesh_.face(f).begin(), mesh_.face(f).end());
    sort_unique(nearby_);
    Index pinches = 0;
    for (const Index v : nearby_)
        pinches += pinches_at(v);
    return pinches;
}

/// The length of the edges between the faces and faces of other labels; edges between two of the faces count twice.
double PinchMender::cut_length_around(const std::vector<Index>& faces) const
{
    double length = 0;
    for (const Index f : faces)
        for_each_neighbour(mesh_, topology_, f, [&](Index h, Index across) {
            if (labels_[across] != labels_[f])
                length += edge_length(mesh_, topology_, h);
        });
    return length;
}

/// The cost of the move; leaves the labels unchanged.
PinchMender::Cost PinchMender::try_out(const Move& move)
{
    Cost cost{0, -pinches_around(move.faces), move.faces.size(), -cut_length_around(move.faces)};
    labels_before_.clear();
    for (const Index f : move.faces) {
        labels_before_.push_back(labels_[f]);
        set_label(f, move.label);
        if (n_faces_[labels_before_.back()] == 0)
            ++cost.parts_used_up;
    }
    cost.pinches += pinches_around(move.faces);
    cost.cut_length += cut_length_around(move.faces);
    for (std::size_t i = 0; i < move.faces.size(); ++i)
        set_label(move.faces[i], labels_before_[i]);
    return cost;
}

void PinchMender::mend(Index v, std::vector<Index>& moved, std::vector<Index>& labels_before)
{
    for (Fan fan = find_pinch(v); !fan.corners.empty(); fan = find_pinch(v)) {
        moves_.clear();
        propose_filling(fan);
        propose_giving(fan);
        std::size_t best = 0;
        Cost best_cost = try_out(moves_[0]);
        for (std::size_t i = 1; i < moves_.size(); ++i)
            if (const Cost cost = try_out(moves_[i]); cost < best_cost) {
                best = i;
                best_cost = cost;
            }
        for (const Index f : moves_[best].faces) {
            labels_before.push_back(labels_[f]);
            moved.push_back(f);
            set_label(f, moves_[best].label);
        }
    }
}

std::pair<Index, Index> PinchMender::pinched_and_between(Index v)
{
    const Fan fan = find_pinch(v);
    const std::size_t n = runs_.size();
    std::size_t first = 0;
    while (runs_[first].label != pinched_label_)
        ++first;
    std::size_t last = n;
    while (runs_[last - 1].label != pinched_label_)
        --last;
    // The smallest part that may be merged: a part next to a run of the pinched part, so that the two share an edge. In
    // an open fan it lies between two runs of that part.
    Index between = -1;
    for (std::size_t r = fan.closed ? 0 : first; r < (fan.closed ? n : last); ++r) {
        const Index label = runs_[r].label;
        const bool beside =
            runs_[(r + 1) % n].label == pinched_label_ || runs_[(r + n - 1) % n].label == pinched_label_;
        if (label != pinched_label_ && beside && (between < 0 || n_faces_[label] < n_faces_[between]))
            between = label;
    }
    if (n_faces_[pinched_label_] < n_faces_[between])
        return {between, pinched_label_};
    return {pinched_label_, between};
}

void merge_pinched(const PolygonMesh& mesh, const Topology& topology, Index n_labels, std::vector<Index>& labels)
{
    PinchMender mender(mesh, topology, labels, n_labels);
    std::vector<Index> vertices = mixed_vertices(topology, labels);
    std::vector<Index> parent(n_labels);
    std::iota(parent.begin(), parent.end(), 0);
    for (bool merged = true; merged;) {
        merged = false;
        mender.count_faces();
        std::erase_if(vertices, [&](Index v) { return !is_mixed(topology, labels, v); });
        for (const Index v : vertices) {
            if (mender.pinches_at(v) == 0)
                continue;
            const auto [larger, smaller] = mender.pinched_and_between(v);
            const Index root = merged_into(parent, larger);
            parent[merged_into(parent, smaller)] = root;
            merged = true;
        }
        for (Index& label : labels)
            label = merged_into(parent, label);
    }
}

}  // namespace seamflow
