#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/samples/workshop.h"

/// Runs of smooth-distributed on ranks of MPI.
namespace seamflow::test {

/// @returns the exit status. @param n ranks.
inline int on_ranks(const Workshop& w, int n, const std::string& arguments)
{
    return w.run("timeout 100 " MPIRUN " -n " + std::to_string(n) + " " SMOOTH_DISTRIBUTED " " + arguments);
}

/// What the program itself said on standard error, without its name: MPI says something, too.
inline std::vector<std::string> messages(const Workshop& w, const std::string& program)
{
    std::vector<std::string> found;
    std::ifstream file(w.directory / "said");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with(program + ": "))
            found.push_back(line.substr(program.size() + 2));
    return found;
}

/// Runs three ranks, kills one as soon as a shell's condition holds, and waits for the others.
/// @param until may wait for a number of the process in `pid.1`, and for what is said in `out`; $! is mpirun.
/// @returns the exit status.
inline int on_ranks_of_which_one_is_killed(const Workshop& w, const std::string& arguments, const std::string& until)
{
    std::ofstream(w.directory / "rank.sh") << "echo $$ >pid.$OMPI_COMM_WORLD_RANK\n"
                                              "exec " SMOOTH_DISTRIBUTED " "
                                           << arguments << '\n';
    std::ofstream(w.directory / "kill.sh") << "timeout 100 " MPIRUN " -n 3 sh rank.sh >out 2>&1 &\n"
                                              "until "
                                           << until
                                           << "; do sleep 0.1; kill -0 $! || { echo ended before; exit 0; }; done\n"
                                              "kill -9 $(cat pid.1)\n"
                                              "wait $!\n";
    return w.run("sh kill.sh");
}

/// Writes an OBJ file in which every face has vertices of its own.
inline void write_soup(const std::filesystem::path& from, const std::filesystem::path& to)
{
    std::ifstream file(from);
    std::ofstream soup(to);
    std::vector<std::string> vertices;
    std::size_t n = 0;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("v "))
            vertices.push_back(line);
        if (!line.starts_with("f "))
            continue;
        std::istringstream corners(line.substr(2));
        std::string face = "f";
        for (std::size_t v = 0; corners >> v;) {
            soup << vertices.at(v - 1) << '\n';
            face.append(" ").append(std::to_string(++n));
        }
        soup << face << '\n';
    }
}

template <class Value>
Value number_at(std::string_view bytes, std::size_t offset)
{
    Value value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

/// The count of an element in the header of a PLY file.
inline std::size_t count_in(const std::string& content, const std::string& element)
{
    return std::stoul(content.substr(content.find("element " + element) + element.size() + 9));
}

/// Writes the labels of a file of --parts.
inline void write_labels_of(const std::filesystem::path& parts, const std::filesystem::path& labels)
{
    const std::string content = content_of(parts);
    const std::string end = "end_header\n";
    std::size_t offset = content.find(end) + end.size() + 24 * count_in(content, "vertex");
    std::ofstream file(labels);
    for (std::size_t left = count_in(content, "face"); left > 0; --left) {
        offset += 1 + 4 * std::size_t{number_at<std::uint8_t>(content, offset)} + 3;
        file << number_at<std::int32_t>(content, offset) << '\n';
        offset += 4;
    }
}

}  // namespace seamflow::test
