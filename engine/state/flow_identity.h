#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/options/flow_options.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// Everything that determines the result of a flow, except for the number of steps. It decides whether the state of
/// one flow belongs to another.
struct FlowIdentity {
    struct Entry {
        /// "mesh", "version" or a field of FlowOptions.
        std::string name;
        /// As text: a number in full, the checksum of an array.
        std::string value;

        friend bool operator==(const Entry&, const Entry&) = default;
    };
    std::vector<Entry> entries;

    friend bool operator==(const FlowIdentity&, const FlowIdentity&) = default;
};

/// @param mesh before the first step.
FlowIdentity identify(const PolygonMesh& mesh, const FlowOptions& options);

/// Checks that the state of a flow may be used by another one.
/// @throws InputError if they are of different meshes, or of different versions of this library; OptionError if their
///         options differ. Both name what differs, and how.
void require_same(const FlowIdentity& of_state, const FlowIdentity& of_flow);

/// Checksum of a cut, or of any other list.
std::uint64_t checksum_of(std::span<const Index> indices);

}  // namespace seamflow
