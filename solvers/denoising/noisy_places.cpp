#include "solvers/denoising/noisy_places.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "partition/index_lists.h"
#include "partition/vector_area.h"
#include "solvers/denoising/noise_evidence.h"
#include "solvers/denoising/normal_motion.h"
#include "solvers/denoising/position_filters.h"
#include "solvers/laplacian/geometry.h"

namespace seamflow {

namespace {

/// A component has noise if this fraction of its places has evidence for it. A component of few faces, whose few places
/// bend more from edge to edge, needs clear evidence, and so does a surface that was thinned twice.
constexpr double part_with_evidence = 0.75;
constexpr Index few_faces = 2500;
/// A component also has noise if half of its places have this much evidence (of clean surfaces none had more than 0.8),
/// and at most a quarter of its places this much evidence against it. This rule is only for noise that is independent,
/// and for components that need no particular evidence.
constexpr float evidence_of_half = 1.0F;
constexpr float evidence_against_of_quarter = -2.5F;
/// The evidence that correlated noise needs where there is no other noise, because it looks more like shape there.
constexpr float evidence_of_correlated_noise_alone = 1.0F;
/// Beside other noise, places with evidence of at least 0 have correlated noise. From this number to 0 they are
/// doubtful (Correlation::Doubtful): local fits must show that the noise is no shape.
constexpr float evidence_of_doubtful_noise = -1.0F;
/// The evidence at a place that outweighs the evidence of its component. For noise: the median of the component plus
/// this difference, but at least clear evidence and at most this limit, which is above the 5.1 that places of clean
/// surfaces in the training data reached. Against noise: chosen by hand. Thinned surfaces, which bend more, are judged
/// as a whole.
constexpr float outweighing_difference = 9.0F;
constexpr float most_outweighing_evidence = 6.5F;
constexpr float outweighing_evidence_against = -4.0F;
/// Components of fewer faces, and places of fewer vertices, are not judged.
constexpr Index fewest_faces = 200;
constexpr Index fewest_of_place = 80;
/// The rounds of averages of the low-pass filter (see PositionFilters).
constexpr int wide_rounds = 16;
/// An edge counts as at most this many medians of the edges at a vertex.
constexpr double most_medians_of_edge = 1.5;
/// The squared chord of two normals that are equal up to rounding.
constexpr double same_normal = 1e-12;
/// A vertex stays if the mean displacement around it, in edge lengths, is below the first number, and moves by its
/// whole displacement above the second; and the rounds over which displacements are averaged.
constexpr float calm = 0.002F;
constexpr float restless = 0.005F;
constexpr int displacement_rounds = 24;
/// The removed displacements are averaged over this many rounds, and are a pattern if the median revival of their
/// places is above this. Noise of all kinds had 0.79 at most; reliefs that were removed with the noise above them had
/// 0.9 to 1.
constexpr int rounds_of_taken = 2;
constexpr float revival_of_structure = 0.87F;
constexpr std::size_t fewest_places_with_structure = 5;
/// The rounds over which places with and without noise are blended.
constexpr int rounds_of_blended_places = 4;

/// The median length of the edges at a vertex.
double median_edge(const NoisyPlaces::Denoised& denoised, Index v)
{
    std::vector<double> lengths;
    for (const Index w : denoised.averages.neighbours()[v])
        lengths.push_back((denoised.before.row(w) - denoised.before.row(v)).norm());
    if (lengths.empty())
        return 0.0;
    const auto middle = lengths.begin() + std::ssize(lengths) / 2;
    std::ranges::nth_element(lengths, middle);
    return *middle;
}

/// A smooth step from 0 to 1, with slope 0 at both ends.
double smooth_step(double x)
{
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

/// All faces as a single component.
Components all_together(const PolygonMesh& mesh)
{
    Components all;
    all.component_of.assign(usize(mesh.n_faces()), 0);
    all.nodes.values.resize(usize(mesh.n_faces()));
    std::iota(all.nodes.values.begin(), all.nodes.values.end(), Index{0});
    all.nodes.close();
    return all;
}

/// #V by 3, of length 1 or 0: the means of the face normals around each vertex, whatever side these are on.
Points mean_normals(const Topology& topology, const Points& normals, const Executor& exec)
{
    Points means(static_cast<Index>(topology.kind.size()), 3);
    for_each(exec, static_cast<Index>(means.rows()), [&](Index v) {
        Point total = Point::Zero();
        for (const Index corner : topology.corners_at(v)) {
            const Point of_face = normals.row(topology.face_of[corner]);
            total += of_face.dot(total) < 0.0 ? Point(-of_face) : of_face;
        }
        means.row(v) = unit_or_zero(total);
    });
    return means;
}

/// Per vertex: the index, in `places`, of the nearest place along edges; -1 if no place is connected with it.
std::vector<Index> nearest_places(std::span<const Index> places, const IndexLists& neighbours)
{
    std::vector<Index> nearest(usize(neighbours.size()), -1);
    std::vector<Index> reached(places.begin(), places.end());
    for (std::size_t i = 0; i < places.size(); ++i)
        nearest[places[i]] = static_cast<Index>(i);
    for (std::size_t i = 0; i < reached.size(); ++i)
        for (const Index w : neighbours[reached[i]])
            if (nearest[w] < 0) {
                nearest[w] = nearest[reached[i]];
                reached.push_back(w);
            }
    return nearest;
}

/// #F by 1: values of vertices, averaged around each face.
/// @param value_at gives the value of a vertex.
VertexAverages::Rows means_around(const NoisyPlaces::Denoised& denoised, int rounds, const Executor& exec,
                                  const auto& value_at)
{
    VertexAverages::Rows near(denoised.mesh.n_faces(), 1);
    for_each(exec, denoised.mesh.n_faces(), [&](Index f) {
        near(f, 0) = 0.0F;
        for (const Index v : denoised.mesh.face(f))
            near(f, 0) += value_at(v) / static_cast<float>(denoised.mesh.face(f).size());
    });
    VertexAverages::Rows around(denoised.mesh.n_faces(), 1);
    denoised.averages.spread(near, around, 0, rounds, exec);
    return around;
}

}  // namespace

std::vector<std::uint8_t> flat_vertices(const PolygonMesh& mesh, const Topology& topology, const Points& positions,
                                        const Executor& exec)
{
    const auto normal_at = [&](Index corner) {
        return Point(vector_area(mesh.face(topology.face_of[corner]), positions).stableNormalized());
    };
    std::vector<std::uint8_t> is_flat(usize(mesh.n_vertices()));
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        const auto corners = topology.corners_at(v);
        const Point first = corners.empty() ? Point(Point::Zero()) : normal_at(corners[0]);
        const auto is_like_first = [&](Index corner) {
            // Normals are turned to one side, because faces need not be oriented alike.
            const Point n = normal_at(corner);
            return std::min((n - first).squaredNorm(), (n + first).squaredNorm()) <= same_normal;
        };
        is_flat[v] = std::ranges::all_of(corners, is_like_first) ? 1 : 0;
    });
    return is_flat;
}

