// Makes a race that ThreadSanitizer must report: what the engine tells it of the order of tasks
// (solvers/platform/thread_sanitizer.h) may not hide those that have none.
//
//     seamflow_race tasks|loop|pair|none

#include <atomic>
#include <chrono>
#include <memory>
#include <string>

#include "engine/tasks/parallel_executor.h"
#include "engine/tasks/task_graph.h"
#include "engine/tasks/workers.h"

using namespace seamflow;

namespace {

/// Two threads that meet here go on at the same time; what they did before stays unordered. Gives up after a second.
class Meeting {
  public:
    void arrive()
    {
        const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(1);
        n_arrived_.fetch_add(1, std::memory_order_relaxed);
        while (n_arrived_.load(std::memory_order_relaxed) < 2 && std::chrono::steady_clock::now() < latest) {
        }
    }

  private:
    std::atomic<int> n_arrived_{0};
};

/// So often is a race made: now and then one thread does both parts before another has come.
constexpr int attempts = 20;

/// Two tasks after one, both of which write; or the second after the first.
void write_in_tasks(long& number, bool ordered)
{
    std::unique_ptr<Meeting> meeting;
    const auto write = [&] {
        if (!ordered)
            meeting->arrive();
        ++number;
    };
    TaskGraph graph;
    const auto root = graph.add_root();
    const auto before = graph.add_task([&] { ++number; }, ScheduledTask());
    const auto one = graph.add_task(write, ScheduledTask());
    const auto other = graph.add_task(write, ScheduledTask());
    graph.add_dependency(root, before);
    graph.add_dependency(before, one);
    graph.add_dependency(ordered ? one : before, other);
    for (int attempt = 0; attempt < attempts; ++attempt) {
        meeting = std::make_unique<Meeting>();
        graph.run(root);
    }
}

/// Both parts of a loop, or of a pair, write.
void write_at_once(long& number, bool in_loop)
{
    for (int attempt = 0; attempt < attempts; ++attempt) {
        Meeting meeting;
        const auto write = [&] {
            meeting.arrive();
            ++number;
        };
        if (in_loop)
            for_each(run_in_parallel, 2, [&](Index) { write(); });
        else
            run_both(write, write);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    const std::string kind = argc == 2 ? argv[1] : "";
    long number = 0;
    Workers(2).execute([&] {
        if (kind == "loop" || kind == "pair")
            write_at_once(number, kind == "loop");
        else
            write_in_tasks(number, kind != "tasks");
    });
    return number > 0 ? 0 : 1;
}
