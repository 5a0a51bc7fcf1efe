#include "samples/meshes/meshes.h"

#include <algorithm>
#include <array>
#include <string>

#include "partition/errors.h"

namespace seamflow {

namespace {

template <class Shape>
Shape varied(Shape shape, const MeshVariation& variation)
{
    shape.seed = variation.seed.value_or(shape.seed);
    shape.amplitude = variation.amplitude.value_or(shape.amplitude);
    shape.noise = variation.noise.value_or(shape.noise);
    return shape;
}

template <class Shape, PolygonMesh (*Make)(Index, const Shape&)>
PolygonMesh make_varied(Index vertices, const MeshVariation& variation)
{
    return Make(vertices, varied(Shape{}, variation));
}

PolygonMesh make_mixed_varied(Index vertices, const MeshVariation& variation)
{
    MixedPolygonsShape shape;
    shape.surface = varied(shape.surface, variation);
    return make_mixed_polygons(vertices, shape);
}

template <PolygonMesh (*Make)(Index, const MachinePartShape&), PartFaces Faces>
PolygonMesh make_part(Index vertices, const MeshVariation& variation)
{
    if (variation.amplitude)
        throw OptionError("amplitude is for waves, but machine parts have none: leave it out");
    const MachinePartShape shape;
    return Make(vertices, {Faces, variation.noise.value_or(shape.noise), variation.seed.value_or(shape.seed)});
}

constexpr std::array<MeshKind, 15> kinds{{
    {"triangles", "height field over the unit square, triangles"},
    {"quads", "height field over the unit square, quads"},
    {"hexagons", "height field over the unit square, a clipped honeycomb"},
    {"mixed", "height field over the unit square, triangles to nonagons"},
    {"cylinder", "open tube of quads, its radius wavy in both directions"},
    {"two-level-cylinder", "open tube of quads, the upper half twice as fine, joined by pentagons"},
    {"noisy-sphere", "closed bumpy sphere of triangles with noise"},
    {"box", "box, triangles"},
    {"box-quads", "the same, quads"},
    {"gear", "spur gear with a bore, triangles"},
    {"gear-quads", "the same, quads"},
    {"stepped-cylinder", "bored cylinder of two radii, triangles"},
    {"stepped-cylinder-quads", "the same, quads"},
    {"chamfered-plate", "plate with a hole, upper edges chamfered, triangles"},
    {"chamfered-plate-quads", "the same, quads"},
}};

using Maker = PolygonMesh (*)(Index, const MeshVariation&);

/// In the order of `kinds`.
constexpr std::array<Maker, kinds.size()> makers{
    make_varied<HeightFieldShape, make_triangles>,
    make_varied<HeightFieldShape, make_quads>,
    make_varied<HeightFieldShape, make_hexagons>,
    make_mixed_varied,
    make_varied<CylinderShape, make_cylinder>,
    make_varied<CylinderShape, make_two_level_cylinder>,
    make_varied<NoisySphereShape, make_noisy_sphere>,
    make_part<make_box, PartFaces::Triangles>,
    make_part<make_box, PartFaces::Quads>,
    make_part<make_gear, PartFaces::Triangles>,
    make_part<make_gear, PartFaces::Quads>,
    make_part<make_stepped_cylinder, PartFaces::Triangles>,
    make_part<make_stepped_cylinder, PartFaces::Quads>,
    make_part<make_chamfered_plate, PartFaces::Triangles>,
    make_part<make_chamfered_plate, PartFaces::Quads>,
};

}  // namespace

std::span<const MeshKind> mesh_kinds()
{
    return kinds;
}

PolygonMesh make_mesh(std::string_view kind, Index vertices, const MeshVariation& variation)
{
    const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const MeshKind& k) { return k.name == kind; });
    if (found != kinds.end())
        return makers[static_cast<std::size_t>(found - kinds.begin())](vertices, variation);
    std::string message = "no kind of mesh is called \"" + std::string(kind) + "\"; there are";
    for (const MeshKind& k : kinds)
        message.append(" ").append(k.name);
    throw OptionError(message);
}

}  // namespace seamflow
