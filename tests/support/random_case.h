#pragma once

#include <array>
#include <charconv>
#include <map>
#include <string>
#include <vector>

#include "partition/metrics/bounding_box.h"
#include "tests/support/outcome.h"
#include "tests/support/random_flows.h"

namespace seamflow::test {

/// A few digits of a number of any size.
inline std::string text_of(double value)
{
    std::array<char, 32> text;
    return {text.data(),
            std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 3).ptr};
}

/// One random flow, what came of it in one thread, and what was found wrong with it.
struct Case {
    RandomFlow flow;
    RandomNumbers random;
    Outcome expected = {};
    std::vector<std::string> complaints = {};
    /// How often something was compared indeed: where a check has nothing to say of a flow, it leaves that out.
    std::map<std::string, int> n_compared = {};

    void expect(bool holds, const std::string& what)
    {
        if (!holds)
            complaints.push_back(what);
    }
    [[nodiscard]] const PolygonMesh& mesh() const { return flow.input.mesh; }
    [[nodiscard]] double extent() const { return box_of_faces(mesh()).diagonal(); }
    [[nodiscard]] bool is_sound() const { return flow.input.soundness == Soundness::Sound; }
};

/// A flow of this seed, run.
Case random_case(std::uint32_t seed);

/// The result is finite, whoever must stay has stayed, and the report is complete.
void check_result(Case& c);

/// Two and five threads give the same bits.
void check_threads(Case& c);

/// The least memory limit, which a lower one is refused with, or one above it, gives the same bits.
void check_memory_limit(Case& c);

/// Going on from any step gives the same bits, whether the state has been in a file or not.
void check_resume(Case& c);

/// Stopped at any time, the mesh is as it was after a complete step.
void check_cancelled(Case& c);

/// Steps without an interface, and converged ones, are those of the undecomposed mesh, which are computed densely.
void check_undecomposed(Case& c);

/// Area or volume, and the centroid, are those of the beginning.
void check_rescaled(Case& c);

/// Mirrored and scaled by a power of two the flow is the same, bit for bit, where nothing depends on the unit.
void check_mirrored_and_scaled(Case& c);

/// Turned, and numbered otherwise, the flow is the same up to rounding, where the cut is.
void check_turned_and_renumbered(Case& c);

}  // namespace seamflow::test
