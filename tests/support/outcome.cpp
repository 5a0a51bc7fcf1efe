#include "tests/support/outcome.h"

#include <stdexcept>
#include <utility>

#include "partition/errors.h"

namespace seamflow::test {

Outcome outcome_of(PolygonMesh mesh, const AllOptions& options, const FlowControl& control, bool is_captured)
{
    Outcome outcome;
    outcome.states.push_back(mesh.vertices);
    const auto note = [&](const char* kind, const std::exception& error) {
        outcome.refusal = kind;
        outcome.message = error.what();
    };
    const PolygonMesh before = mesh;
    try {
        outcome.report = smooth_surface(
            mesh, options,
            [&](const StepState& state) {
                outcome.states.push_back(state.positions);
                if (is_captured)
                    outcome.captured.push_back(*state.capture());
            },
            control);
    } catch (const OptionError& error) {
        note("OptionError", error);
    } catch (const InputError& error) {
        note("InputError", error);
    } catch (const ComputationError& error) {
        note("ComputationError", error);
    } catch (const Cancelled& error) {
        note("Cancelled", error);
    }
    if (mesh.face_vertices != before.face_vertices || mesh.face_offsets != before.face_offsets)
        note("damage", std::logic_error("the faces are not those of before"));
    outcome.end = std::move(mesh.vertices);
    return outcome;
}

}  // namespace seamflow::test
