#pragma once

#include "partition/polygon_mesh.h"
#include "partition/topology.h"
#include "samples/meshes/random_numbers.h"

namespace seamflow {

/// Whether noise may be correlated between neighbours, and how its standard deviation is distributed.
enum class NoiseRange {
    /// Up to 0.78 mean edge lengths, little noise more often; neighbours may be correlated.
    ForNormals,
    /// From 0.015 to 0.8 mean edge lengths, evenly by the logarithm.
    ForNoise,
};

/// The vertices of a mesh with noise. Half of the time it is along the normals; else in all directions, at some
/// vertices only, along one axis, or alike at neighbours. It may grow across the mesh, and coordinates may be rounded.
/// @returns #V by 3.
Points add_noise(const PolygonMesh& mesh, const Topology& topology, NoiseRange range, RandomNumbers& random);

}  // namespace seamflow
