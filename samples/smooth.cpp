// Smooths a mesh: reads it, cuts it into sub-meshes, runs the flow and writes the result (see smooth_program.cpp).
//
// What runs in each step, for every sub-mesh at once (one task graph, no barrier in between):
//
//     assemble and factorise ──► solve ──► correct the interface
//                                  ▲         ▲
//        solve of the adjacent ────┘         └─ solve of all sub-meshes around
//        sub-meshes of lower colour
//        that it takes values from

#include "samples/programs.h"

int main(int argc, char** argv)
{
    return seamflow::run_program("smooth", argc, argv);
}
