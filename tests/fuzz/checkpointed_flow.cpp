#include "tests/fuzz/checkpointed_flow.h"

#include <array>

namespace seamflow::test {

CheckpointedFlow::CheckpointedFlow()
{
    constexpr Index side = 4;
    mesh.vertices.resize(side * side, 3);
    for (Index v = 0; v < side * side; ++v)
        mesh.vertices.row(v) << v % side, v / side, v == 5 || v == 10 ? 0.5 : 0.0;
    for (Index y = 0; y + 1 < side; ++y)
        for (Index x = 0; x + 1 < side; ++x) {
            const Index v = y * side + x;
            mesh.add_face(std::array<Index, 4>{v, v + 1, v + side + 1, v + side});
        }
    options.time_step = 0.1;
    options.steps = 3;
    options.cut.subdomains = 2;
    options.resources.threads = 1;
}

}  // namespace seamflow::test
