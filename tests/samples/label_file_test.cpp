#include <doctest/doctest.h>

#include "partition/errors.h"
#include "samples/common/label_file.h"
#include "tests/samples/temporary_directory.h"

using namespace seamflow;

namespace {

/// The message with which a label file for three faces is refused.
std::string refusal(const TemporaryDirectory& directory, const std::string& content)
{
    try {
        read_labels(directory.file("labels.txt", content), 3);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

bool mentions(const std::string& message, const std::string& words)
{
    return message.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("labels are one whole number a line")
{
    const TemporaryDirectory directory;
    const std::vector<Index> expected{0, 2, 1};
    CHECK(read_labels(directory.file("plain", "0\n2\n1\n"), 3) == expected);
    CHECK(read_labels(directory.file("no_end", "0\n2\n1"), 3) == expected);
    CHECK(read_labels(directory.file("dos", "0\r\n 2 \r\n1\r\n\r\n"), 3) == expected);
    CHECK(read_labels(directory.file("empty", ""), 0).empty());
}

TEST_CASE("other label files are refused with their name, the line and the reason")
{
    const TemporaryDirectory directory;
    CHECK(mentions(refusal(directory, "0\n1\n"), "holds 2 labels, but the mesh has 3 faces"));
    CHECK(mentions(refusal(directory, "0\n1\n1\n1\n"), "holds 4 labels"));
    CHECK(mentions(refusal(directory, "0\n-1\n1\n"), "labels.txt, line 2"));
    CHECK(mentions(refusal(directory, "0\n1.5\n1\n"), "line 2"));
    CHECK(mentions(refusal(directory, "0\n1 2\n"), "line 2"));
    CHECK(mentions(refusal(directory, "0\n\n1\n2\n"), "line 2: empty"));
    CHECK(mentions(refusal(directory, "0\n1\n99999999999\n"), "line 3"));
    CHECK_THROWS_AS(read_labels(directory / "nothing", 3), InputError);
    CHECK_THROWS_AS(read_labels(directory / "", 3), InputError);
}
