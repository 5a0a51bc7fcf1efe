#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "tests/support/reference_data.h"

using namespace seamflow;

TEST_CASE("the flows of the paper's authors are reproduced, undecomposed and in two, three and four sub-meshes")
{
    const auto files = test::reference_files("flow");
    REQUIRE(files.size() >= 39);
    for (const auto& file : files) {
        CAPTURE(file.filename().string());
        test::ReferenceFlow reference = test::read_flow(file);
        int steps = 0;
        mean_curvature_flow(reference.mesh, reference.options, [&](const StepState& state) {
            CAPTURE(state.step);
            const Points& expected = reference.positions_after_step.at(usize(state.step - 1));
            CHECK((state.positions - expected).cwiseAbs().maxCoeff() <= 1e-9);
            ++steps;
        });
        CHECK(steps == reference.options.steps);
    }
}
