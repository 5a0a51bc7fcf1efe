#pragma once

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "tests/support/temporary_directory.h"

namespace seamflow::test {

using Json = nlohmann::json;

/// A small mesh with its own directory, and the programs, run with a shell in that directory.
struct Workshop {
    TemporaryDirectory directory;

    Workshop() { REQUIRE(run(GENERATE " mixed mesh.obj --vertices 900") == 0); }

    /// @returns the exit status; what the program says is in the file `said`.
    [[nodiscard]] int run(const std::string& command) const
    {
        const std::string line = "cd '" + (directory / "").string() + "' && " + command + " >said 2>&1";
        const int status = std::system(line.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    [[nodiscard]] int smooth(const std::string& arguments) const { return run(SMOOTH " " + arguments); }

    [[nodiscard]] std::string said() const { return content_of(directory / "said"); }
    [[nodiscard]] bool has(const std::string& name) const { return std::filesystem::exists(directory / name); }
    [[nodiscard]] Json json(const std::string& name) const { return Json::parse(content_of(directory / name)); }

    [[nodiscard]] std::ptrdiff_t count_lines(const std::string& name, const std::string& start) const
    {
        std::ifstream file(directory / name);
        std::ptrdiff_t count = 0;
        for (std::string line; std::getline(file, line);)
            count += line.starts_with(start) ? 1 : 0;
        return count;
    }
};

}  // namespace seamflow::test
