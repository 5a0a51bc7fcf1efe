#include <dlfcn.h>
#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "samples/meshes/meshes.h"
#include "solvers/platform/library_threads.h"
#include "tests/support/flows.h"
#include "tests/support/skipped.h"

using namespace seamflow;

namespace {

/// What a function of a loaded library returns, or -1 without it.
int ask(const char* function)
{
    const auto found = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, function));
    return found != nullptr ? found() : -1;
}

int openmp_levels()
{
    return ask("omp_get_max_active_levels");
}

int blas_threads()
{
    return ask("openblas_get_num_threads");
}

}  // namespace

TEST_CASE("OpenMP is silent in one scope and one thread")
{
    const int before = openmp_levels();
    REQUIRE(before > 0);
    {
        const SingleThreadedOpenMp outer;
        CHECK(openmp_levels() == 0);
        {
            const SingleThreadedOpenMp inner;
        }
        CHECK(openmp_levels() == 0);
    }
    CHECK(openmp_levels() == before);
}

TEST_CASE("BLAS has one thread while anybody wants that, and then what it had")
{
    const int before = blas_threads();
    if (before < 0)
        return test::skip("the BLAS is not OpenBLAS");
    {
        const SingleThreadedBlas outer;
        {
            const SingleThreadedBlas inner;
        }
        CHECK(blas_threads() == 1);
    }
    CHECK(blas_threads() == before);
}

TEST_CASE("a flow leaves OpenMP and BLAS to its caller as they were")
{
    const int levels = openmp_levels();
    const int threads = blas_threads();
    for (const int n : {0, 1, 4}) {
        FlowOptions options;
        options.time_step = 1e-3;
        options.cut.subdomains = 6;
        options.resources.threads = n;
        PolygonMesh mesh = make_quads(1000);
        mean_curvature_flow(mesh, options, [&](const StepState&) {
            CHECK(openmp_levels() == levels);
            CHECK((threads < 0 || blas_threads() == 1));
        });
        CHECK(openmp_levels() == levels);
        CHECK(blas_threads() == threads);
    }
}
