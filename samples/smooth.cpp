// Smooths a mesh: reads it, cuts it into sub-meshes, runs the flow and writes the result (see smooth_program.cpp).
//
// What runs in each step, for every sub-mesh at once (one task graph, no barrier in between):
//
//     assemble and factorise ──► solve ──► correct the interface
//                                  ▲         ▲
//        solve of the adjacent ────┘         └─ solve of all sub-meshes around
//        sub-meshes of lower colour
//        that it takes values from

#include "samples/process/launched_processes.h"
#include "samples/smooth_program.h"

using namespace seamflow;

int main(int argc, char** argv)
{
    return run_program("smooth", [&] {
        const auto end = refuse_several_processes("smooth");
        return end ? *end : run_smooth_program(argc, argv);
    });
}
