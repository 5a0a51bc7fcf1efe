#include "samples/meshes/meshes.h"

#include <string>
#include <vector>

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
LabelSurface make_varied(Index vertices, const MeshVariation& variation, PartFaces /*faces*/)
{
    return {.mesh = Make(vertices, varied(Shape{}, variation))};
}

LabelSurface make_mixed_varied(Index vertices, const MeshVariation& variation, PartFaces /*faces*/)
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

template <PolygonMesh (*Make)(Index, const MachinePartShape&)>
LabelSurface make_part(Index vertices, const MeshVariation& variation, PartFaces faces)
{
    require_no_amplitude(variation, "machine parts");
    const MachinePartShape shape;
    return {.mesh =
                Make(vertices, {faces, variation.noise.value_or(shape.noise), variation.seed.value_or(shape.seed)})};
}

template <Labels (*Make)(std::uint32_t seed)>
LabelSurface make_sheets(Index vertices, const MeshVariation& variation, PartFaces faces)
{
    require_no_amplitude(variation, "sheets between labels");
    const std::uint32_t seed = variation.seed.value_or(1);
    const LabelSurface quads = make_label_surface(Make(seed), vertices, variation.noise.value_or(0.0), seed);
    return faces == PartFaces::Quads ? quads : cut_into_triangles(quads);
}

/// A kind of mesh, and the same of quads where there is one, with another name.
struct KindMaker {
    const char* name;
    const char* description;
    LabelSurface (*make)(Index vertices, const MeshVariation& variation, PartFaces faces);
    bool has_quads = false;
    bool has_cells = false;
};

constexpr KindMaker kind_makers[] = {
    {"triangles", "height field over the unit square, triangles", make_varied<HeightFieldShape, make_triangles>},
    {"quads", "height field over the unit square, quads", make_varied<HeightFieldShape, make_quads>},
    {"hexagons", "height field over the unit square, a clipped honeycomb",
     make_varied<HeightFieldShape, make_hexagons>},
    {"mixed", "height field over the unit square, triangles to nonagons", make_mixed_varied},
    {"cylinder", "open tube of quads, its radius wavy in both directions", make_varied<CylinderShape, make_cylinder>},
    {"two-level-cylinder", "open tube of quads, the upper half twice as fine, joined by pentagons",
     make_varied<CylinderShape, make_two_level_cylinder>},
    {"noisy-sphere", "closed bumpy sphere of triangles with noise", make_varied<NoisySphereShape, make_noisy_sphere>},
    {"box", "box, triangles", make_part<make_box>, true},
    {"gear", "spur gear with a bore, triangles", make_part<make_gear>, true},
    {"stepped-cylinder", "bored cylinder of two radii, triangles", make_part<make_stepped_cylinder>, true},
    {"chamfered-plate", "plate with a hole, upper edges chamfered, triangles", make_part<make_chamfered_plate>, true},
    {"balls", "voxel labels: two balls with a common wall, triangles", make_sheets<two_balls>, true, true},
    {"bubbles", "voxel labels: three bubbles, whose walls meet in a line, triangles", make_sheets<three_bubbles>, true,
     true},
    {"honeycomb", "voxel labels: the walls of a block of honeycomb, open all around, triangles", make_sheets<honeycomb>,
     true, true},
    {"plates", "voxel labels: three plates that meet in a T, open all around, triangles", make_sheets<plates_of_a_t>,
     true, true},
    {"foam", "voxel labels: a box of 24 cells around random points, and a few single voxels: triangles",
     make_sheets<foam>, true, true},
};

std::string name_with_quads(const KindMaker& maker)
{
    return std::string(maker.name) + "-quads";
}

}  // namespace

std::span<const MeshKind> mesh_kinds()
{
    static const std::vector<MeshKind> kinds = [] {
        std::vector<MeshKind> list;
        for (const KindMaker& maker : kind_makers) {
            list.push_back({maker.name, maker.description, maker.has_cells});
            if (maker.has_quads)
                list.push_back({name_with_quads(maker), "the same, quads", maker.has_cells});
        }
        return list;
    }();
    return kinds;
}

LabelSurface make_surface(std::string_view kind, Index vertices, const MeshVariation& variation)
{
    for (const KindMaker& maker : kind_makers) {
        if (kind == maker.name)
            return maker.make(vertices, variation, PartFaces::Triangles);
        if (maker.has_quads && kind == name_with_quads(maker))
            return maker.make(vertices, variation, PartFaces::Quads);
    }
    std::string message = "no kind of mesh is called \"" + std::string(kind) + "\"; there are";
    for (const MeshKind& k : mesh_kinds())
        message.append(" ").append(k.name);
    throw OptionError(message);
}

PolygonMesh make_mesh(std::string_view kind, Index vertices, const MeshVariation& variation)
{
    return make_surface(kind, vertices, variation).mesh;
}

}  // namespace seamflow
