#include <algorithm>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "engine/options/option_table.h"
#include "partition/errors.h"
#include "samples/command/command_line.h"
#include "samples/command/smooth_options.h"

using namespace seamflow;

TEST_CASE("numbers are read strictly")
{
    CHECK(parse_real("0.05", positive()) == 0.05);
    CHECK(parse_real("1e-3", positive()) == 1e-3);
    CHECK(parse_real("-2", {-2.0, 5.0}) == -2.0);
    for (const char* text : {"", " 1", "0.05x", "nan", "inf", "-inf", "1e999", "0", "-1", "0x10", "1,5", "."})
        CHECK_THROWS_AS(parse_real(text, positive()), OptionError);
}

TEST_CASE("whole numbers are read strictly")
{
    CHECK(parse_integer("12", 0, 100) == 12);
    CHECK(parse_integer("010", 0, 100) == 10);
    for (const char* text : {"", "1.5", "1e2", "-1", "101", "12a", "99999999999999999999"})
        CHECK_THROWS_AS(parse_integer(text, 0, 100), OptionError);
}

TEST_CASE("numbers of bytes are read strictly, with units")
{
    CHECK(parse_bytes("1") == 1);
    CHECK(parse_bytes("123456789012") == 123'456'789'012);
    CHECK(parse_bytes("1e9") == 1'000'000'000);
    CHECK(parse_bytes("2K") == 2'000);
    CHECK(parse_bytes("1.5MB") == 1'500'000);
    CHECK(parse_bytes("3GiB") == std::size_t{3} << 30);
    CHECK(parse_bytes("1TiB") == std::size_t{1} << 40);
    for (const char* text : {"", "0", "-1", "0.5", "K", "MiB", "1 M", "1m", "1MiBB", "1i", "1Ki", "1B", "1KMB", "0x10",
                             "nan", "inf", "1e30", "9999999999T", "1M5"})
        CHECK_THROWS_AS(parse_bytes(text), OptionError);
}

TEST_CASE("lengths are read strictly, in units of length or of the diagonal")
{
    CHECK(parse_length("0.5").value == 0.5);
    CHECK_FALSE(parse_length("0.5").of_diagonal);
    CHECK(parse_length("2%").value == 0.02);
    CHECK(parse_length("2%").of_diagonal);
    for (const char* text : {"", "%", "0", "0%", "-1%", "2 %", "2%%", "2mm", "nan%", "inf"})
        CHECK_THROWS_AS(parse_length(text), OptionError);
}

TEST_CASE("smooth has each option of the table once, with the text and the group of its row")
{
    CLI::App app;
    SmoothCommand command;
    add_options(app, command);
    for (const OptionTraits& row : all_options()) {
        if (row.option.empty())
            continue;
        CAPTURE(row.option);
        CHECK(std::ranges::count(smooth_options(), row.option, &OptionTraits::option) == 1);
        const CLI::Option* const option = app.get_option_no_throw(std::string(row.option));
        REQUIRE(option != nullptr);
        CHECK(option->get_group() == row.group);
        CHECK(option->get_description() == row.text);
        CHECK_FALSE(row.text.empty());
    }
}
