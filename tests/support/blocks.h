#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "solvers/systems/schwarz_block.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/matrices.h"
#include "tests/support/owned_memory.h"

namespace seamflow::test {

inline constexpr double time_step_of_blocks = 0.002;

/// Overlapping blocks of a whole cut mesh, assembled and factorised. Their factors live as long as they do.
struct Blocks {
    OwnedMemory memory;
    std::deque<GrownPart> parts;
    std::vector<std::unique_ptr<SchwarzBlock>> blocks;
    std::vector<SchwarzBlock*> views;

    Blocks(const CutMesh& cut, Laplacian laplacian, int layers, SolverWorkspace& workspace,
           double time_step = time_step_of_blocks)
    {
        workspace.factors = &memory;
        const std::vector<Index> rank(cut.n_parts, 0);
        auto faces = faces_by_label(cut.labels, cut.n_parts);
        for (Index s = 0; s < cut.n_parts; ++s) {
            parts.push_back(make_grown_part(cut.mesh, cut.topology, {cut.labels, rank, layers}, SchwarzBlock::reach, s,
                                            std::move(faces[s])));
            blocks.push_back(std::make_unique<SchwarzBlock>(parts.back(), laplacian));
            views.push_back(blocks.back().get());
            views.back()->assemble(localised(parts.back().sub_mesh, cut.mesh.vertices), time_step);
            views.back()->factorise(workspace);
        }
    }
};

}  // namespace seamflow::test
