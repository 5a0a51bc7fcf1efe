#pragma once

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/distributed/ranks/conversation.h"
#include "partition/errors.h"

/// What holds of ranks of any kind: called by each of them.
namespace seamflow::test {

/// Numbers that only one rank would send to another.
inline std::vector<std::int64_t> letter(int from, int to, std::size_t n)
{
    std::vector<std::int64_t> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 1'000'000 * from + 1'000 * to);
    return numbers;
}

/// Everybody gets what each gives, and what each has for him, messages of any length.
inline void check_collectives(Communicator& communicator)
{
    run_together(communicator, [](Conversation& talk) {
        for (const std::size_t n : {0, 1, 7, 100'000}) {
            // The first gives most.
            const auto length = [&](int from) { return from == 0 ? n : n / 2; };
            const auto all = talk.gather_all(letter(talk.rank(), 0, length(talk.rank())));
            std::vector<std::int64_t> expected;
            for (int r = 0; r < talk.size(); ++r)
                for (const std::int64_t number : letter(r, 0, length(r)))
                    expected.push_back(number);
            CHECK(all == expected);

            std::vector<Bytes> to_each;
            for (int r = 0; r < talk.size(); ++r)
                to_each.push_back(packed(letter(talk.rank(), r, n)));
            const std::vector<Bytes> from_each = talk.exchange(std::move(to_each));
            for (int r = 0; r < talk.size(); ++r)
                CHECK(unpacked<std::int64_t>(from_each[r]) == letter(r, talk.rank(), n));
        }
    });
}

/// What is sent to one rank waits until this asks for it, and collective functions do not see it.
inline void check_arrivals(Communicator& communicator)
{
    run_together(communicator, [](Conversation& talk) {
        constexpr int n_letters = 5;
        for (int r = 0; r < talk.size(); ++r)
            for (int i = 0; i < n_letters && r != talk.rank(); ++i)
                talk.send(r, packed(letter(talk.rank(), i, i)));
        CHECK(talk.gather_all(std::vector<int>{talk.rank()}).size() == static_cast<std::size_t>(talk.size()));
        std::vector<int> n_from(talk.size(), 0);
        for (int i = 0; i < n_letters * (talk.size() - 1);) {
            const auto message = talk.next_arrival(std::chrono::milliseconds(10));
            if (!message)
                continue;
            ++i;
            // In the order in which one rank has sent them.
            const int number = n_from[message->from]++;
            CHECK(unpacked<std::int64_t>(message->bytes) == letter(message->from, number, number));
        }
        CHECK_FALSE(talk.next_arrival(std::chrono::microseconds(1)));
    });
}

/// If one rank fails, all throw what it has thrown, and the next work is not disturbed by what is left.
inline void check_failures(Communicator& communicator)
{
    for (int failing = 0; failing < communicator.size(); ++failing) {
        std::string message;
        try {
            run_together(communicator, [&](Conversation& talk) {
                talk.gather_all(std::vector<int>(3));
                for (int r = 0; r < talk.size(); ++r)
                    if (r != talk.rank())
                        talk.send(r, Bytes(50'000));
                if (talk.rank() == failing)
                    throw InputError("face 7 has no end");
                talk.gather_all(std::vector<int>(5));
            });
        } catch (const InputError& error) {
            message = error.what();
        }
        CHECK(message == (communicator.size() == 1 ? "face 7 has no end"
                                                   : "rank " + std::to_string(failing) + " on " + communicator.host() +
                                                         ": face 7 has no end"));
        check_arrivals(communicator);
    }
}

/// What all ranks agree on is said without the name of a rank, however fast each of them learns of it.
inline void check_agreement(Communicator& communicator)
{
    const int last = communicator.size() - 1;
    for (int turn = 0; turn < 20; ++turn) {
        std::string message;
        try {
            run_together(communicator, [&](Conversation& talk) {
                int n = 0;
                talk.at_first_rank([&] { n = 1; });
                CHECK(n == (talk.rank() == 0 ? 1 : 0));
                CHECK_THROWS_WITH_AS(talk.at_first_rank([] { throw OutputError("no room"); }), "no room", OutputError);
                talk.look_together([&] {
                    if (talk.rank() > last / 2)
                        throw InputError("line " + std::to_string(talk.rank()));
                });
            });
        } catch (const InputError& error) {
            message = error.what();
        }
        CHECK(message == (last == 0 ? "" : "line " + std::to_string(last / 2 + 1)));
    }
}

}  // namespace seamflow::test
