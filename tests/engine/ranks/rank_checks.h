#pragma once

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/ranks/communicator.h"
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
inline void check_collectives(Transport& transport)
{
    run_together(transport, [](Communicator& comm) {
        for (const std::size_t n : {0, 1, 7, 100'000}) {
            // The first gives most.
            const auto length = [&](int from) { return from == 0 ? n : n / 2; };
            const auto all = comm.gather_all(letter(comm.rank(), 0, length(comm.rank())));
            std::vector<std::int64_t> expected;
            for (int r = 0; r < comm.size(); ++r)
                for (const std::int64_t number : letter(r, 0, length(r)))
                    expected.push_back(number);
            CHECK(all == expected);

            std::vector<int> others;
            std::vector<Bytes> to_each;
            for (int r = 0; r < comm.size(); ++r)
                if (r != comm.rank()) {
                    others.push_back(r);
                    to_each.push_back(packed(letter(comm.rank(), r, n)));
                }
            const std::vector<Bytes> from_each = comm.exchange(others, std::move(to_each));
            for (std::size_t i = 0; i < others.size(); ++i)
                CHECK(unpacked<std::int64_t>(from_each[i]) == letter(others[i], comm.rank(), n));
        }
    });
}

/// What ranks give each other is taken in order, in one work after the other of the same communicator.
inline void check_pairs(Transport& transport)
{
    Communicator comm(transport);
    for (int turn = 0; turn < 20; ++turn)
        comm.run([&] {
            for (int r = 0; r < comm.size(); ++r)
                for (int i = 0; i < 2 && r != comm.rank(); ++i)
                    comm.give(r, packed(letter(comm.rank(), i + turn, 10)));
            for (int r = 0; r < comm.size(); ++r)
                for (int i = 0; i < 2 && r != comm.rank(); ++i)
                    CHECK(unpacked<std::int64_t>(comm.take(r)) == letter(r, i + turn, 10));
        });
}

/// What is sent to one rank waits until this asks for it, and collective functions do not see it.
inline void check_arrivals(Transport& transport)
{
    run_together(transport, [](Communicator& comm) {
        constexpr int n_letters = 5;
        for (int r = 0; r < comm.size(); ++r)
            for (int i = 0; i < n_letters && r != comm.rank(); ++i)
                comm.send(r, packed(letter(comm.rank(), i, i)));
        CHECK(comm.gather_all(std::vector<int>{comm.rank()}).size() == static_cast<std::size_t>(comm.size()));
        std::vector<int> n_from(comm.size(), 0);
        for (int i = 0; i < n_letters * (comm.size() - 1);) {
            const auto message = comm.next_arrival(std::chrono::milliseconds(10));
            if (!message)
                continue;
            ++i;
            // In the order in which one rank has sent them.
            const int number = n_from[message->from]++;
            CHECK(unpacked<std::int64_t>(message->bytes) == letter(message->from, number, number));
        }
        CHECK_FALSE(comm.next_arrival(std::chrono::microseconds(1)));
    });
}

/// If one rank fails, all throw what it has thrown, and the next work is not disturbed by what is left.
inline void check_failures(Transport& transport)
{
    for (int failing = 0; failing < transport.size(); ++failing) {
        std::string message;
        try {
            run_together(transport, [&](Communicator& comm) {
                comm.gather_all(std::vector<int>(3));
                for (int r = 0; r < comm.size(); ++r)
                    if (r != comm.rank())
                        comm.send(r, Bytes(50'000));
                if (comm.rank() == failing)
                    throw InputError("face 7 has no end");
                comm.gather_all(std::vector<int>(5));
            });
        } catch (const InputError& error) {
            message = error.what();
        }
        CHECK(message == (transport.size() == 1
                              ? "face 7 has no end"
                              : "rank " + std::to_string(failing) + " on " + transport.host() + ": face 7 has no end"));
        check_arrivals(transport);
    }
}

}  // namespace seamflow::test
