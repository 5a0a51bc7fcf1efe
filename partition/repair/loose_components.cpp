#include "partition/repair/loose_components.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "partition/connected_components.h"
#include "partition/index.h"
#include "partition/index_lists.h"

namespace seamflow {

namespace {

/// In component_of_: the face is in no loose component.
constexpr Index settled = -1;
/// In component_of_: the face is in a suspect part, and its component is not known yet.
constexpr Index unvisited = -2;

/// The loose components of the suspect parts, and the procedure that joins them.
class LooseComponents {
  public:
    LooseComponents(const PolygonMesh& mesh, const Topology& topology, std::vector<Index>& labels, std::size_t n_labels)
        : mesh_(mesh)
        , topology_(topology)
        , labels_(labels)
        , shared_length_(n_labels, 0.0)
    {
    }

    void find(const std::vector<bool>& suspects, const Executor& exec);
    std::vector<Index> join();

  private:
    void collect_component(Index f, IndexLists& components);
    void keep_loose_components(const IndexLists& components);
    void enqueue(Index component);
    Index best_neighbour(Index component);

    const PolygonMesh& mesh_;
    const Topology& topology_;
    std::vector<Index>& labels_;
    /// #F: the face's loose component, `settled` or `unvisited`.
    std::vector<Index> component_of_;
    IndexLists components_;
    /// One entry per loose component: whether it is or was in the queue.
    std::vector<bool> queued_;
    /// The loose components that have a settled face beside them, in the order in which they are joined.
    std::vector<Index> queue_;
    /// Scratch: one entry per label, zero between uses; and the labels that are not zero.
    std::vector<double> shared_length_;
    std::vector<Index> candidates_;
};

/// Appends the component of face f within its part; its faces become settled. Reads `component_of_` only for faces of
/// this part, so that parts can be searched at once.
void LooseComponents::collect_component(Index f, IndexLists& components)
{
    component_of_[f] = settled;
    append_reachable(f, components.values, [&](Index g, auto&& reach) {
        for_each_neighbour(mesh_, topology_, g, [&](Index, Index across) {
            if (labels_[across] != labels_[f] || component_of_[across] != unvisited)
                return;
            component_of_[across] = settled;
            reach(across);
        });
    });
    components.close();
}

/// Adds all components of a part except the largest to the loose components (components_).
void LooseComponents::keep_loose_components(const IndexLists& components)
{
    Index largest = 0;
    for (Index component = 1; component < components.size(); ++component)
        if (components[component].size() > components[largest].size())
            largest = component;
    for (Index component = 0; component < components.size(); ++component) {
        if (component == largest)
            continue;
        for (const Index f : components[component]) {
            component_of_[f] = components_.size();
            components_.values.push_back(f);
        }
        components_.close();
    }
}

/// Finds the components of each suspect part; all but its largest are loose.
void LooseComponents::find(const std::vector<bool>& suspects, const Executor& exec)
{
    component_of_.assign(labels_.size(), settled);
    std::vector<Index> lowest(suspects.size(), -1);
    std::vector<std::size_t> n_faces(suspects.size(), 0);
    for (Index f = 0; f < mesh_.n_faces(); ++f)
        if (const auto label = usize(labels_[f]); suspects[label]) {
            component_of_[f] = unvisited;
            if (n_faces[label]++ == 0)
                lowest[label] = f;
        }
    // Most parts consist only of the component with the lowest face.
    std::vector<IndexLists> found(suspects.size());
    for_each(exec, static_cast<Index>(found.size()), [&](Index label) {
        if (n_faces[label] == 0)
            return;
        collect_component(lowest[label], found[label]);
        const bool is_connected = found[label].values.size() == n_faces[label];
        if (is_connected)
            found[label] = {};
    });
    const auto is_left = [&](Index f) { return component_of_[f] == unvisited; };
    for (const Index f : select(exec, mesh_.n_faces(), is_left))
        if (is_left(f))
            collect_component(f, found[labels_[f]]);
    for (const IndexLists& components : found)
        if (components.size() > 0)
            keep_loose_components(components);
    queued_.assign(components_.size(), false);
}

/// Queues a component once, unless it is settled.
void LooseComponents::enqueue(Index component)
{
    if (component == settled || queued_[component])
        return;
    queued_[component] = true;
    queue_.push_back(component);
}

/// The settled part with the longest boundary to the component; of equals the one found first.
Index LooseComponents::best_neighbour(Index component)
{
    candidates_.clear();
    for (const Index f : components_[component])
        for_each_neighbour(mesh_, topology_, f, [&](Index h, Index g) {
            if (component_of_[g] != settled)
                return;
            double& length = shared_length_[labels_[g]];
            if (length == 0)
                candidates_.push_back(labels_[g]);
            // The length is not zero even for an edge without length, so that each neighbouring part becomes a
            // candidate once.
            length += 1e-300 + edge_length(mesh_, topology_, h);
        });
    const Index best = *std::max_element(candidates_.begin(), candidates_.end(),
                                         [&](Index a, Index b) { return shared_length_[a] < shared_length_[b]; });
    for (const Index label : candidates_)
        shared_length_[label] = 0;
    return best;
}

/// Joins the loose components to parts, ring by ring around the settled faces.
/// @returns the faces that changed their label.
std::vector<Index> LooseComponents::join()
{
    std::vector<Index> moved;
    for (const Index f : components_.values)
        for_each_neighbour(mesh_, topology_, f, [&](Index, Index g) {
            if (component_of_[g] == settled)
                enqueue(component_of_[f]);
        });
    for (std::size_t i = 0; i < queue_.size(); ++i) {
        const Index label = best_neighbour(queue_[i]);
        for (const Index f : components_[queue_[i]]) {
            labels_[f] = label;
            component_of_[f] = settled;
            moved.push_back(f);
        }
        for (const Index f : components_[queue_[i]])
            for_each_neighbour(mesh_, topology_, f, [&](Index, Index g) { enqueue(component_of_[g]); });
    }
    return moved;
}

}  // namespace

std::vector<Index> join_loose_components(const PolygonMesh& mesh, const Topology& topology,
                                         const std::vector<bool>& suspects, std::vector<Index>& labels,
                                         const Executor& exec)
{
    if (std::find(suspects.begin(), suspects.end(), true) == suspects.end())
        return {};
    LooseComponents components(mesh, topology, labels, suspects.size());
    components.find(suspects, exec);
    return components.join();
}

Index split_by_component(const PolygonMesh& mesh, const Topology& topology, Index n_labels, std::vector<Index>& labels)
{
    const Components components = face_components(mesh, topology);
    if (components.count() < 2)
        return n_labels;
    std::vector<Index> by_component(labels.size());
    std::iota(by_component.begin(), by_component.end(), 0);
    std::stable_sort(by_component.begin(), by_component.end(),
                     [&](Index f, Index g) { return components.component_of[f] < components.component_of[g]; });
    // For each label, the component in which it was seen last, and its new label there.
    std::vector<Index> component_of(n_labels, -1);
    std::vector<Index> name(n_labels, -1);
    Index n_names = n_labels;
    for (const Index f : by_component) {
        const auto label = usize(labels[f]);
        if (component_of[label] != components.component_of[f]) {
            name[label] = component_of[label] < 0 ? static_cast<Index>(label) : n_names++;
            component_of[label] = components.component_of[f];
        }
        labels[f] = name[label];
    }
    return n_names;
}

}  // namespace seamflow