NoisyPlaces::NoisyPlaces(const PolygonMesh& mesh, const Topology& topology, bool as_one, int n_thinned,
                         float least_evidence)
    : components_(as_one ? all_together(mesh) : face_components(mesh, topology))
    , n_thinned_(n_thinned)
    , least_evidence_(least_evidence)
{
}

std::vector<PlaceStatistics> measure_places(const NoisyPlaces::Denoised& denoised, std::span<const Index> places,
                                            const Executor& exec)
{
    const PolygonMesh& mesh = denoised.mesh;
    const Topology& topology = denoised.topology;
    const Points& before = denoised.before;
    const Points& after = denoised.after;
    const DenoisedNormals& found = denoised.found;
    const IndexLists& neighbours = denoised.averages.neighbours();
    const Points normals = mean_normals(topology, found.normals, exec);
    std::vector<double> edges = edge_lengths_at_vertices(mesh, topology, before, exec);
    for_each(exec, mesh.n_vertices(),
             [&](Index v) { edges[v] = std::min(edges[v], most_medians_of_edge * median_edge(denoised, v)); });
    const Points filtered = PositionFilters(topology, neighbours).low_pass(before, {wide_rounds}, exec).front();
    Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor> displacements(mesh.n_vertices(), 2);
    for_each(exec, mesh.n_vertices(), [&](Index v) {
        const double scale = edges[v] > 0.0 ? 1.0 / edges[v] : 0.0;
        displacements(v, 0) = static_cast<float>(scale * (after.row(v) - before.row(v)).dot(normals.row(v)));
        displacements(v, 1) = static_cast<float>(scale * (filtered.row(v) - before.row(v)).dot(normals.row(v)));
    });
    const TakenAway taken{topology, neighbours, before, normals, displacements, edges, found.noise, denoised.is_flat};
    std::vector<PlaceStatistics> measured(places.size());
    for_each(exec, static_cast<Index>(places.size()), [&](Index i) { measured[i] = measure_place(taken, places[i]); });
    return measured;
}

