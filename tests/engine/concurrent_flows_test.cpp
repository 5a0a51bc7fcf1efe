#include <atomic>
#include <cstring>
#include <set>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>

#include "engine/mean_curvature_flow.h"
#include "engine/tasks/parallel_executor.h"
#include "samples/meshes/meshes.h"
#include "tests/support/flows.h"

using namespace seamflow;

namespace {

struct Case {
    PolygonMesh mesh;
    FlowOptions options;
    Points expected;
};

Case make_case(PolygonMesh mesh, Laplacian laplacian, int subdomains, Conditions conditions = Conditions::AdaptedRobin)
{
    Case made{.mesh = std::move(mesh), .options = {}, .expected = {}};
    made.options.laplacian = laplacian;
    made.options.interface.conditions = conditions;
    made.options.time_step = 0.001;
    made.options.steps = 2;
    made.options.cut.subdomains = subdomains;
    made.options.resources.threads = 1;
    return made;
}

/// Ten flows, of every kind, with what each gives alone and in one thread.
std::vector<Case> all_kinds()
{
    std::vector<Case> cases;
    cases.push_back(make_case(make_quads(1500), Laplacian::Fujiwara, 12));
    cases.push_back(make_case(make_mixed_polygons(1500), Laplacian::PtackovaVelho, 6, Conditions::Robin));
    cases.push_back(make_case(make_noisy_sphere(1200), Laplacian::AlexaWardetzky, 9, Conditions::Schwarz));
    cases.push_back(make_case(make_triangles(1500), Laplacian::AlexaWardetzky, 10));
    cases.back().options.accuracy.tolerance = 1e-6;
    cases.push_back(make_case(make_quads(800), Laplacian::PtackovaVelho, 4));
    cases.back().options.accuracy.tolerance = 1e-6;
    cases.push_back(make_case(make_quads(900), Laplacian::Fujiwara, 1));
    cases.back().options.scheme = Scheme::ExplicitEuler;
    cases.back().options.time_step = 1e-6;
    cases.push_back(make_case(make_hexagons(1200), Laplacian::Fujiwara, 8, Conditions::AdaptedVentcell));
    cases.back().options.interface.q = 0.1;
    cases.push_back(make_case(make_triangles(1000), Laplacian::Fujiwara, 7));
    cases.back().options.motion.boundary = Boundary::Free;
    cases.back().options.motion.rescale = Rescale::Area;
    cases.push_back(make_case(make_mixed_polygons(1200), Laplacian::AlexaWardetzky, 5));
    cases.back().options.cut.labels = test::random_labels(cases.back().mesh.n_faces(), 6, 1);
    cases.back().options.motion.fixed_vertices = {100, 300, 301, 700};
    cases.push_back(make_case(make_cylinder(1300), Laplacian::PtackovaVelho, 11));
    cases.back().options.resources.memory_limit = std::size_t{64} << 20U;
    for (Case& c : cases)
        c.expected = test::flowed(c.mesh, c.options);
    return cases;
}

bool gives_the_same(const Case& c, int threads)
{
    FlowOptions options = c.options;
    options.resources.threads = threads;
    const Points found = test::flowed(c.mesh, options);
    return found.rows() == c.expected.rows() &&
           std::memcmp(found.data(), c.expected.data(), static_cast<std::size_t>(found.size()) * sizeof(double)) == 0;
}

/// Counts how often threads other than the caller's own come into the arena that it is made in.
class Helpers : public tbb::task_scheduler_observer {
  public:
    Helpers() { observe(true); }
    ~Helpers() override { observe(false); }
    Helpers(const Helpers&) = delete;
    Helpers& operator=(const Helpers&) = delete;

    void on_scheduler_entry(bool is_worker) override
    {
        if (is_worker || std::this_thread::get_id() != caller_)
            ++count;
    }

    std::atomic<int> count = 0;

  private:
    std::thread::id caller_ = std::this_thread::get_id();
};

/// Runs every kind of flow, which may not use more than the calling thread.
void check_one_thread(const std::vector<Case>& cases, int threads)
{
    const Helpers helpers;
    for (Case c : cases) {
        c.options.resources.threads = threads;
        c.options.report.record_schedule = true;
        const FlowReport report = mean_curvature_flow(c.mesh, c.options);
        CHECK(report.resources.threads == 1);
        CHECK(c.mesh.vertices == c.expected);
        std::set<int> slots;
        if (report.schedule)
            for (const TaskRecord& record : report.schedule->records)
                slots.insert(record.thread);
        CHECK(slots.size() == (c.options.scheme == Scheme::ExplicitEuler ? 0U : 1U));
    }
    CHECK(helpers.count == 0);
}

}  // namespace

TEST_CASE("ten flows at once, in ten threads of the program, give what each gives alone")
{
    const auto cases = all_kinds();
    REQUIRE(cases.size() == 10);
    for (const int threads : {0, 1, 3}) {
        std::atomic<int> n_same = 0;
        std::vector<std::thread> callers;
        for (const Case& c : cases)
            callers.emplace_back([&c, threads, &n_same] { n_same += gives_the_same(c, threads) ? 1 : 0; });
        for (std::thread& caller : callers)
            caller.join();
        CHECK(n_same == static_cast<int>(cases.size()));
    }
}

TEST_CASE("flows inside the caller's own parallel loop give what each gives alone")
{
    const auto cases = all_kinds();
    const auto n = static_cast<Index>(3 * cases.size());
    const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
    for (const int concurrency : {1, 2, 4}) {
        std::atomic<Index> n_same = 0;
        const auto run_all = [&] {
            for_each(run_in_parallel, n,
                     [&](Index i) { n_same += gives_the_same(cases[i % cases.size()], i % 3) ? 1 : 0; });
        };
        tbb::task_arena(concurrency).execute(run_all);
        CHECK(n_same == n);
    }
}

TEST_CASE("one thread allowed by the program is all that is used, whatever the options ask for")
{
    const auto cases = all_kinds();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    for (const int threads : {0, 1, 4})
        check_one_thread(cases, threads);
}

TEST_CASE("a flow in an arena of one thread stays in it")
{
    const auto cases = all_kinds();
    tbb::task_arena(1).execute([&] { check_one_thread(cases, 0); });
}

TEST_CASE("no more threads work than the caller's arena has")
{
    tbb::task_arena arena(2);
    Case c = make_case(make_quads(3000), Laplacian::Fujiwara, 24);
    c.options.resources.threads = 0;
    c.options.report.record_schedule = true;
    const FlowReport report = arena.execute([&] { return mean_curvature_flow(c.mesh, c.options); });
    CHECK(report.resources.threads <= 2);
    for (const TaskRecord& record : report.schedule->records)
        CHECK(record.thread < 2);
}
