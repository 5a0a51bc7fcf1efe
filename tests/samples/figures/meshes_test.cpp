#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "partition/formats/mesh_io.h"
#include "partition/metrics/roughness.h"
#include "partition/topology.h"
#include "samples/figures/experiments.h"
#include "samples/figures/surfaces.h"
#include "samples/meshes/meshes.h"
#include "tests/samples/figures/made_up.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using namespace seamflow::test;

TEST_CASE("meshes are the authors' own where there are any, and cut as they did")
{
    const test::TemporaryDirectory folder;
    Experiment experiment = small("triangles");
    const PolygonMesh mesh = make_quads(121);
    write_mesh(folder / "ddm__tri_Shrek_3721.obj", mesh, {});
    const FigureMesh other = load(experiment.source, folder.path());
    CHECK(other.name == "ddm__tri_Shrek_3721.obj");
    CHECK(other.labels == halves_by_number(mesh, 50));
    CHECK_FALSE(other.is_theirs);
    CHECK_FALSE(other.authors);
    experiment.source.vertices = 121;
    experiment.source.authors->first_part = 30;
    const FigureMesh theirs = load(experiment.source, folder.path());
    CHECK(theirs.is_theirs);
    CHECK(theirs.authors);
    CHECK(theirs.labels == halves_by_number(mesh, 30));
    CHECK(theirs.cut == "first 30 faces (the authors')");
    CHECK(load(small("hexagons").source, folder.path()).name == "generated");
}

TEST_CASE("every file of the authors that is cut has their cut, and with Robin conditions their p")
{
    for (const Experiment& experiment : experiments()) {
        CAPTURE(experiment.name);
        const bool is_cut = experiment.variants.back().cut == CutKind::Halves;
        CHECK(experiment.source.authors.has_value() == is_cut);
        if (is_cut)
            CHECK(experiment.source.authors->p.has_value() == (experiment.name != "schwarz"));
    }
}

TEST_CASE("the authors' parameters are for their own mesh")
{
    const Experiment teaser = small("teaser");
    FigureMesh mesh = load(teaser.source, {});
    const Variant halves = teaser.variants.back();
    CHECK_FALSE(options_of(teaser, halves, mesh).interface.p);
    CHECK(options_of(teaser, halves, mesh).interface.correction == FlowOptions::plain().interface.correction);
    mesh.authors = teaser.source.authors;
    const FlowOptions options = options_of(teaser, halves, mesh);
    CHECK(options.interface.p == 6.2993055940947205);
    CHECK(options.interface.colouring == Colouring::Label);
    CHECK(options.interface.correction == Correction::None);
    CHECK(options.interface.sweep == Sweep::Fixed);
    CHECK(
        command_of(teaser, halves, mesh) ==
        "smooth teaser-input.ply out.ply --laplacian ptackova-velho --time-step 0.05 --steps 5 --labels teaser-cut.txt "
        "--plain --p 6.2993055940947205 --coloring label --no-correction");
    // Only there is Γ not corrected.
    const Experiment hexagons = small("hexagons");
    mesh.authors = hexagons.source.authors;
    const FlowOptions others = options_of(hexagons, hexagons.variants.back(), mesh);
    CHECK(others.interface.p == 54.2606704480561);
    CHECK(others.interface.colouring == Colouring::Greedy);
    CHECK(others.interface.correction == FlowOptions::plain().interface.correction);
}

TEST_CASE("generated meshes are cut by rows")
{
    const PolygonMesh cylinder = bulging_two_level_cylinder(1000);
    const std::vector<Index> labels = halves_by_rows(cylinder, 2);
    // The coarse quads and the pentagons come first, the fine quads after them.
    CHECK(std::is_sorted(labels.begin(), labels.end()));
    const auto coarse = std::count(labels.begin(), labels.end(), 0);
    CHECK(cylinder.face(static_cast<Index>(coarse) - 1).size() == 5);
    CHECK(cylinder.face(static_cast<Index>(coarse)).size() == 4);
}

TEST_CASE("every stand-in has about the size of the paper's mesh")
{
    for (const Experiment& experiment : experiments()) {
        const PolygonMesh mesh = experiment.source.generate(experiment.source.vertices);
        CHECK_NOTHROW(require_valid(mesh));
        CHECK(std::abs(mesh.n_vertices() - experiment.source.vertices) < 0.05 * experiment.source.vertices);
    }
}

TEST_CASE("stand-ins are smooth but for the tube that is noisy on purpose")
{
    for (const Experiment& experiment : experiments()) {
        CAPTURE(experiment.name);
        const PolygonMesh mesh = experiment.source.generate(experiment.source.vertices);
        const double rms = roughness(mesh, mesh.vertices).rms;
        CHECK((rms > 10.0) == (experiment.name == "teaser"));
    }
}

TEST_CASE("three edges meet at the vertices of generated polygons")
{
    const PolygonMesh mesh = polygons_with_bumps(2000);
    const Topology topology = make_topology(mesh);
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        CHECK(topology.kind[v] != VertexKind::NonManifold);
        if (topology.kind[v] == VertexKind::Interior)
            CHECK(topology.corners_at(v).size() == 3);
    }
}
