#include "partition/repair/pinches.h"

#include <algorithm>

#include "partition/labels.h"

namespace seamflow {

bool may_be_pinched(const PolygonMesh& mesh, const Topology& topology, const std::vector<Index>& labels, Index v)
{
    if (!is_mixed(topology, labels, v))
        return false;
    if (topology.kind[v] != VertexKind::Interior)
        return true;
    const auto label_of = [&](Index halfedge) { return labels[topology.face_of[halfedge]]; };
    const auto corners = topology.corners_at(v);
    std::size_t n_half_joints = 0;
    for (const Index corner : corners)
        for (const Index spoke : {corner, topology.previous(mesh, corner)})
            n_half_joints += label_of(topology.twin[spoke]) == label_of(corner) ? 1 : 0;
    // Each run has one face more than edges between two of its faces.
    const std::size_t n_runs = corners.size() - n_half_joints / 2;
    // There are two labels at least: with one run each, none is pinched.
    if (n_runs == 2)
        return false;
    std::vector<Index> around;
    labels_around(topology, labels, v, around);
    return n_runs > around.size();
}

PinchMender::PinchMender(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels, Index n_labels)
    : mesh_(mesh)
    , topology_(topology)
    , labels_(labels)
    , walker_(mesh, topology)
    , n_faces_(n_labels)
    , met_in_count_(n_labels, 0)
{
}

void PinchMender::count_faces(const Loop& loop)
{
    n_faces_ = sums_by_value(
        loop, mesh_.n_faces(), static_cast<Index>(n_faces_.size()), [&](Index f) { return labels_[f]; },
        [](Index) { return 1; });
}

void PinchMender::find_runs(const FanWalker::Fan& fan)
{
    runs_.clear();
    for (std::size_t i = 0; i < fan.faces.size(); ++i) {
        const Index label = labels_[fan.faces[i]];
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

/// The number of runs less the number of labels; sets pinched_label_ if that is not zero.
Index PinchMender::count_excess_runs()
{
    ++count_;
    Index excess = 0;
    for (const Run& run : runs_) {
        if (met_in_count_[run.label] == count_) {
            ++excess;
            pinched_label_ = run.label;
        }
        met_in_count_[run.label] = count_;
    }
    return excess;
}

Index PinchMender::pinches_at(Index v)
{
    if (!is_mixed(topology_, labels_, v))
        return 0;
    Index excess = 0;
    for (const FanWalker::Fan& fan : walker_.at_vertex(v)) {
        find_runs(fan);
        excess += count_excess_runs();
    }
    return excess;
}

/// The first fan at v with a pinch, and its runs in runs_; no faces if there is none.
FanWalker::Fan PinchMender::find_pinch(Index v)
{
    if (is_mixed(topology_, labels_, v))
        for (const FanWalker::Fan& fan : walker_.at_vertex(v)) {
            find_runs(fan);
            if (count_excess_runs() > 0)
                return fan;
        }
    return {};
}

/// Proposes to give the faces of some runs in a row, counted around the end of the fan, to another part.
void PinchMender::propose(const FanWalker::Fan& fan, std::size_t first_run, std::size_t last_run, Index label)
{
    Move& move = moves_.emplace_back();
    move.label = label;
    for (std::size_t r = first_run; r < last_run; ++r) {
        const Run& run = runs_[r % runs_.size()];
        for (std::size_t i = run.begin; i < run.begin + run.count; ++i)
            move.faces.push_back(fan.faces[i % fan.faces.size()]);
    }
}

/// Proposes to fill the smallest gap between two runs of the pinched part.
void PinchMender::propose_filling(const FanWalker::Fan& fan)
{
    const std::size_t n = runs_.size();
    const std::size_t end = fan.closed ? 2 * n : n;
    std::size_t gap_begin = 0;
    std::size_t gap_end = 0;
    std::size_t fewest = fan.faces.size() + 1;
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

/// Proposes to give the smallest run of the pinched part to the part on its one side or the other.
void PinchMender::propose_giving(const FanWalker::Fan& fan)
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

void PinchMender::set_label(Index f, Index label)
{
    --n_faces_[labels_[f]];
    ++n_faces_[label];
    labels_[f] = label;
}

Index PinchMender::pinches_around(const std::vector<Index>& faces)
{
    nearby_.clear();
    for (const Index f : faces)
        nearby_.insert(nearby_.end(), mesh_.face(f).begin(), mesh_.face(f).end());
    std::sort(nearby_.begin(), nearby_.end());
    nearby_.erase(std::unique(nearby_.begin(), nearby_.end()), nearby_.end());
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
        for (Index h = mesh_.face_offsets[f]; h < mesh_.face_offsets[f + 1]; ++h) {
            const Index twin = topology_.twin[h];
            if (twin < 0 || labels_[topology_.face_of[twin]] == labels_[f])
                continue;
            const Index from = mesh_.face_vertices[h];
            const Index to = mesh_.face_vertices[topology_.next(mesh_, h)];
            length += (mesh_.vertices.row(from) - mesh_.vertices.row(to)).norm();
        }
    return length;
}

/// What the move would cost; leaves the labels as they are.
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
    for (FanWalker::Fan fan = find_pinch(v); !fan.faces.empty(); fan = find_pinch(v)) {
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
    const FanWalker::Fan fan = find_pinch(v);
    const std::size_t n = runs_.size();
    std::size_t first = 0;
    while (runs_[first].label != pinched_label_)
        ++first;
    std::size_t last = n;
    while (runs_[last - 1].label != pinched_label_)
        --last;
    // Next to a run of the pinched part, so that the two share an edge; in an open fan between two of its runs.
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

}  // namespace seamflow
