#include "samples/tiles/tile_stepper.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "engine/mean_curvature_flow.h"
#include "samples/tiles/tile_union.h"

namespace seamflow {

namespace {

/// Leaves some 1e-6 of a step (measured: see engine/accuracy.md).
constexpr double widths_of_diffusion = 14.0;
/// Each further order of a low-pass filter multiplies what is left by the distance.
constexpr double widths_per_order = 2.0;
/// Rows may reach two rings, of edges longer than others.
constexpr double fewest_edges = 4.0;

/// The positions of the vertices that other tiles have, too.
Points shared_positions(const TileOwners& owners, const Points& positions)
{
    Points shared(std::ssize(owners.vertices), 3);
    Eigen::Index n = 0;
    for (std::size_t i = 0; i < owners.vertices.size(); ++i)
        if (owners.is_shared[i] != 0)
            shared.row(n++) = positions.row(owners.vertices[i]);
    shared.conservativeResize(n, 3);
    return shared;
}

}  // namespace

double width_of_bands(const FlowOptions& options, double mean_edge)
{
    const StepFilter filter = filter_of(options);
    double widths = widths_of_diffusion;
    if (filter.kind == Filter::LowPass)
        widths += widths_per_order * (filter.order - 1);
    else
        // The poles of 1 / (1 + λᵏ).
        widths /= std::sin(std::numbers::pi / (2.0 * filter.order));
    double width_of_step = std::sqrt(options.time_step);
    if (options.laplacian == Laplacian::Uniform)
        // The same number of edges, however long they are.
        width_of_step *= std::max(1.0, mean_edge / options.uniform_edge);
    return widths * width_of_step + fewest_edges * mean_edge;
}

TileStepper::TileStepper(const TileFolder& folder, FlowOptions options, double width)
    : folder_(&folder)
    , options_(std::move(options))
    , width_(width)
{
    options_.steps = 1;
    options_.motion.weld = std::nullopt;
}

FlowReport TileStepper::take(Index tile, int step, std::span<const BoundingBox> boxes, const FlowControl& control,
                             const Executor& exec, Points& positions) const
{
    TileUnion whole;
    positions = folder_->state(tile, step - 1);
    std::vector<Index> number_of;
    Neighbourhood near(Points(0, 3), width_);
    {
        const TileOwners owners = folder_->read<TileOwners>(tile);
        const std::vector<std::uint8_t> all(static_cast<std::size_t>(positions.rows()), 1);
        number_of = whole.add(folder_->read<TileFaces>(tile), owners, positions, all);
        near = Neighbourhood(shared_positions(owners, positions), width_);
    }
    for (Index other = 0; std::cmp_less(other, boxes.size()) && !near.is_empty(); ++other) {
        if (other == tile || !meet(near.box(), boxes[usize(other)]))
            continue;
        const Points of_other = folder_->state(other, step - 1);
        const std::vector<std::uint8_t> is_wanted = near.select(of_other, exec);
        if (std::ranges::count(is_wanted, 1) > 0)
            whole.add(folder_->read<TileFaces>(other), folder_->read<TileOwners>(other), of_other, is_wanted);
    }
    FlowOptions options = options_;
    options.motion.fixed_vertices = whole.held();
    FlowReport report = mean_curvature_flow(whole.mesh(), options, {}, control);
    for_each(exec, static_cast<Index>(number_of.size()), [&](Index v) {
        if (number_of[v] >= 0)
            positions.row(v) = whole.mesh().vertices.row(number_of[v]);
    });
    return report;
}

}  // namespace seamflow
