#include <algorithm>
#include <atomic>
#include <latch>
#include <new>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "engine/ranks/communicator.h"
#include "engine/ranks/transport.h"
#include "tests/engine/ranks/rank_checks.h"

using namespace seamflow;

namespace {

/// What every rank of n throws when `work` runs on all of them: a message each, with the type in front.
std::vector<std::string> thrown_by_ranks(int n, const std::function<void(Communicator&)>& work)
{
    std::vector<std::string> thrown(n);
    run_on_threads(n, [&](Transport& transport) {
        std::string& own = thrown[transport.rank()];
        try {
            run_together(transport, work);
        } catch (const InputError& error) {
            own = std::string("input: ") + error.what();
        } catch (const OptionError& error) {
            own = std::string("option: ") + error.what();
        } catch (const ComputationError& error) {
            own = std::string("computation: ") + error.what();
        } catch (const OutputError& error) {
            own = std::string("output: ") + error.what();
        } catch (const Cancelled& error) {
            own = std::string("cancelled: ") + error.what();
        }
    });
    return thrown;
}

bool all_are(const std::vector<std::string>& thrown, const std::string& expected)
{
    CAPTURE(thrown.front());
    CAPTURE(expected);
    return std::ranges::all_of(thrown, [&](const std::string& message) { return message == expected; });
}

void wait_in_vain(Communicator& comm)
{
    comm.gather_all(std::vector<int>{1});
}

}  // namespace

TEST_CASE("ranks as threads hear each other")
{
    for (const int n : {1, 2, 3, 5, 8}) {
        CAPTURE(n);
        run_on_threads(n, [](Transport& transport) {
            test::check_collectives(transport);
            test::check_pairs(transport);
            test::check_arrivals(transport);
            test::check_failures(transport);
        });
    }
}

TEST_CASE("what one rank throws all throw, by its type")
{
    const auto thrown_by_second = [](auto&& fail) {
        return thrown_by_ranks(3, [&](Communicator& comm) {
            if (comm.rank() == 1)
                fail();
            wait_in_vain(comm);
        });
    };
    const std::string where = "rank 1 on this process: ";
    CHECK(all_are(thrown_by_second([] { throw InputError("a"); }), "input: " + where + "a"));
    CHECK(all_are(thrown_by_second([] { throw OptionError("b"); }), "option: " + where + "b"));
    CHECK(all_are(thrown_by_second([] { throw ComputationError("c"); }), "computation: " + where + "c"));
    CHECK(all_are(thrown_by_second([] { throw OutputError("d"); }), "output: " + where + "d"));
    CHECK(all_are(thrown_by_second([] { throw Cancelled("e"); }), "cancelled: " + where + "e"));
    CHECK(all_are(thrown_by_second([] { throw std::runtime_error("f"); }), "computation: " + where + "f"));
    CHECK(all_are(thrown_by_second([] { throw std::bad_alloc(); }),
                  "computation: " + where + "there is not enough memory: use more ranks, on more machines"));
}

TEST_CASE("of several ranks that fail the lowest is heard")
{
    std::latch both_are_here(2);
    const auto thrown = thrown_by_ranks(4, [&](Communicator& comm) {
        if (comm.rank() >= 2) {
            both_are_here.arrive_and_wait();
            throw InputError("from " + std::to_string(comm.rank()));
        }
        wait_in_vain(comm);
    });
    CHECK(all_are(thrown, "input: rank 2 on this process: from 2"));
}

TEST_CASE("what all ranks find wrong alike is said without the name of one")
{
    CHECK(all_are(thrown_by_ranks(3, [](Communicator&) { throw OptionError("steps is -1"); }), "option: steps is -1"));
}

TEST_CASE("a rank that ends too early is noticed")
{
    const auto thrown = thrown_by_ranks(2, [](Communicator& comm) {
        if (comm.rank() == 1)
            wait_in_vain(comm);
    });
    CHECK(all_are(thrown, "computation: rank 1 on this process: rank 0 has ended too early"));
}

TEST_CASE("bytes that are too few are refused")
{
    Bytes bytes = packed(std::vector<int>{1, 2, 3});
    CHECK(unpacked<int>(bytes) == std::vector<int>{1, 2, 3});
    bytes.pop_back();
    CHECK_THROWS_AS(unpacked<int>(bytes), std::logic_error);
    CHECK_THROWS_AS(unpacked<int>(Bytes(3)), std::logic_error);
}
