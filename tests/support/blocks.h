#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "solvers/systems/schwarz_block.h"
#include "tests/support/cut_meshes.h"
#include "tests/support/heap.h"
#include "tests/support/matrices.h"

namespace seamflow::test {

inline constexpr double time_step_of_blocks = 0.002;

/// Overlapping blocks of a whole cut mesh, assembled and factorised.
struct Blocks {
    std::deque<GrownPart> parts;
    std::vector<std::unique_ptr<SchwarzBlock>> blocks;
    std::vector<SchwarzBlock::Factor> factors;

    Blocks(const CutMesh& cut, Laplacian laplacian, int layers, SolverWorkspace& workspace,
           double time_step = time_step_of_blocks)
    {
        const std::vector<Index> rank(cut.n_parts, 0);
        auto faces = faces_by_label(cut.labels, cut.n_parts);
        for (Index s = 0; s < cut.n_parts; ++s) {
            parts.push_back(make_grown_part(cut.mesh, cut.topology, {cut.labels, rank, layers}, SchwarzBlock::reach, s,
                                            std::move(faces[s])));
            SchwarzBlock& block = *blocks.emplace_back(std::make_unique<SchwarzBlock>(parts.back(), laplacian));
            const auto equations = block.assemble(localised(parts.back().sub_mesh, cut.mesh.vertices), time_step);
            factors.push_back(block.factorise(equations, heap(), workspace));
        }
    }
};

}  // namespace seamflow::test
