#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/distributed/rank_setup.h"
#include "engine/distributed/ranks/communicator.h"

namespace seamflow {

/// Fetches rows of vertices without faces on this rank from other ranks.
class RowsOfOthers {
  public:
    /// All ranks call this together.
    /// @param comm, mesh must outlive this. @param wanted numbers of vertices in the whole mesh, ascending; those
    ///        that have no faces on any rank get 0.
    RowsOfOthers(Communicator& comm, const RankMesh& mesh, const std::vector<std::int64_t>& wanted);

    /// All ranks call this together.
    /// @param rows #V by 3: of the vertices that this rank knows. @returns #wanted by 3.
    [[nodiscard]] Points fetch(const Points& rows) const;

  private:
    Communicator* comm_;
    Index n_wanted_;
    /// Per rank: which rows it wants, and which of the wanted ones it has.
    std::vector<std::vector<Index>> theirs_;
    std::vector<std::vector<Index>> ours_;
};

/// The rows of the vertices of a rank's part. All ranks call this together.
/// @param part as it was given. @param mesh what became of it. @param known #V by 3 of `mesh`.
/// @param rows #V by 3 of the part: vertices without faces keep theirs.
Points rows_of_part(Communicator& comm, const MeshPart& part, const RankMesh& mesh, const Points& known, Points rows);

/// Makes a function that replaces the rows of some vertices by those of ranks with faces there. All ranks call this,
/// and later the function, together.
/// @param comm, mesh must outlive it. @param vertices of the part, without faces of this rank; ascending.
std::function<void(Points& rows)> fetch_rows_of_others(Communicator& comm, const RankMesh& mesh,
                                                       std::vector<Index> vertices);

}  // namespace seamflow
