// Makes a race that ThreadSanitizer must report: what the engine tells it of the order of tasks (engine/thread_order.h)
// may not hide those that have none.
//
//     seamflow_race tasks|loop|pair|none

#include <atomic>
#include <chrono>
#include <cstring>

#include "engine/parallel_loop.h"
#include "engine/task_graph.h"
#include "engine/workers.h"

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

/// Two tasks after one, both of which write; or the second after the first.
void write_in_tasks(long& number, bool ordered)
{
    Meeting meeting;
    const auto write = [&] {
        if (!ordered)
            meeting.arrive();
        ++number;
    };
    TaskGraph graph;
    const auto root = graph.add_root();
    const auto before = graph.add_task([&] { ++number; }, TaskGraph::Priority::Normal);
    const auto one = graph.add_task(write, TaskGraph::Priority::Normal);
    const auto other = graph.add_task(write, TaskGraph::Priority::Normal);
    graph.add_dependency(root, before);
    graph.add_dependency(before, one);
    graph.add_dependency(ordered ? one : before, other);
    for (int run = 0; run < 50; ++run)
        graph.run(root);
}

}  // namespace

int main(int argc, char** argv)
{
    const char* const kind = argc == 2 ? argv[1] : "";
    long number = 0;
    Meeting meeting;
    const auto write = [&] {
        meeting.arrive();
        ++number;
    };
    Workers(2).execute([&] {
        if (std::strcmp(kind, "tasks") == 0)
            write_in_tasks(number, false);
        else if (std::strcmp(kind, "loop") == 0)
            for_each(run_in_parallel, 2, [&](Index) { write(); });
        else if (std::strcmp(kind, "pair") == 0)
            run_both(write, write);
        else
            write_in_tasks(number, true);
    });
    return number > 0 ? 0 : 1;
}
