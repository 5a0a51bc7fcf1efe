#pragma once

#include <span>
#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// The part of a surface that faces connect with some vertices, in a unit of length of about its size.
struct ComponentOfSources {
    PolygonMesh mesh;
    /// Of the whole surface.
    std::vector<Index> vertices;
    /// In the component.
    std::vector<Index> from;
    double unit = 1.0;
};

/// @param from vertices of a surface. @returns those with faces, in components.
std::vector<ComponentOfSources> components_of(const PolygonMesh& surface, std::span<const Index> from);

}  // namespace seamflow
