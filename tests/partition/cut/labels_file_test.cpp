#include <filesystem>
#include <fstream>
#include <string>

#include <doctest/doctest.h>

#include "partition/cut/labels_file.h"
#include "partition/errors.h"

using namespace seamflow;

namespace {

/// A file in the folder for temporary files that goes away with the object.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::string& text) { std::ofstream(path_) << text; }
    ~TemporaryFile() { std::filesystem::remove(path_); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_ = std::filesystem::temp_directory_path() / "seamflow_labels_file_test.txt";
};

std::string refusal(const std::string& text, Index n_faces)
{
    const TemporaryFile file(text);
    try {
        read_labels(file.path(), n_faces);
    } catch (const InputError& error) {
        const std::string message = error.what();
        CHECK(message.starts_with(file.path().string() + ":"));
        return message.substr(file.path().string().size());
    }
    return "";
}

}  // namespace

TEST_CASE("labels are read, one a line, with comments and blank lines between")
{
    const TemporaryFile file("# two parts\n0\n\n 1 \t# here the second begins\r\n1\r\n2147483647");
    CHECK(read_labels(file.path(), 4) == std::vector<Index>{0, 1, 1, 2147483647});
}

TEST_CASE("a bad line is named")
{
    CHECK(refusal("0\n1.5\n", 2).starts_with(":2: '1.5' is not a label"));
    CHECK(refusal("0 1\n", 2).starts_with(":1: '0 1' is not a label"));
    CHECK(refusal("\n\nx\n", 1).starts_with(":3: 'x' is not a label"));
    CHECK(refusal("0\n-4\n", 2).starts_with(":2: '-4' is negative"));
    CHECK(refusal("99999999999\n", 1).starts_with(":1: '99999999999' is too large"));
}

TEST_CASE("too few and too many labels are refused")
{
    CHECK(refusal("0\n1\n", 3).starts_with(":2: the file ends after 2 of 3 labels"));
    CHECK(refusal("0\n1\n1\n", 2).starts_with(":3: more labels than the mesh has faces (2)"));
    CHECK(refusal("", 1).starts_with(":1: the file ends after 0 of 1 labels"));
}

TEST_CASE("files that cannot be read are refused")
{
    CHECK_THROWS_AS(read_labels("/nonexistent/labels.txt", 1), InputError);
    CHECK_THROWS_AS(read_labels(std::filesystem::temp_directory_path(), 1), InputError);
}
