// Too little memory in earnest: limits of the address space between what a program needs to start and what it needs.

#include <string>

#include "tests/samples/workshop.h"
#include "tests/support/sanitizers.h"

using namespace seamflow;
using test::Workshop;

namespace {

/// In KiB.
int run_within(const Workshop& w, long kilobytes, const std::string& command)
{
    return w.run("(ulimit -v " + std::to_string(kilobytes) + "; exec timeout 60 " + command + ")");
}

/// The least limit with which a command succeeds, to 1 MiB.
long least_for(const Workshop& w, long failing, const std::string& command)
{
    long enough = 1'000'000;
    REQUIRE(run_within(w, enough, command) == 0);
    while (enough - failing > 1024) {
        const long middle = (failing + enough) / 2;
        (run_within(w, middle, command) == 0 ? enough : failing) = middle;
    }
    return enough;
}

}  // namespace

TEST_CASE("with whatever memory, smooth succeeds, or says with status 4 that it does not suffice" *
          doctest::skip(test::under_sanitizers))
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " triangles large.ply --vertices 10000") == 0);
    const long start = least_for(w, 1000, SMOOTH " --version");
    for (const std::string options : {"--threads 1", "--threads 2 --converge 1e-6", "--threads 4",
                                      "--laplacian ptackova-velho --threads 2 --converge 1e-2"}) {
        CAPTURE(options);
        const std::string command = SMOOTH " large.ply out.ply --steps 2 --time-step-edges 20 " + options;
        const long enough = least_for(w, start, command);
        constexpr int n_limits = 8;
        int n_failed = 0;
        for (int i = 0; i <= n_limits; ++i) {
            const long limit = start + (enough + 4000 - start) * i / n_limits;
            CAPTURE(limit);
            std::filesystem::remove(w.directory / "out.ply");
            const int status = run_within(w, limit, command);
            CAPTURE(w.said());
            CHECK((status == 0 || status == 4));
            CHECK(w.has("out.ply") == (status == 0));
            n_failed += status == 4 ? 1 : 0;
            if (status == 4)
                CHECK(w.said().find("smooth: ") != std::string::npos);
            CHECK(w.said().find("terminate") == std::string::npos);
        }
        CHECK(n_failed > 0);
    }
}
