#include "engine/state/flow_identity.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <concepts>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "engine/measure/origin_offset.h"
#include "engine/options/option_names.h"
#include "engine/options/option_table.h"
#include "engine/state/checksum.h"
#include "partition/errors.h"

namespace seamflow {

namespace {

constexpr std::string_view none = "none";

std::string text_of(std::integral auto value)
{
    return fmt::format("{}", value);
}

/// The fewest digits that are unique to it.
std::string text_of(double value)
{
    std::array<char, 32> text;
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string text_of(bool value)
{
    return value ? "yes" : "no";
}

std::string text_of(const LengthOnMesh& length)
{
    return text_of(length.value) + (length.of_diagonal ? " diagonals" : "");
}

std::string text_of(const MotionDirection& direction)
{
    switch (direction.kind) {
    case MotionDirection::Kind::Any:
        return std::string(none);
    case MotionDirection::Kind::Normal:
        return "normal";
    case MotionDirection::Kind::Vector:
        break;
    }
    const Point& d = direction.vector;
    return text_of(d[0]) + "," + text_of(d[1]) + "," + text_of(d[2]);
}

template <class Value>
std::string text_of(const std::optional<Value>& value)
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

/// Checksum of the mesh near the origin, where it flows: the same whether it has been moved there or not.
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
    FlowIdentity identity{{{"version", SEAMFLOW_VERSION}, {"mesh", text_of(mesh)}}};
    for_each_option(options, [&](const auto& row) {
        if ((row.concerns & concern::no_result) == 0)
            identity.entries.push_back({std::string(row.field), text_of(*row.value)});
        // The order of the filter if it is left open.
        if (row.field == "order")
            identity.entries.back().value = text_of(filter_of(options).order);
    });
    return identity;
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
