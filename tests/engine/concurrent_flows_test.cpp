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
#include "tests/support/flow_kinds.h"

using namespace seamflow;

namespace {

struct Case {
    PolygonMesh mesh;
    AllOptions options;
    Points expected;
};

/// Flows of many kinds, with what each gives alone and in one thread.
std::vector<Case> many_kinds()
{
    std::vector<Case> cases;
    for (const PolygonMesh& mesh : {make_mixed_polygons(1200), make_noisy_sphere(1000)}) {
        const std::vector<test::FlowKind> kinds = test::flow_kinds(mean_edge_length(mesh));
        for (std::size_t i = cases.size(); i < kinds.size(); i += 5) {
            AllOptions options = kinds[i].options;
            options.resources.threads = 1;
            cases.push_back({mesh, options, test::flowed(mesh, options)});
        }
    }
    return cases;
}

bool gives_the_same(const Case& c, int threads)
{
    AllOptions options = c.options;
    options.resources.threads = threads;
    return test::same_bits(test::flowed(c.mesh, options), c.expected);
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
    std::size_t n_recorded = 0;
    for (Case c : cases) {
        c.options.resources.threads = threads;
        c.options.report.record_schedule = true;
        const FlowReport report = smooth_surface(c.mesh, c.options);
        CHECK(report.resources.threads == 1);
        CHECK(c.mesh.vertices == c.expected);
        std::set<int> slots;
        if (report.schedule)
            for (const TaskRecord& record : report.schedule->records)
                slots.insert(record.thread);
        CHECK(slots.size() <= 1);
        n_recorded += slots.size();
    }
    CHECK(n_recorded > 5);
    CHECK(helpers.count == 0);
}

}  // namespace

TEST_CASE("flows at once, each in a thread of the program, give what each gives alone")
{
    const auto cases = many_kinds();
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
    const auto cases = many_kinds();
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
    const auto cases = many_kinds();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    for (const int threads : {0, 1, 4})
        check_one_thread(cases, threads);
}

TEST_CASE("a flow in an arena of one thread stays in it")
{
    const auto cases = many_kinds();
    tbb::task_arena(1).execute([&] { check_one_thread(cases, 0); });
}

TEST_CASE("no more threads work than the caller's arena has")
{
    tbb::task_arena arena(2);
    PolygonMesh mesh = make_quads(3000);
    AllOptions options = FlowOptions{.time_step = 0.001, .cut = {.subdomains = 24}};
    options.report.record_schedule = true;
    const FlowReport report = arena.execute([&] { return smooth_surface(mesh, options); });
    CHECK(report.resources.threads <= 2);
    for (const TaskRecord& record : report.schedule->records)
        CHECK(record.thread < 2);
}
