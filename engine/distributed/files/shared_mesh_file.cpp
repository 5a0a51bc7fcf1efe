#include "engine/distributed/files/shared_mesh_file.h"

#include "partition/errors.h"

namespace seamflow {

void SharedMeshFile::refuse_fields() const
{
    throw InputError(name_ + ": ranks read and write slices of fields only in binary PLY files: convert the file, or "
                             "let one rank read all of it (--whole-up-to)");
}

FileFields SharedMeshFile::read_fields(Communicator& /*comm*/, const std::vector<std::string>& /*names*/)
{
    refuse_fields();
}

std::vector<std::string> SharedMeshFile::write_fields(Communicator& /*comm*/, const std::filesystem::path& /*path*/,
                                                      FileFields& /*fields*/)
{
    refuse_fields();
}

}  // namespace seamflow
