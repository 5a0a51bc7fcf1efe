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
LabelSurface make_varied(Index vertices, const MeshVariation& variation)
{
    return {.mesh = Make(vertices, varied(Shape{}, variation))};
}

LabelSurface make_mixed_varied(Index vertices, const MeshVariation& variation)
{
    MixedPolygonsShape shape;
    shape.surface = varied(shape.surface, variation);
    return {.mesh = make_mixed_polygons(vertices, shape)};
}

void require_no_amplitude(const MeshVariation& variation, const char* what)
{
    if (variation.amplitude)
        throw OptionError(std::string("amplitude is for waves, but ") + what + " have none: leave it out");
}

template <PolygonMesh (*Make)(Index, const MachinePartShape&), PartFaces Faces>
LabelSurface make_part(Index vertices, const MeshVariation& variation)
{
    require_no_amplitude(variation, "machine parts");
    const MachinePartShape shape;
    return {.mesh =
                Make(vertices, {Faces, variation.noise.value_or(shape.noise), variation.seed.value_or(shape.seed)})};
}

template <Labels (*Make)(std::uint32_t seed), PartFaces Faces>
LabelSurface make_sheets(Index vertices, const MeshVariation& variation)
{
    require_no_amplitude(variation, "sheets between labels");
    const std::uint32_t seed = variation.seed.value_or(1);
    const LabelSurface quads = make_label_surface(Make(seed), vertices, variation.noise.value_or(0.0), seed);
    return Faces == PartFaces::Quads ? quads : cut_into_triangles(quads);
}

constexpr std::array<MeshKind, 25> kinds{{
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
    {"balls", "voxel labels: two balls with a common wall, triangles", true},
    {"balls-quads", "the same, quads", true},
    {"bubbles", "voxel labels: three bubbles, whose walls meet in a line, triangles", true},
    {"bubbles-quads", "the same, quads", true},
    {"honeycomb", "voxel labels: the walls of a block of honeycomb, open all around, triangles", true},
    {"honeycomb-quads", "the same, quads", true},
    {"plates", "voxel labels: three plates that meet in a T, open all around, triangles", true},
    {"plates-quads", "the same, quads", true},
    {"foam",
     "voxel labels: a box of 24 cells around random points, and a few single voxels: "
     "triangles",
     true},
    {"foam-quads", "the same, quads", true},
}};

using Maker = LabelSurface (*)(Index, const MeshVariation&);

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
    make_sheets<two_balls, PartFaces::Triangles>,
    make_sheets<two_balls, PartFaces::Quads>,
    make_sheets<three_bubbles, PartFaces::Triangles>,
    make_sheets<three_bubbles, PartFaces::Quads>,
    make_sheets<honeycomb, PartFaces::Triangles>,
    make_sheets<honeycomb, PartFaces::Quads>,
    make_sheets<plates_of_a_t, PartFaces::Triangles>,
    make_sheets<plates_of_a_t, PartFaces::Quads>,
    make_sheets<foam, PartFaces::Triangles>,
    make_sheets<foam, PartFaces::Quads>,
};

}  // namespace

std::span<const MeshKind> mesh_kinds()
{
    return kinds;
}

LabelSurface make_surface(std::string_view kind, Index vertices, const MeshVariation& variation)
{
    const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const MeshKind& k) { return k.name == kind; });
    if (found != kinds.end())
        return makers[static_cast<std::size_t>(found - kinds.begin())](vertices, variation);
    std::string message = "no kind of mesh is called \"" + std::string(kind) + "\"; there are";
    for (const MeshKind& k : kinds)
        message.append(" ").append(k.name);
    throw OptionError(message);
}

PolygonMesh make_mesh(std::string_view kind, Index vertices, const MeshVariation& variation)
{
    return make_surface(kind, vertices, variation).mesh;
}

}  // namespace seamflow
