#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>

#include "engine/distributed/ranks/communicator.h"
#include "partition/executor.h"
#include "partition/formats/mesh_io.h"
#include "partition/io/fault_log.h"
#include "partition/polygon_mesh.h"

namespace seamflow {

/// One rank's share of the facets of an STL file: about as many as every other rank's.
class StlShare {
  public:
    StlShare() = default;
    StlShare(const StlShare&) = delete;
    StlShare& operator=(const StlShare&) = delete;
    virtual ~StlShare() = default;

    /// The bytes of this rank.
    [[nodiscard]] virtual std::string_view bytes() const = 0;

    /// Reads the facets. All ranks call this together.
    /// @param faces without vertices; receives them, with numbers of the points that are returned as corners.
    /// @param faults receives what is left out, numbered from 0 in this share.
    /// @throws InputError as read_stl.
    virtual Points read(Communicator& comm, PolygonMesh& faces, FaultLog& faults) const = 0;

    /// Says that all facets together have no vertices. All ranks call this together.
    /// @throws InputError
    virtual void refuse_empty(Communicator& comm) const = 0;
};

/// All ranks call this together.
/// @param content must outlive the result.
/// @throws InputError as read_stl.
std::unique_ptr<StlShare> share_stl(Communicator& comm, const std::filesystem::path& path, std::string_view content,
                                    Encoding encoding, const Executor& exec);

}  // namespace seamflow
