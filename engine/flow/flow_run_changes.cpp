// The changes that Flow makes between steps: vertices fixed, attached or moved.

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "engine/flow/flow_run.h"
#include "partition/errors.h"
#include "solvers/laplacian/degenerate.h"

namespace seamflow {

/// Checks that vertices can be changed.
/// @param what the change, as a verb for messages. @param needs_stepper whether the stepper must have equations that
/// can be changed.
/// @returns the vertices of the flowing mesh that these vertices move with.
/// @throws OptionError if the flow does not allow the change; InputError for vertices that do not exist.
std::vector<Index> FlowRun::require_changeable(std::string_view what, std::span<const Index> vertices,
                                               bool needs_stepper) const
{
    if (reference_ || constraints_->has_results_apart() || constraints_->is_scaled)
        throw OptionError(fmt::format("a flow with a reference, rescale, within or limits does not {} vertices between "
                                      "steps: begin a new flow",
                                      what));
    if (needs_stepper && stepper_->equations() == nullptr)
        throw OptionError(fmt::format("this flow does not {} vertices between steps: only converged steps of symmetric "
                                      "Laplacians do: begin a new flow with the approach converged, or a linear one",
                                      what));
    std::vector<Index> flowing;
    for (const Index v : vertices) {
        if (v < 0 || v >= mesh_.mesh().n_vertices())
            throw InputError(
                fmt::format("vertex {} is to {} between steps, but the mesh has {} vertices, numbered from 0", v, what,
                            mesh_.mesh().n_vertices()));
        flowing.push_back(mesh_.moves_with(v));
    }
    return flowing;
}

void FlowRun::set_fixed(std::span<const Index> vertices, bool is_fixed)
{
    std::vector<Index> flowing = require_changeable(is_fixed ? "hold" : "release", vertices, true);
    Topology& topology = prepared_->surface.topology;
    is_fixed_.resize(topology.fixed.size(), 0);
    for (const Index v : flowing)
        if (!is_fixed && !topology.moves(v) && is_fixed_[v] == 0)
            throw OptionError(fmt::format("vertex {} was fixed when the flow began: only vertices held since then can "
                                          "be released; begin a new flow",
                                          v));
    // Only vertices that move can be fixed, and only fixed ones released.
    std::erase_if(flowing, [&](Index v) { return topology.moves(v) != is_fixed; });
    stepper_->equations()->set_fixed(flowing, is_fixed);
    for (const Index v : flowing)
        topology.fixed[v] = is_fixed_[v] = is_fixed ? 1 : 0;
    vanishing_->look_again();
    was_changed_ = true;
}

void FlowRun::attach(std::span<const Index> vertices, std::span<const double> weights)
{
    const std::vector<Index> flowing = require_changeable("attach", vertices, true);
    if (!attaches(options().motion))
        throw OptionError(
            Wording{"only a flow with an attachment has weights to change between steps: set <attachment> or "
                    "<attachment_weights>"});
    if (weights.size() != vertices.size())
        throw OptionError(
            fmt::format("{} vertices have {} attachment weights: give one for each", vertices.size(), weights.size()));
    for (const double weight : weights)
        if (!(weight >= 0.0 && std::isfinite(weight)))
            throw OptionError(
                fmt::format("an attachment weight is {}, but must be at least 0 and finite (1/length²)", weight));
    stepper_->equations()->attach(flowing, weights);
    vanishing_->attach(flowing, weights);
    was_changed_ = true;
}

void FlowRun::move_vertices(std::span<const Index> vertices, const Points& to)
{
    // Mean curvature flow assembles its equations anew in each step. All other flows keep matrices of V⁰, which have to
    // change, too.
    const std::vector<Index> flowing =
        require_changeable("move", vertices, options().flow != FlowEquation::MeanCurvature);
    if (to.rows() != std::ssize(vertices) || !to.allFinite())
        throw OptionError(fmt::format("{} vertices are to move to {} positions: give a finite one for each",
                                      vertices.size(), to.rows()));
    const Points there = mesh_.to_flowing(to);
    require_rows(flowing, there);
    mesh_.set_isolated_positions(vertices, to);
    stepper_->set_vertices(flowing, there);
    if (ChangeableEquations* const equations = stepper_->equations())
        equations->set_reference_vertices(flowing, there);
    vanishing_->set_reference_vertices(flowing, there);
    mesh_.move_to(stepper_->positions());
    // The limit is relative to the diagonal of the mesh, which may have become another.
    constraints_->limit.emplace(mesh_.mesh(), options().accuracy.largest_update);
    was_changed_ = true;
}

/// @throws InputError if vertices would move to positions at which no step is defined for them.
void FlowRun::require_rows(std::span<const Index> vertices, const Points& to) const
{
    PolygonMesh moved = mesh_.mesh();
    move_rows(vertices, to, moved.vertices);
    const std::vector<Index> undefined =
        vertices_without_row(moved, prepared_->surface.topology, options().laplacian, progress_.exec());
    for (const Index v : vertices)
        if (std::ranges::binary_search(undefined, v))
            throw InputError(
                fmt::format("vertex {} would lie at the same place as one beside it, or have a face without "
                            "area: move it elsewhere",
                            v));
}

}  // namespace seamflow
