#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace seamflow::test {

/// The folder of one harness.
class Seeds {
  public:
    Seeds(const std::filesystem::path& root, const std::string& harness)
        : folder_(root / harness)
        , dictionary_(root / (harness + ".dict"))
    {
        std::filesystem::create_directories(folder_);
    }

    [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_ / name; }

    void add(const std::string& name, std::string_view content) const
    {
        std::ofstream file(path(name), std::ios::binary);
        file << content;
        require(file, path(name));
    }

    /// Words that mutations put in.
    void words(const std::vector<std::string>& all) const
    {
        std::ofstream file(dictionary_);
        for (const std::string& word : all)
            file << '"' << word << "\"\n";
        require(file, dictionary_);
    }

  private:
    static void require(std::ofstream& file, const std::filesystem::path& path)
    {
        if (!file.flush())
            throw std::filesystem::filesystem_error("cannot be written", path, {});
    }

    std::filesystem::path folder_;
    std::filesystem::path dictionary_;
};

}  // namespace seamflow::test
