#include <array>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "engine/tasks/task_graph.h"
#include "engine/tasks/workers.h"

using namespace seamflow;

namespace {

/// Tasks without and with priority.
struct Priority {
    static constexpr ScheduledTask normal{TaskKind::AssembleAndFactorise};
    static constexpr ScheduledTask high{TaskKind::Solve};
};

/// A graph of `depth` layers of `width` tasks, each after three of the layer before, that notes when a task starts too
/// early.
class Layers {
  public:
    Layers(int width, int depth)
        : done_(static_cast<std::size_t>(width * depth))
    {
        root = graph.add_root();
        for (int layer = 0; layer < depth; ++layer)
            for (int i = 0; i < width; ++i)
                add(layer, i, width);
    }

    void reset()
    {
        for (auto& done : done_)
            done = 0;
    }

    [[nodiscard]] int count() const
    {
        int sum = 0;
        for (const auto& done : done_)
            sum += done;
        return sum;
    }

    TaskGraph graph;
    TaskGraph::Node root = 0;
    std::atomic<int> too_early{0};

  private:
    void add(int layer, int i, int width)
    {
        const auto place = [width](int l, int j) { return static_cast<std::size_t>(l * width + (j + width) % width); };
        const auto node = graph.add_task(
            [this, place, layer, i] {
                if (layer > 0)
                    for (const int j : {i - 1, i, i + 1})
                        too_early += done_[place(layer - 1, j)] == 1 ? 0 : 1;
                ++done_[place(layer, i)];
            },
            i % 2 == 0 ? Priority::normal : Priority::high);
        nodes_.push_back(node);
        if (layer == 0)
            graph.add_dependency(root, node);
        else
            for (const int j : {i - 1, i, i + 1})
                graph.add_dependency(nodes_[place(layer - 1, j)], node);
    }

    std::vector<TaskGraph::Node> nodes_;
    std::vector<std::atomic<int>> done_;
};

}  // namespace

TEST_CASE("tasks wait for what they depend on, in every run, with any number of threads")
{
    for (int threads = 1; threads <= 8; ++threads) {
        Workers workers(threads);
        workers.execute([&] {
            Layers layers(40, 10);
            for (int run = 0; run < 20; ++run) {
                layers.reset();
                layers.graph.run(layers.root);
                CHECK(layers.count() == 400);
            }
            CHECK(layers.too_early == 0);
        });
    }
}

TEST_CASE("a root reaches its own tasks alone")
{
    TaskGraph graph;
    int first = 0;
    int second = 0;
    const auto roots = {graph.add_root(), graph.add_root()};
    graph.add_dependency(*roots.begin(), graph.add_task([&] { ++first; }, Priority::normal));
    graph.add_dependency(*(roots.begin() + 1), graph.add_task([&] { ++second; }, Priority::normal));
    graph.run(*(roots.begin() + 1));
    CHECK(first == 0);
    CHECK(second == 1);
}

TEST_CASE("a failure comes out of run, what depends on it does not start, and the graph runs again")
{
    for (int threads = 1; threads <= 8; ++threads) {
        Workers workers(threads);
        workers.execute([&] {
            TaskGraph graph;
            std::atomic<bool> fails{true};
            std::atomic<int> after{0};
            const auto root = graph.add_root();
            for (int i = 0; i < 50; ++i) {
                const auto first = graph.add_task(
                    [&fails, i] {
                        if (fails && i == 17)
                            throw std::runtime_error("seventeen");
                    },
                    Priority::normal);
                const auto second = graph.add_task([&after] { ++after; }, Priority::high);
                graph.add_dependency(root, first);
                graph.add_dependency(first, second);
            }
            for (int run = 0; run < 10; ++run) {
                after = 0;
                fails = true;
                CHECK_THROWS_WITH(graph.run(root), "seventeen");
                CHECK(after < 50);
                after = 0;
                fails = false;
                graph.run(root);
                CHECK(after == 50);
            }
        });
    }
}

TEST_CASE("of two failures at once the one of the task that was added first comes out")
{
    Workers workers(2);
    workers.execute([&] {
        TaskGraph graph;
        std::array<std::atomic<bool>, 2> begun{};
        // For as long as it takes until both threads are there; a second that is left alone does not fail.
        const auto both_begin = [&](std::size_t i) {
            begun[i] = true;
            const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
            while (!begun[1 - i] && std::chrono::steady_clock::now() < end)
                std::this_thread::yield();
            return begun[1 - i].load();
        };
        const auto root = graph.add_root();
        const auto first = graph.add_task(
            [&] {
                both_begin(0);
                throw std::runtime_error("first");
            },
            Priority::normal);
        const auto second = graph.add_task(
            [&] {
                if (both_begin(1))
                    throw std::runtime_error("second");
            },
            Priority::normal);
        graph.add_dependency(root, first);
        graph.add_dependency(root, second);
        for (int run = 0; run < 20; ++run) {
            begun[0] = begun[1] = false;
            CHECK_THROWS_WITH(graph.run(root), "first");
        }
    });
}

TEST_CASE("events wait for their signal and for tasks before them, whichever comes first, in every run")
{
    for (int threads = 1; threads <= 4; ++threads) {
        CAPTURE(threads);
        Workers workers(threads);
        workers.execute([&] {
            TaskGraph graph;
            std::atomic<int> n_before{0};
            std::atomic<int> n_signalled{0};
            std::atomic<int> n_events{0};
            std::atomic<int> n_after{0};
            std::atomic<int> too_early{0};
            const auto root = graph.add_root();
            const auto before = graph.add_task([&] { ++n_before; }, Priority::normal);
            graph.add_dependency(root, before);
            std::vector<TaskGraph::Node> events;
            const auto after = graph.add_task(
                [&] {
                    ++n_after;
                    too_early += n_events == 10 * n_after ? 0 : 1;
                },
                Priority::normal);
            for (int i = 0; i < 10; ++i) {
                events.push_back(graph.add_event(
                    [&, i] {
                        ++n_events;
                        // Half of them wait for the task, too.
                        too_early += (i % 2 == 0 && n_before != n_after + 1) || n_signalled < n_events ? 1 : 0;
                    },
                    Priority::high));
                graph.add_dependency(i % 2 == 0 ? before : root, events.back());
                graph.add_dependency(events.back(), after);
            }
            for (int run = 0; run < 20; ++run) {
                const std::jthread outside([&] {
                    for (const auto event : events) {
                        if (run % 3 == 0)
                            std::this_thread::sleep_for(std::chrono::microseconds(300));
                        ++n_signalled;
                        graph.signal(event);
                    }
                });
                graph.run(root);
                CHECK(n_after == run + 1);
                CHECK(n_events == 10 * (run + 1));
            }
            CHECK(too_early == 0);
        });
    }
}

TEST_CASE("a run fails from outside, and the next one does not")
{
    Workers workers(2);
    workers.execute([&] {
        TaskGraph graph;
        std::atomic<int> n_run{0};
        const auto root = graph.add_root();
        const auto event = graph.add_event([&] { ++n_run; }, Priority::normal);
        graph.add_dependency(root, event);
        const auto run = [&](bool fails) {
            const std::jthread outside([&] {
                if (fails)
                    graph.fail(std::make_exception_ptr(std::runtime_error("from outside")));
                graph.signal(event);
            });
            graph.run(root);
        };
        CHECK_THROWS_WITH(run(true), "from outside");
        CHECK(n_run == 0);
        run(false);
        CHECK(n_run == 1);
    });
}
