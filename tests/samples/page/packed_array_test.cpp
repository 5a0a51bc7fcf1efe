#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "samples/page/packed_array.h"
#include "tests/samples/page/inflated.h"

using namespace seamflow;

namespace {

template <class Number>
void check_round_trip(std::size_t rows, std::size_t columns)
{
    std::mt19937 random(7);
    std::uniform_int_distribution<std::uint32_t> number(0, std::numeric_limits<Number>::max());
    std::vector<Number> numbers(rows * columns);
    for (Number& value : numbers)
        value = static_cast<Number>(number(random));
    const std::string text = packed(std::span<const Number>(numbers), columns);
    CHECK(text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/=") ==
          std::string::npos);
    CHECK(test::unpacked<Number>(text, columns) == numbers);
}

}  // namespace

TEST_CASE("what is packed comes out again")
{
    for (const std::size_t rows : {0U, 1U, 2U, 3U, 100U})
        for (const std::size_t columns : {1U, 3U}) {
            CAPTURE(rows);
            CAPTURE(columns);
            check_round_trip<std::uint16_t>(rows, columns);
            check_round_trip<std::uint32_t>(rows, columns);
        }
    const std::vector<std::uint8_t> bytes = {0, 255, 1, 7, 7};
    for (std::size_t n = 0; n <= bytes.size(); ++n)
        CHECK(test::inflated(packed(std::span(bytes).first(n))) ==
              std::vector<std::uint8_t>(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n)));
}

TEST_CASE("differences are small numbers: rising and falling rows pack well")
{
    std::vector<std::uint32_t> rising;
    for (std::uint32_t i = 0; i < 30000; ++i)
        rising.push_back(i % 2 == 0 ? 2'000'000'000U + i : 4'000'000'000U - i);
    CHECK(packed(std::span<const std::uint32_t>(rising), 2).size() < 500);
}
