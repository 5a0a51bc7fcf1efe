// Checks ranks that are processes of MPI; each of them runs this program (mpirun -n R mpi_ranks).

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "engine/distributed/mpi_communicator.h"
#include "tests/engine/distributed/rank_checks.h"

namespace {

seamflow::Communicator* communicator = nullptr;

}  // namespace

TEST_CASE("ranks of MPI hear each other")
{
    seamflow::test::check_collectives(*communicator);
    seamflow::test::check_arrivals(*communicator);
    seamflow::test::check_failures(*communicator);
}

int main(int argc, char** argv)
{
    // Longer messages go in pieces.
    const auto world = seamflow::make_mpi_communicator(10'000);
    communicator = world.get();
    return doctest::Context(argc, argv).run();
}