std::vector<std::uint8_t> NoisyPlaces::decide(std::span<const Index> component_of_place,
                                              std::span<const float> evidence, std::span<const Index> sizes,
                                              float least_evidence, bool finds_single_places) const
{
    Lists<float> of_components = make_lists<float>(components_.count(), [&](auto&& add) {
        for (std::size_t i = 0; i < evidence.size(); ++i)
            add(component_of_place[i], evidence[i]);
    });
    // Per component: the evidence that a place of it must exceed to have noise.
    std::vector<float> least(sizes.size());
    for (Index c = 0; c < components_.count(); ++c) {
        const auto begin = of_components.values.begin() + of_components.offsets[c];
        const auto end = of_components.values.begin() + of_components.offsets[c + 1];
        if (sizes[c] < fewest_faces || begin == end) {
            least[c] = std::numeric_limits<float>::infinity();
            continue;
        }
        const auto quantile = [&](double part_below) {
            const auto place = begin + static_cast<std::ptrdiff_t>(part_below * static_cast<double>(end - begin));
            std::nth_element(begin, place, end);
            return *place;
        };
        const bool needs_clear_evidence = n_thinned_ > 1 || sizes[c] < few_faces;
        const float lower = quantile(1.0 - part_with_evidence);
        const float needed = needs_clear_evidence ? std::max(least_evidence, clear_evidence) : least_evidence;
        const bool half_has_it = needed == 0.0F && finds_single_places && lower > evidence_against_of_quarter &&
                                 quantile(0.5) > evidence_of_half;
        if (lower > needed || half_has_it)
            least[c] = outweighing_evidence_against;
        else if (n_thinned_ > 0 || !finds_single_places)
            least[c] = std::numeric_limits<float>::infinity();
        else
            least[c] = std::clamp(quantile(0.5) + outweighing_difference, clear_evidence, most_outweighing_evidence);
    }
    std::vector<std::uint8_t> decisions;
    for (std::size_t i = 0; i < evidence.size(); ++i)
        decisions.push_back(evidence[i] > least[component_of_place[i]] ? 1 : 0);
    return decisions;
}

