#include "samples/page/read_file_colours.h"

#include <algorithm>
#include <functional>

#include "partition/errors.h"
#include "partition/io/input_file.h"
#include "samples/page/obj_colours.h"
#include "samples/page/ply_colours.h"

namespace seamflow {

FileColours read_file_colours(const std::filesystem::path& path, const MeshFile& read, std::span<const Index> left_out)
{
    // Standard input is consumed when the mesh has been read.
    const bool is_obj = read.kind.format == FileFormat::Obj;
    if (is_input_stream(path) || (!is_obj && read.kind.format != FileFormat::Ply))
        return {};
    try {
        const InputFile file{OpenFile(path)};
        FileColours colours = is_obj ? read_obj_colours(path, file.content(), read.mesh, left_out)
                                     : read_ply_colours(path, file.content(), read.mesh, left_out);
        // A single colour carries no information.
        if (std::adjacent_find(colours.of_vertices.begin(), colours.of_vertices.end(), std::not_equal_to<>()) ==
            colours.of_vertices.end())
            colours.of_vertices.clear();
        return colours;
    } catch (const InputError& error) {
        FileColours none;
        none.remarks.push_back(std::string("The page lacks the file's own colours: ") + error.what() + ".");
        return none;
    }
}

}  // namespace seamflow
