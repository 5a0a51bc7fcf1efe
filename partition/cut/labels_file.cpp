#include "partition/cut/labels_file.h"

#include <algorithm>
#include <string>

#include "partition/errors.h"
#include "partition/io/index_lines.h"

namespace seamflow {

std::vector<Index> read_labels(const std::filesystem::path& path, Index n_faces)
{
    constexpr IndexLineWords words{
        .name = "a label",
        .remedy = "write one whole number for each face, each on a line of its own",
        .negative = "number the parts from 0",
    };
    std::vector<Index> labels;
    const std::size_t n_lines = read_index_lines(path, words, [&](Index label, std::size_t line) {
        if (labels.size() == static_cast<std::size_t>(n_faces))
            throw InputError(place_of_line(path, line) + "more labels than the mesh has faces (" +
                             std::to_string(n_faces) +
                             "): remove the surplus, or use the labels with the mesh they belong to");
        labels.push_back(label);
    });
    if (labels.size() != static_cast<std::size_t>(n_faces))
        throw InputError(place_of_line(path, std::max<std::size_t>(n_lines, 1)) + "the file ends after " +
                         std::to_string(labels.size()) + " of " + std::to_string(n_faces) +
                         " labels: give one for each face, or use the labels with the mesh they belong to");
    return labels;
}

}  // namespace seamflow
