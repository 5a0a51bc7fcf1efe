// A run continues from a state only with the mesh and the options that made it: each of them counts, and each alone.

#include <algorithm>
#include <cstdint>
#include <set>
#include <type_traits>
#include <utility>

#include <doctest/doctest.h>

#include "engine/options/option_table.h"
#include "engine/state/flow_identity.h"
#include "samples/options/smooth_surface.h"
#include "tests/support/option_cases.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

/// The options with one of them as a case has it.
AllOptions with_option_of(const test::OptionCase& one, AllOptions options, const PolygonMesh& mesh)
{
    AllOptions of_case = test::options_without_cases(1.0);
    one.set(of_case, mesh, 1.0);
    for_each_row(all_option_table(of_case), [&](const auto& from) {
        for_each_row(all_option_table(options), [&](const auto& to) {
            if constexpr (std::is_same_v<decltype(from.value), decltype(to.value)>)
                if (from.field == one.field && to.field == one.field)
                    *to.value = *from.value;
        });
    });
    return options;
}

}  // namespace

TEST_CASE("a flow that differs in any one option, coordinate or corner has another identity")
{
    const PolygonMesh mesh = test::quad_grid(3, 3);
    AllOptions options = test::options_without_cases(1.0);
    options.cut.labels.assign(9, 0);
    options.motion.fixed_vertices = {3};
    options.motion.attachment_weights.assign(16, 1.0);
    options.motion.strength.assign(16, 1.0);
    options.motion.direction.kind = MotionDirection::Kind::Vector;
    std::set<std::uint64_t> identities{identity_of(mesh, options)};
    for (const test::OptionCase& one : test::option_cases()) {
        CAPTURE(one.name());
        const auto traits = std::ranges::find(all_options(), one.field, &OptionTraits::field);
        const bool enters_result = traits == all_options().end() || (traits->concerns & concern::no_result) == 0;
        AllOptions with_option = with_option_of(one, options, mesh);
        // Only where noise is removed, coordinates count as rounded.
        if (one.field == "rounded")
            with_option.denoise = true;
        CHECK(identities.insert(identity_of(mesh, with_option)).second == enters_result);
    }
    for (const Eigen::Index i : {0, 7, 47}) {
        PolygonMesh other = mesh;
        other.vertices.data()[i] += 1e-15;
        CHECK(identities.insert(identity_of(other, options)).second);
    }
    PolygonMesh turned = mesh;
    std::swap(turned.face_vertices.front(), turned.face_vertices[2]);
    CHECK(identities.insert(identity_of(turned, options)).second);
}

TEST_CASE("an order that is left open is that of the filter")
{
    const PolygonMesh mesh = test::quad_grid(3, 3);
    FlowOptions options{.filter = Filter::LowPass, .time_step = 1e-3};
    const std::uint64_t identity = identify(mesh, options);
    options.order = 2;
    CHECK(identify(mesh, options) == identity);
    options.order = 3;
    CHECK(identify(mesh, options) != identity);
}
