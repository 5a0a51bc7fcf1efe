// Remarks: what marks of options become in the words of each caller.

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/remark.h"

using namespace seamflow;

namespace {

std::string in_capitals(std::string_view option, std::string_view value)
{
    return std::string(option == "radius" ? "RADIUS" : option) + (value.empty() ? "" : "=" + std::string(value));
}

}  // namespace

TEST_CASE("each caller reads an option by its own name")
{
    const Wording wording{"Use <radius>, or <boundary free>: <direction 0,0 1>."};
    CHECK(sentence(wording) == "Use radius, or boundary free: direction 0,0 1.");
    CHECK(sentence(wording, in_capitals) == "Use RADIUS, or boundary=free: direction=0,0 1.");
    CHECK(sentence(Wording{"<radius>"}, in_capitals) == "RADIUS");
    CHECK(sentence(Wording{}).empty());
}

TEST_CASE("what is no mark stays as it is")
{
    for (const char* text : {"a<radius>.obj: cannot be read", "3 < 4 << 5", "<", "<<", "a > b", ""}) {
        CAPTURE(text);
        CHECK(sentence(unmarked(text), in_capitals) == text);
        CHECK(sentence(Remark(text), in_capitals) == text);
        CHECK(std::string(InputError(text).what()) == text);
        CHECK(sentence(OptionError(text).wording(), in_capitals) == text);
    }
}

TEST_CASE("a remark has numbers by their names")
{
    const Remark remark("collapse", {{"extent", 0.5}, {"of", 2.0}}, {"<radius>"});
    CHECK(remark.number("of") == 2.0);
    CHECK_FALSE(remark.number("extents"));
    CHECK(sentence(remark) == "radius");
    CHECK(remark == Remark(remark));
    CHECK(remark != Remark("collapse", {{"extent", 0.5}, {"of", 3.0}}, {"<radius>"}));
}

TEST_CASE("errors say options by the library's names, and by a caller's")
{
    const OptionError error(Wording{"<radius> is -1"});
    CHECK(std::string(error.what()) == "radius is -1");
    CHECK(sentence(error.wording(), in_capitals) == "RADIUS is -1");
}
