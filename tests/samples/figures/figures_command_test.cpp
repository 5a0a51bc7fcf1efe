#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "samples/figures/experiment.h"
#include "samples/figures/experiments.h"
#include "samples/figures/figures_command.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

namespace {

/// The exit status or exception of a command line.
std::optional<ExitStatus> parse(std::vector<std::string> words, FiguresCommand& command)
{
    words.insert(words.begin(), "figures");
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    return parse_figures_command(static_cast<int>(arguments.size()), arguments.data(), command);
}

}  // namespace

TEST_CASE("the command line names figures that there are")
{
    const test::TemporaryDirectory folder;
    const std::string out = (folder / "results").string();
    FiguresCommand command;
    CHECK_FALSE(parse({"--out", out, "teaser", "subdomains"}, command));
    CHECK(std::filesystem::is_directory(out));
    CHECK(command.wants("teaser"));
    CHECK_FALSE(command.wants("texture"));
    CHECK(FiguresCommand{}.wants("texture"));
    FiguresCommand by_number;
    CHECK_FALSE(parse({"--out", out, "9"}, by_number));
    CHECK(by_number.wants("wavy-cylinder"));
    CHECK_FALSE(by_number.wants("texture"));
    const auto refused = [](const std::vector<std::string>& words) {
        FiguresCommand ignored;
        parse(words, ignored);
    };
    CHECK_THROWS_AS(refused({"--out", out, "figure-1"}), OptionError);
    CHECK_THROWS_AS(refused({"--out", out, "3"}), OptionError);
    CHECK_THROWS_AS(refused({"--out", out, "--meshes", folder / "none"}), InputError);
    const std::string meshes = (folder / "meshes").string();
    std::filesystem::create_directory(meshes);
    CHECK_THROWS_WITH_AS(refused({"--out", out, "--meshes", meshes}),
                         doctest::Contains("has none of the authors' meshes"), InputError);
    const std::string theirs(experiments().back().source.file);
    for (const std::string prefix : {"", "ddm__"}) {
        const test::TemporaryDirectory with_one;
        CHECK(!with_one.with(prefix + theirs, "").empty());
        CHECK_NOTHROW(refused({"--out", out, "--meshes", with_one.path().string()}));
    }
    CHECK_THROWS_AS(refused({"--out", folder.with("file", "") / "below"}), OutputError);
}
