#include "engine/state/flow_identity.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <concepts>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "engine/options/option_names.h"
#include "engine/setup/origin_offset.h"
#include "engine/state/checksum.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

constexpr std::string_view none = "none";

std::string text_of(std::integral auto value)
{
    return fmt::format("{}", value);
}

/// The fewest digits that tell it from all others.
std::string text_of(double value)
{
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string text_of(const std::optional<double>& value)
{
    return value ? text_of(*value) : std::string(none);
}

std::string text_of(Laplacian laplacian)
{
    return std::string(name_of(laplacian));
}

template <class Option>
concept HasNames = requires
{
    OptionNames<Option>::list;
};

std::string text_of(HasNames auto value)
{
    return std::string(option_name(value));
}

std::string text_of(const std::vector<Index>& indices)
{
    return indices.empty() ? std::string(none) : fmt::format("those with checksum {:x}", checksum_of(indices));
}

std::string text_of(const std::vector<Edge>& edges)
{
    std::vector<Index> ends;
    for (const Edge& edge : edges)
        ends.insert(ends.end(), edge.begin(), edge.end());
    return text_of(ends);
}

std::string text_of(const std::vector<double>& numbers)
{
    if (numbers.empty())
        return std::string(none);
    Checksum checksum;
    checksum.add_numbers(std::span<const double>(numbers));
    return fmt::format("those with checksum {:x}", checksum.value());
}

/// Of the mesh near the origin, where it flows: the same whether it has been brought there or not.
std::string text_of(const PolygonMesh& mesh)
{
    Checksum checksum;
    const Point offset = origin_offset(mesh);
    const Points moved = offset.isZero(0.0) ? Points(0, 3) : Points(mesh.vertices.rowwise() - offset);
    const Points& near = offset.isZero(0.0) ? mesh.vertices : moved;
    checksum.add_numbers(std::span<const double>(near.data(), static_cast<std::size_t>(near.size())));
    checksum.add_numbers(std::span<const Index>(mesh.face_offsets));
    checksum.add_numbers(std::span<const Index>(mesh.face_vertices));
    return fmt::format("{} vertices and {} faces with checksum {:x}", mesh.n_vertices(), mesh.n_faces(),
                       checksum.value());
}

}  // namespace

FlowIdentity identify(const PolygonMesh& mesh, const FlowOptions& options)
{
    // Every field has a name here, so that a new one cannot be forgotten.
    const auto& [laplacian, flow, filter, order, time_step, radius, uniform_edge, steps, scheme, keep_edges, cut,
                 interface, accuracy, motion, resources, report] = options;
    const auto& [subdomains, labels] = cut;
    const auto& [conditions, transmission, p, p_rule, p_edge, q, overlap, colouring, sweep, correction] = interface;
    const auto& [tolerance, approach, converge_iterations, largest_update] = accuracy;
    const auto& [weld, boundary, fixed_vertices, feature_edges, strict, attachment, attachment_weights, rescale, within,
                 limits] = motion;
    const auto& [threads, memory_limit, factorisation, precision] = resources;
    const auto& [reference, record_schedule, keep_gaps, measures] = report;
    // These do not change results, or (steps) only where they end; a radius has become a time step.
    static_cast<void>(radius);
    static_cast<void>(order);
    static_cast<void>(steps);
    static_cast<void>(strict);
    static_cast<void>(keep_gaps);
    static_cast<void>(threads);
    static_cast<void>(memory_limit);
    static_cast<void>(largest_update);
    static_cast<void>(record_schedule);
    return {{
        {"version", SEAMFLOW_VERSION},
        {"mesh", text_of(mesh)},
        {"laplacian", text_of(laplacian)},
        {"flow", text_of(flow)},
        {"filter", text_of(filter)},
        {"order", text_of(filter_of(options).order)},
        {"uniform_edge", text_of(uniform_edge)},
        {"time_step", text_of(time_step)},
        {"subdomains", text_of(subdomains)},
        {"labels", text_of(labels)},
        {"colouring", text_of(colouring)},
        {"conditions", text_of(conditions)},
        {"scheme", text_of(scheme)},
        {"keep_edges", text_of(keep_edges)},
        {"transmission", text_of(transmission)},
        {"p", text_of(p)},
        {"p_rule", text_of(p_rule)},
        {"p_edge", text_of(p_edge)},
        {"q", text_of(q)},
        {"overlap", text_of(overlap)},
        {"sweep", text_of(sweep)},
        {"weld", text_of(weld)},
        {"boundary", text_of(boundary)},
        {"fixed_vertices", text_of(fixed_vertices)},
        {"feature_edges", text_of(feature_edges)},
        {"attachment", text_of(attachment)},
        {"attachment_weights", text_of(attachment_weights)},
        {"rescale", text_of(rescale)},
        {"within", within ? text_of(*within) : "none"},
        {"limit_of_volume", text_of(limits.volume)},
        {"limit_of_move", text_of(limits.move)},
        {"limit_of_slide", text_of(limits.slide)},
        {"correction", text_of(correction)},
        {"tolerance", text_of(tolerance)},
        {"approach", text_of(approach)},
        {"converge_iterations", text_of(converge_iterations)},
        {"reference", reference ? "yes" : "no"},
        {"factorisation", text_of(factorisation)},
        {"measures", measures ? "yes" : "no"},
        {"precision", text_of(precision)},
    }};
}

void require_same(const FlowIdentity& of_state, const FlowIdentity& of_flow)
{
    const auto refused = [](const std::string& what, const auto& then, const auto& now) {
        return fmt::format("belongs to another flow: {} was {} then and is {} now", what, then, now);
    };
    for (const FlowIdentity::Entry& now : of_flow.entries) {
        const auto then = std::find_if(of_state.entries.begin(), of_state.entries.end(),
                                       [&](const FlowIdentity::Entry& entry) { return entry.name == now.name; });
        const std::string value = then == of_state.entries.end() ? "unknown" : then->value;
        if (value == now.value)
            continue;
        if (now.name == "mesh" || now.name == "version")
            throw InputError(refused("the " + now.name, value, now.value));
        throw OptionError(refused(now.name, value, now.value));
    }
    if (of_state.entries.size() != of_flow.entries.size())
        throw InputError(refused("the number of options", of_state.entries.size(), of_flow.entries.size()));
}

std::uint64_t checksum_of(std::span<const Index> indices)
{
    Checksum checksum;
    checksum.add_numbers(indices);
    return checksum.value();
}

}  // namespace seamflow
