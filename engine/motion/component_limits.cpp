#include "engine/motion/component_limits.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "engine/tasks/parallel_executor.h"
#include "partition/metrics/volume.h"
#include "partition/vector_area.h"

namespace seamflow {

namespace {

/// Factors of a displacement below this are replaced by 0.
constexpr double smallest_factor = 0.1;
/// The number of bisections that find a factor.
constexpr int bisections = 20;

}  // namespace

LimitedComponents::LimitedComponents(const PolygonMesh& mesh, const Topology& topology, const ComponentLimits& limits)
    : mesh_(&mesh)
    , limits_(limits)
    , normals_(mesh, topology)
    , components_(face_components(mesh, topology))
    , is_closed_(usize(components_.count()))
    , initial_(mesh.vertices)
    , factors_(usize(components_.count()), 1.0)
    , losses_(usize(components_.count()))
{
    for (Index c = 0; c < components_.count(); ++c) {
        std::vector<Index> vertices;
        for (const Index f : components_.nodes[c]) {
            const auto corners = mesh.face(f);
            vertices.insert(vertices.end(), corners.begin(), corners.end());
        }
        is_closed_[c] =
            encloses_volume(mesh, components_.nodes[c],
                            components_.nodes[c].size() > usize(block_size) ? run_in_parallel : run_serially)
                ? 1
                : 0;
        sort_unique(vertices);
        vertices_.values.insert(vertices_.values.end(), vertices.begin(), vertices.end());
        vertices_.close();
    }
}

/// The volume of a component with this fraction of its displacements, relative to the component's first vertex.
double LimitedComponents::volume_of(Index component, const Points& positions, double factor) const
{
    const auto where = [&](Index v) -> Point {
        return initial_.row(v) + factor * (positions.row(v) - initial_.row(v));
    };
    const Point origin = where(vertices_[component].front());
    const std::span<const Index> faces = components_.nodes[component];
    return sum(run_in_parallel, static_cast<Index>(faces.size()), [&](Index i) {
        const auto corners = mesh_->face(faces[i]);
        Point mean = Point::Zero();
        for (const Index v : corners)
            mean += where(v) - origin;
        mean /= static_cast<double>(corners.size());
        double volume = 0.0;
        Point from = where(corners.back()) - origin;
        for (const Index v : corners) {
            const Point to = where(v) - origin;
            volume += mean.dot(from.cross(to)) / 6.0;
            from = to;
        }
        return volume;
    });
}

/// The largest factor with which the volume of a closed component stays within its limit; 1 for open components.
/// Records the change of volume in losses_ if it is beyond the limit, which leaves it as it is otherwise.
double LimitedComponents::factor_by_volume(Index component, const Points& positions)
{
    if (is_closed_[component] == 0)
        return 1.0;
    const double first = volume_of(component, positions, 0.0);
    const auto change = [&](double factor) { return std::abs(volume_of(component, positions, factor) - first); };
    const auto is_within = [&](double lost) { return lost <= limits_.volume * std::abs(first); };
    const double lost = change(1.0);
    if (is_within(lost))
        return 1.0;
    losses_[component] = {lost, lost / std::abs(first)};
    double within = 0.0;
    double beyond = 1.0;
    for (int i = 0; i < bisections; ++i) {
        const double middle = 0.5 * (within + beyond);
        (is_within(change(middle)) ? within : beyond) = middle;
    }
    return within;
}

/// The factor that brings the root mean square of the displacements along the normals down to its limit; 1 if it is
/// within the limit.
double LimitedComponents::factor_by_move(Index component, const Points& positions) const
{
    const std::span<const Index> vertices = vertices_[component];
    const double squares = sum(run_in_parallel, static_cast<Index>(vertices.size()), [&](Index i) {
        const Index v = vertices[i];
        const double move = (positions.row(v) - initial_.row(v)).dot(normals_(v, positions));
        return move * move;
    });
    const double move = std::sqrt(squares / static_cast<double>(vertices.size()));
    return move > limits_.move ? limits_.move / move : 1.0;
}

/// The smaller of the factors by volume and by move; 0 if it is below smallest_factor.
double LimitedComponents::factor_of(Index component, const Points& positions)
{
    double factor = 1.0;
    if (std::isfinite(limits_.move))
        factor = factor_by_move(component, positions);
    if (std::isfinite(limits_.volume))
        factor = std::min(factor, factor_by_volume(component, positions));
    return factor >= smallest_factor ? factor : 0.0;
}

/// Whether a component is not limited.
/// @param exempt #F, or empty.
bool LimitedComponents::is_exempt(Index component, std::span<const std::uint8_t> exempt) const
{
    return !exempt.empty() &&
           std::ranges::all_of(components_.nodes[component], [&](Index f) { return exempt[usize(f)] != 0; });
}

/// Shortens the parts of displacements that are tangential to the result.
void LimitedComponents::limit_slides(Points& positions, std::span<const std::uint8_t> exempt) const
{
    std::vector<std::uint8_t> is_limited(usize(mesh_->n_vertices()), 0);
    for (Index c = 0; c < components_.count(); ++c)
        if (!is_exempt(c, exempt))
            for (const Index v : vertices_[c])
                is_limited[v] = 1;
    Points limited = positions;
    for_each(run_in_parallel, mesh_->n_vertices(), [&](Index v) {
        if (is_limited[v] == 0)
            return;
        const Point move = positions.row(v) - initial_.row(v);
        const Point normal = normals_(v, positions);
        const Point slide = move - move.dot(normal) * normal;
        if (const double length = slide.norm(); length > limits_.slide)
            limited.row(v) -= (1.0 - limits_.slide / length) * slide;
    });
    positions = std::move(limited);
}

void LimitedComponents::apply(Points& positions, std::span<const std::uint8_t> exempt)
{
    if (std::isfinite(limits_.slide))
        limit_slides(positions, exempt);
    std::vector<double> of_vertices(usize(mesh_->n_vertices()), 1.0);
    for (Index c = 0; c < components_.count(); ++c) {
        losses_[c] = {};
        factors_[c] = is_exempt(c, exempt) ? 1.0 : factor_of(c, positions);
        if (factors_[c] < 1.0)
            for (const Index v : vertices_[c])
                of_vertices[v] = std::min(of_vertices[v], factors_[c]);
    }
    for_each(run_in_parallel, mesh_->n_vertices(), [&](Index v) {
        if (const double factor = of_vertices[v]; factor == 0.0)
            positions.row(v) = initial_.row(v);
        else if (factor < 1.0)
            positions.row(v) = initial_.row(v) + factor * (positions.row(v) - initial_.row(v));
    });
}

/// A text in brackets on the largest loss; empty if no component would have lost too much.
std::string LimitedComponents::largest_loss() const
{
    const Loss largest = *std::ranges::max_element(losses_, {}, &Loss::fraction);
    if (largest.fraction == 0.0)
        return {};
    return fmt::format(" ({}{:.2g} %: {:.3g} in units of the file)", components_.count() == 1 ? "" : "up to ",
                       100.0 * largest.fraction, largest.volume);
}

std::optional<Remark> LimitedComponents::remark() const
{
    const auto n_unmoved = std::ranges::count(factors_, 0.0);
    const auto n_less = std::ranges::count_if(factors_, [](double factor) { return factor > 0.0 && factor < 1.0; });
    if (n_unmoved + n_less == 0)
        return {};
    const auto components = [&](auto n) {
        return components_.count() == 1 ? std::string("The surface")
                                        : fmt::format("{} of {} components", n, components_.count());
    };
    std::string text;
    std::string loss = "would have lost ";
    if (std::isfinite(limits_.move))
        loss += std::isfinite(limits_.volume) ? "more than its noise, or " : "more than its noise";
    if (std::isfinite(limits_.volume))
        loss += fmt::format("more than {:g} % of its volume{}", 100.0 * limits_.volume, largest_loss());
    if (n_less > 0)
        text = fmt::format("{} {}: less was taken off there. <radius> smooths as much as it says.", components(n_less),
                           loss);
    if (n_unmoved > 0)
        text += fmt::format("{}{} {}, however little was taken off, and stayed as it was: say how much to smooth with "
                            "<radius>.",
                            text.empty() ? "" : " ", components(n_unmoved), loss);
    return Remark("limited loss", {{"moved less", n_less}, {"stayed", n_unmoved}, {"of", components_.count()}}, {text});
}

}  // namespace seamflow