NoisyPlaces::Found NoisyPlaces::find(const Denoised& denoised, const Executor& exec) const
{
    const PolygonMesh& mesh = denoised.mesh;
    const Topology& topology = denoised.topology;
    const Points& before = denoised.before;
    const Points& after = denoised.after;
    const IndexLists& neighbours = denoised.averages.neighbours();
    const std::vector<Index> spread = spread_places(topology, neighbours, before, rings_between_places);
    const std::vector<PlaceStatistics> measured = measure_places(denoised, spread, exec);
    // Places with too few vertices to be judged are left out.
    std::vector<Index> places;
    std::vector<Index> component_of_place;
    std::vector<float> evidence;
    std::vector<float> correlated_against_shape;
    std::vector<float> evidence_of_correlated;
    for (std::size_t i = 0; i < spread.size(); ++i) {
        if (measured[i].n_vertices < fewest_of_place)
            continue;
        places.push_back(spread[i]);
        component_of_place.push_back(
            components_.component_of[topology.face_of[topology.corners_at(spread[i]).front()]]);
        evidence.push_back(evidence_of_noise(measured[i]));
        correlated_against_shape.push_back(evidence_of_correlated_noise(measured[i]));
        evidence_of_correlated.push_back(
            std::min(correlated_against_shape.back(), evidence_against_independent_noise(measured[i])));
    }
    std::vector<Index> sizes;
    for (Index c = 0; c < components_.count(); ++c)
        sizes.push_back(static_cast<Index>(std::ranges::count_if(components_.nodes[c], [&](Index f) {
            return std::ranges::any_of(mesh.face(f), [&](Index v) { return denoised.is_flat[v] == 0; });
        })));
    const std::vector<std::uint8_t> has_noise = decide(component_of_place, evidence, sizes, least_evidence_, true);
    std::vector<std::uint8_t> has_other(sizes.size(), 0);
    for (std::size_t i = 0; i < places.size(); ++i)
        if (has_noise[i] != 0)
            has_other[component_of_place[i]] = 1;
    const std::vector<Correlation> correlated = [&] {
        const auto decided = [&](std::span<const float> of_places, float least) {
            return decide(component_of_place, of_places, sizes, least, false);
        };
        const std::vector<std::uint8_t> beside_other = decided(evidence_of_correlated, 0.0F);
        const std::vector<std::uint8_t> doubtful = decided(evidence_of_correlated, evidence_of_doubtful_noise);
        const std::vector<std::uint8_t> alone = decided(evidence_of_correlated, evidence_of_correlated_noise_alone);
        const std::vector<std::uint8_t> possible = decided(correlated_against_shape, 0.0F);
        std::vector<Correlation> result(places.size(), Correlation::None);
        for (std::size_t i = 0; i < places.size(); ++i)
            if (has_other[component_of_place[i]] != 0)
                result[i] = beside_other[i] != 0 ? Correlation::Found
                            : doubtful[i] != 0   ? Correlation::Doubtful
                                                 : Correlation::None;
            else if (alone[i] != 0)
                result[i] = Correlation::Found;
            else if (possible[i] != 0)
                result[i] = Correlation::Possible;
        return result;
    }();
    const std::vector<Index> nearest = nearest_places(places, neighbours);
    const std::vector<double> edges = edge_lengths_at_vertices(mesh, topology, before, exec);
    const VertexAverages::Rows displaced = means_around(denoised, displacement_rounds, exec, [&](Index v) {
        return edges[v] > 0.0 ? static_cast<float>(motion_along_normal(topology, denoised.found.normals, v,
                                                                       after.row(v) - before.row(v)) /
                                                   edges[v])
                              : 0.0F;
    });
    // Places with noise, blended with the places around them: from 0 to 1 at each face.
    const VertexAverages::Rows open = means_around(denoised, rounds_of_blended_places, exec, [&](Index v) {
        return nearest[v] >= 0 && has_noise[nearest[v]] != 0 ? 1.0F : 0.0F;
    });
    const Index n = mesh.n_vertices();
    Found result{std::vector<double>(usize(n), 0.0), std::vector<Correlation>(usize(n), Correlation::None)};
    for_each(exec, n, [&](Index v) {
        const auto corners = topology.corners_at(v);
        const auto count = static_cast<double>(corners.size());
        for (const Index corner : corners) {
            const Index f = topology.face_of[corner];
            result.shares[v] += open(f, 0) * smooth_step((displaced(f, 0) - calm) / (restless - calm)) / count;
        }
        result.correlated[v] = nearest[v] >= 0 ? correlated[nearest[v]] : Correlation::None;
    });
    return result;
}

std::vector<NoisyPlaces::Structure> NoisyPlaces::find_structure(const Denoised& taken, const Executor& exec) const
{
    const IndexLists& neighbours = taken.averages.neighbours();
    Points displacements = taken.after - taken.before;
    for (int round = 0; round < rounds_of_taken; ++round) {
        const Points last = displacements;
        for_each(exec, static_cast<Index>(last.rows()), [&](Index v) {
            for (const Index w : neighbours[v])
                displacements.row(v) += last.row(w);
            displacements.row(v) /= static_cast<double>(1 + neighbours[v].size());
        });
    }
    const Points after = taken.before + displacements;
    const std::vector<Index> places = spread_places(taken.topology, neighbours, taken.before, rings_between_places);
    const std::vector<PlaceStatistics> measured = measure_places(
        {taken.mesh, taken.topology, taken.averages, taken.before, after, taken.found, taken.is_flat}, places, exec);
    using Seen = std::pair<float, Index>;
    std::vector<std::vector<Seen>> revivals(usize(components_.count()));
    for (std::size_t i = 0; i < places.size(); ++i)
        if (measured[i].n_vertices >= fewest_of_place && measured[i].fine.median > 0.0F) {
            const Index f = taken.topology.face_of[taken.topology.corners_at(places[i]).front()];
            revivals[components_.component_of[f]].emplace_back(measured[i].fine.revival, places[i]);
        }
    std::vector<Structure> found;
    for (Index c = 0; c < components_.count(); ++c) {
        std::vector<Seen>& seen = revivals[c];
        std::ranges::sort(seen);
        if (seen.size() >= fewest_places_with_structure && seen[seen.size() / 2].first > revival_of_structure)
            found.push_back({c, seen.back().second});
    }
    return found;
}

}  // namespace seamflow
