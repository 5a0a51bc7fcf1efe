#include <doctest/doctest.h>

#include "partition/errors.h"
#include "solvers/systems/schwarz_block.h"
#include "tests/support/blocks.h"
#include "tests/support/flows.h"
#include "tests/support/heap.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("the whole step solves the equations of every block, with what is beyond given")
{
    SolverWorkspace workspace;
    for (const CutMesh& cut : cut_meshes())
        for (const Laplacian laplacian : all_laplacians) {
            CAPTURE(cut.name);
            CAPTURE(name_of(laplacian));
            const Points expected = undecomposed_step(cut, laplacian, time_step_of_blocks);
            for (const int layers : {0, 2}) {
                const Blocks blocks(cut, laplacian, layers, workspace);
                for (std::size_t s = 0; s < blocks.blocks.size(); ++s) {
                    const SchwarzBlock* block = blocks.blocks[s].get();
                    const Points solved = localised(block->sub_mesh(), expected);
                    Columns solution;
                    block->solve(blocks.factors[s], solved(block->beyond(), Eigen::all),
                                 SchwarzBlock::RightHandSide::Step, solution, workspace);
                    REQUIRE(solution.rows() == static_cast<Eigen::Index>(block->unknowns().size()));
                    if (solution.rows() > 0)
                        CHECK(largest_difference(solution, solved(block->unknowns(), Eigen::all)) <
                              1e-9 * (1.0 + expected.cwiseAbs().maxCoeff()));
                }
            }
        }
}

TEST_CASE("without a right-hand side, a block answers linearly to what is beyond")
{
    SolverWorkspace workspace;
    const CutMesh& cut = cut_meshes().front();
    const Blocks blocks(cut, Laplacian::PtackovaVelho, 1, workspace);
    for (std::size_t s = 0; s < blocks.blocks.size(); ++s) {
        const SchwarzBlock* block = blocks.blocks[s].get();
        const SchwarzBlock::Factor& factor = blocks.factors[s];
        const Points here = localised(block->sub_mesh(), cut.mesh.vertices)(block->beyond(), Eigen::all);
        const Points there = here.array().square() - 1.0;
        Columns at_here;
        Columns at_there;
        Columns difference;
        block->solve(factor, here, SchwarzBlock::RightHandSide::Step, at_here, workspace);
        block->solve(factor, there, SchwarzBlock::RightHandSide::Step, at_there, workspace);
        block->solve(factor, here - there, SchwarzBlock::RightHandSide::Zero, difference, workspace);
        CHECK(largest_difference(at_here - at_there, difference) < 1e-9);
    }
}

TEST_CASE("equations that are not finite are refused")
{
    SolverWorkspace workspace;
    const CutMesh& cut = cut_meshes().front();
    const Blocks blocks(cut, Laplacian::PtackovaVelho, 1, workspace);
    SchwarzBlock block(blocks.parts.front(), Laplacian::PtackovaVelho);
    const auto equations = block.assemble(Points::Zero(block.sub_mesh().n_vertices, 3), time_step_of_blocks);
    CHECK_THROWS_AS(static_cast<void>(block.factorise(equations, heap(), workspace)), ComputationError);
}
