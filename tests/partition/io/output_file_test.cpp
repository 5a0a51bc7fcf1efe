#include <algorithm>
#include <string>
#include <string_view>

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "partition/errors.h"
#include "partition/io/input_file.h"
#include "partition/io/output_file.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
namespace fs = std::filesystem;

namespace {

void write(const fs::path& path, std::string_view text)
{
    OutputFile file(path);
    file.text(text);
    file.commit();
}

}  // namespace

TEST_CASE("a file appears when it is committed, with the permissions that any new file gets")
{
    const test::TemporaryDirectory directory;
    const mode_t before = ::umask(0027);
    {
        OutputFile file(directory / "a");
        file.text("content");
        CHECK_FALSE(fs::exists(directory / "a"));
        file.commit();
    }
    ::umask(before);
    CHECK(test::content_of(directory / "a") == "content");
    CHECK(fs::status(directory / "a").permissions() == static_cast<fs::perms>(0640));
    CHECK(directory.n_files() == 1);
}

TEST_CASE("without commit nothing remains, and what was there stays")
{
    const test::TemporaryDirectory directory;
    static_cast<void>(directory.with("a", "old"));
    for (const char* name : {"a", "b"}) {
        OutputFile file(directory / name);
        file.text(std::string(3'000'000, 'x'));
    }
    CHECK(directory.n_files() == 1);
    CHECK(test::content_of(directory / "a") == "old");
}

TEST_CASE("a file beside another appears with it, and not before")
{
    const test::TemporaryDirectory directory;
    for (const bool commits : {false, true}) {
        OutputFile file(directory / "a");
        file.text("first");
        file.beside(directory / "b").text("second");
        file.beside(directory / "c").text("third");
        CHECK(directory.n_files() == 0);
        if (commits)
            file.commit();
    }
    CHECK(directory.n_files() == 3);
    CHECK(test::content_of(directory / "a") == "first");
    CHECK(test::content_of(directory / "b") == "second");
    CHECK(test::content_of(directory / "c") == "third");
    // One that cannot be written keeps the others back.
    fs::create_directory(directory / "folder");
    OutputFile file(directory / "a");
    CHECK_THROWS_AS(file.beside(directory / "folder"), OutputError);
    CHECK(directory.n_files() == 4);
}

TEST_CASE("a file that is replaced hands on its permissions")
{
    const test::TemporaryDirectory directory;
    static_cast<void>(directory.with("a", "old"));
    fs::permissions(directory / "a", static_cast<fs::perms>(0604));
    write(directory / "a", "new");
    CHECK(test::content_of(directory / "a") == "new");
    CHECK(fs::status(directory / "a").permissions() == static_cast<fs::perms>(0604));
}

TEST_CASE("links are followed, to files that are not there yet as well; circles are refused")
{
    const test::TemporaryDirectory directory;
    fs::create_directory(directory / "far");
    fs::create_symlink("far/file", directory / "second");
    fs::create_symlink(directory / "second", directory / "first");
    for (const char* text : {"new", "newer"}) {
        write(directory / "first", text);
        CHECK(fs::is_symlink(directory / "first"));
        CHECK(fs::is_symlink(directory / "second"));
        CHECK(test::content_of(directory / "far/file") == text);
    }
    CHECK(file_behind(directory / "first") == directory / "far/file");
    fs::create_symlink("there", directory / "here");
    fs::create_symlink("here", directory / "there");
    CHECK_THROWS_AS(write(directory / "here", "x"), OutputError);
    CHECK(fs::is_symlink(directory / "here"));
}

TEST_CASE("texts of every size around that of a buffer are written as they are, packed or not, at once or in parts")
{
    const test::TemporaryDirectory directory;
    constexpr std::size_t buffer = std::size_t{1} << 20;
    for (const std::size_t n : {std::size_t{1}, buffer - 1, buffer, buffer + 1, 2 * buffer - 1, 2 * buffer,
                                2 * buffer + 1, 3 * buffer + 17}) {
        CAPTURE(n);
        std::string text(n, ' ');
        for (std::size_t i = 0; i < n; ++i)
            text[i] = static_cast<char>('a' + i * i % 23);
        for (const char* name : {"a", "a.gz"})
            for (const std::size_t first : {std::size_t{0}, std::size_t{5}, n / 2, n}) {
                const std::size_t begin = std::min(first, n);
                OutputFile file(directory / name);
                file.text(std::string_view(text).substr(0, begin));
                file.text(std::string_view(text).substr(begin));
                file.commit();
                const InputFile written{OpenFile(directory / name)};
                CHECK((written.content() == text));
            }
    }
}
