// A flow that fails after some steps: what the user is left with.

#include <string>

#include "tests/samples/workshop.h"
#include "tests/support/skipped.h"

using namespace seamflow;
using test::Workshop;

TEST_CASE("a factorisation that fails in a later step: status 4, step and sub-mesh, and the last complete step")
{
#ifdef SMOOTH_WITH_FAULTS
    const Workshop w;
    const std::string arguments = " mesh.obj out.obj --time-step-edges 2 --subdomains 3 --converge never --steps 3";
    REQUIRE(w.smooth(arguments + " --every-step at-%d.obj") == 0);
    std::filesystem::remove(w.directory / "out.obj");
    // Three a step, and a second attempt for each that fails.
    for (const auto& of_case : {std::pair{1, 0}, std::pair{4, 1}, std::pair{6, 1}, std::pair{7, 2}}) {
        const int n = of_case.first;
        const int steps_done = of_case.second;
        CAPTURE(n);
        std::filesystem::remove(w.directory / "out.interrupted.obj");
        const std::string first = "FAIL_FACTORISATION=" + std::to_string(n);
        CHECK(w.run(first + " timeout 60 " SMOOTH_WITH_FAULTS + arguments) == 4);
        CAPTURE(w.said());
        CHECK(w.said().find("smooth: step " + std::to_string(steps_done + 1) + ", sub-mesh ") != std::string::npos);
        CHECK_FALSE(w.has("out.obj"));
        CHECK(w.has("out.interrupted.obj") == (steps_done > 0));
        if (steps_done > 0)
            CHECK(test::content_of(w.directory / "out.interrupted.obj") ==
                  test::content_of(w.directory / ("at-" + std::to_string(steps_done) + ".obj")));
    }
#else
    test::skip("the libraries are shared");
#endif
}
