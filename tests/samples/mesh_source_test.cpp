#include <doctest/doctest.h>

#include "partition/io/mesh_io.h"
#include "samples/common/meshes.h"
#include "samples/figures/mesh_source.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

TEST_CASE("a file is the authors' own where it has as many faces as theirs")
{
    const test::TemporaryDirectory folder;
    const PolygonMesh mesh = make_quads(121);
    REQUIRE(mesh.n_faces() == 100);
    write_mesh(folder / "a.obj", mesh, {});
    for (const Index faces : {100, 99, 101}) {
        const FigureSource source{.file = "a.obj",
                                  .authors = AuthorsRun{.faces = faces, .first_part = 30, .p = {}},
                                  .generate = [](Index vertices) { return make_quads(vertices); },
                                  .vertices = 121};
        const FigureMesh loaded = load(source, folder.path());
        CHECK(loaded.authors.has_value() == (faces == 100));
        CHECK(loaded.labels == halves_by_number(mesh, faces == 100 ? 30 : 50));
    }
}
