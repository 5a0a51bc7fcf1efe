#include <cmath>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "partition/formats/mesh_io.h"
#include "partition/metrics/vertex_distance.h"
#include "tests/samples/workshop.h"

using namespace seamflow;
using test::Workshop;

namespace {

/// What `pattern`, with one group, finds in a text: the numbers of all matches.
std::vector<double> numbers(const std::string& text, const std::string& pattern)
{
    std::vector<double> found;
    const std::regex regex(pattern);
    for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
        found.push_back(std::stod((*match)[1]));
    return found;
}

PolygonMesh mesh_in(const Workshop& w, const std::string& name)
{
    return read_mesh(w.directory / name).mesh;
}

}  // namespace

TEST_CASE("the ten lines do what smooth does")
{
    const Workshop w;
    REQUIRE(w.run(LIBRARY_CALL " mesh.obj out.obj") == 0);
    CHECK(w.said().starts_with("900 vertices in "));
    CHECK(numbers(w.said(), "sub-meshes, (\\S+) s a step").size() == 1);
    REQUIRE(w.smooth("mesh.obj expected.obj --time-step-edges 3 --steps 3") == 0);
    CHECK(vertex_distance(mesh_in(w, "out.obj"), mesh_in(w, "expected.obj").vertices, mesh_in(w, "out.obj").vertices)
              .max < 1e-12);
}

TEST_CASE("a mesh of OpenMesh is read, smoothed and written with normals")
{
    const Workshop w;
    REQUIRE(w.run(OPENMESH_PIPELINE " mesh.obj out.obj") == 0);
    CHECK(w.count_lines("said", "900 vertices smoothed, written with normals") == 1);
    CHECK(w.count_lines("out.obj", "vn ") == mesh_in(w, "mesh.obj").n_vertices());
    // OpenMesh counts each edge once in its mean, and passes coordinates through floats.
    const PolygonMesh before = mesh_in(w, "mesh.obj");
    CHECK(vertex_distance(before, before.vertices, mesh_in(w, "out.obj").vertices).max > 0.01);
}

TEST_CASE("slabs become sub-meshes, and the parts are written")
{
    const Workshop w;
    REQUIRE(w.run(OWN_CUT " mesh.obj parts.ply 3") == 0);
    CHECK(w.said().starts_with("3 sub-meshes, "));
    CHECK(numbers(w.said(), "(\\d+) vertices between").front() >= 2 * 15);
    CHECK(w.count_lines("parts.ply", "property int label") == 1);
}

TEST_CASE("a sweep with labels and a condition on Γ of one's own is near the undecomposed flow")
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj exact.obj --laplacian fujiwara --time-step-edges 1 --steps 3 --subdomains 1") == 0);
    const PolygonMesh mesh = mesh_in(w, "mesh.obj");
    std::ofstream(w.directory / "labels") << [&] {
        std::string labels;
        for (Index f = 0; f < mesh.n_faces(); ++f)
            labels += 2 * f < mesh.n_faces() ? "0\n" : "1\n";
        return labels;
    }();
    REQUIRE(w.run(OWN_CONDITION " mesh.obj labels out.obj") == 0);
    const PolygonMesh exact = mesh_in(w, "exact.obj");
    const double edge = mean_edge_length(mesh);
    const double moved = vertex_distance(mesh, mesh.vertices, exact.vertices).max;
    const double missed = vertex_distance(mesh, mesh_in(w, "out.obj").vertices, exact.vertices).max;
    CHECK(missed > 1e-6 * edge);
    CHECK(missed < moved);
    CHECK(w.run(OWN_CONDITION " mesh.obj missing out.obj") == 1);
    CHECK(w.said().find("missing: cannot open") != std::string::npos);
}

TEST_CASE("every step is looked at, and every second state written")
{
    const Workshop w;
    REQUIRE(w.run("mkdir states && " OBSERVE_STEPS " mesh.obj states 5 2") == 0);
    const auto area = numbers(w.said(), "area ([^,\\s]+)");
    REQUIRE(area.size() == 6);
    for (std::size_t i = 1; i < area.size(); ++i)
        CHECK(area[i] < area[i - 1]);
    for (const int step : {1, 2, 3, 4, 5})
        CHECK(w.has("states/" + std::to_string(step) + ".obj") == (step % 2 == 0));
}

TEST_CASE("converged steps are the undecomposed ones, sweeps nearly so")
{
    const Workshop w;
    REQUIRE(w.run(CONVERGED_STEP " mesh.obj 4") == 0);
    const auto v_max = numbers(w.said(), "V_max (\\S+)");
    REQUIRE(v_max.size() == 2);
    CHECK(v_max[0] < 2.0);
    CHECK(v_max[0] > 1e-4);
    CHECK(v_max[1] < 1e-6);
    CHECK(w.count_lines("said", "sweeps: 4 sub-meshes") == 1);
}

TEST_CASE("steps are taken until the mean curvature has halved")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere ball.obj --vertices 2000") == 0);
    REQUIRE(w.run(STEP_BY_STEP " ball.obj out.obj") == 0);
    const auto curvature = numbers(w.said(), "up to (\\S+)");
    REQUIRE(curvature.size() >= 2);
    REQUIRE(curvature.size() < 100);
    REQUIRE(w.smooth("ball.obj first.obj --flow linear --time-step-edges 0.1 --steps 1 --report r.json") == 0);
    const double begun = w.json("r.json")["steps"][0]["max_mean_curvature_before"].get<double>();
    CHECK(2.0 * curvature.back() <= begun);
    CHECK(2.0 * curvature[curvature.size() - 2] > begun);
    CHECK(vertex_distance(mesh_in(w, "ball.obj"), mesh_in(w, "ball.obj").vertices, mesh_in(w, "out.obj").vertices).max >
          0.0);
}

TEST_CASE("a low-pass filter moves a mesh less than diffusion, and so does an attachment")
{
    const Workshop w;
    REQUIRE(w.run(FURTHER_FLOWS " mesh.obj") == 0);
    const auto moved = numbers(w.said(), "moved by (\\S+)");
    REQUIRE(moved.size() == 6);
    CHECK(moved[1] < 0.9 * moved[0]);
    CHECK(moved[2] < 0.9 * moved[0]);
    CHECK(moved[3] > 0.5 * moved[0]);
}

TEST_CASE("where edges are kept, a box stays a box, and without noise nothing is removed")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " box box.obj --vertices 2000 --noise 0") == 0);
    REQUIRE(w.run(FURTHER_FLOWS " box.obj") == 0);
    const auto moved = numbers(w.said(), "moved by (\\S+)");
    REQUIRE(moved.size() == 6);
    // Along its faces vertices move a little.
    CHECK(moved[4] < 0.1 * moved[0]);
    CHECK(moved[5] == 0.0);
}

TEST_CASE("wrong usage and files that are not there are said in words")
{
    const Workshop w;
    for (const std::string program :
         {LIBRARY_CALL, OPENMESH_PIPELINE, OWN_CUT, OBSERVE_STEPS, CONVERGED_STEP, STEP_BY_STEP, FURTHER_FLOWS}) {
        CHECK(w.run(program) == 2);
        CHECK(w.said().starts_with("usage: "));
    }
    CHECK(w.run(LIBRARY_CALL " nowhere.obj out.obj") == 1);
    CHECK(w.said().starts_with("library_call: "));
    CHECK(w.run(OPENMESH_PIPELINE " nowhere.obj out.obj 2>&1 | tail -1 | grep -q 'OpenMesh cannot read'") == 0);
}
