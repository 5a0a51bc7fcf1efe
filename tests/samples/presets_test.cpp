#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "tests/samples/workshop.h"
#include "tests/support/relative.h"

using seamflow::test::Workshop;

namespace {

/// The options that a run said it had chosen.
std::string chosen(const Workshop& w)
{
    const std::string said = w.said();
    const std::size_t line = said.find("preset     ");
    REQUIRE(line != std::string::npos);
    const std::size_t begin = said.find(": ", line) + 2;
    return said.substr(begin, said.find('\n', begin) - begin);
}

}  // namespace

TEST_CASE("what a preset chooses is said as options that give the same bytes")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere sphere.obj --vertices 3000") == 0);
    REQUIRE(w.run(GENERATE " box box.obj --vertices 3000 --noise 0.2") == 0);
    for (const std::string name : {"scan", "cad", "terrain", "fair"}) {
        CAPTURE(name);
        const std::string mesh = name == "cad" ? "box.obj" : "sphere.obj";
        REQUIRE(w.smooth(mesh + " by_preset.obj --report report.json --preset " + name) == 0);
        CHECK(w.json("report.json")["preset"] == name);
        CHECK(w.json("report.json").contains("noise") == (name != "fair"));
        REQUIRE(w.smooth(mesh + " by_options.obj " + chosen(w)) == 0);
        CHECK(w.run("cmp by_preset.obj by_options.obj") == 0);
    }
}

TEST_CASE("without an amount a mesh loses its noise, and hardly anything else")
{
    const Workshop w;
    for (const char* noise : {"0.1", "0.3"}) {
        const std::string shape = " --vertices 20000 --amplitude 0.05 --noise ";
        REQUIRE(w.run(GENERATE " noisy-sphere noisy.obj" + shape + noise) == 0);
        REQUIRE(w.run(GENERATE " noisy-sphere true.obj" + shape + "0") == 0);
        REQUIRE(w.smooth("noisy.obj out.obj") == 0);
        CHECK(w.said().find("preset     automatic: --boundary free") != std::string::npos);
        CHECK(w.said().find("chosen     noise of 0.") != std::string::npos);
        const auto distance = [&](const char* mesh) {
            REQUIRE(w.run(std::string(COMPARE " true.obj ") + mesh + " --report distance.json") == 0);
            return w.json("distance.json")["h_rms"].get<double>();
        };
        CHECK(distance("out.obj") < 0.4 * distance("noisy.obj"));
    }
}

TEST_CASE("the noise in a report is in mean edge lengths, be it measured or said, on a mesh of any size")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere one.obj --vertices 5000 --noise 0.3") == 0);
    // Four times as large.
    REQUIRE(w.run("(awk '/^v /{print \"v\", 4*$2, 4*$3, 4*$4; next}{print}' one.obj >four.obj)") == 0);
    std::vector<double> noise;
    for (const std::string mesh : {"one", "four"}) {
        REQUIRE(w.smooth(mesh + ".obj out.obj --report r.json") == 0);
        noise.push_back(w.json("r.json")["noise"].get<double>());
        CHECK(noise.back() > 0.05);
        CHECK(noise.back() < 0.5);
        REQUIRE(w.smooth(mesh + ".obj out.obj --report r.json --noise 0.005") == 0);
        CHECK(w.json("r.json")["noise"].get<double>() * w.json("r.json")["mean_edge"].get<double>() ==
              test::relative(0.005, 1e-12));
    }
    CHECK(noise[1] == test::relative(noise[0], 5e-3));
}

TEST_CASE("clean parts come back as they were, and what folds or crosses is counted")
{
    const Workshop w;
    (void)w.directory.with("plate.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 9 9 0\nv 0 0 1\nv 9 0 1\nv 0 9 1\nv 9 9 1\n"
                                        "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
    (void)w.directory.with("pyramid.obj", "v 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nv 0 0 1\n"
                                          "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 1 3 2\nf 1 4 3\n");
    for (const std::string mesh : {"plate.obj", "pyramid.obj"})
        for (const std::string options :
             {"", "--preset scan", "--preset cad", "--preset terrain", "--keep-edges 30 --time-step-edges 1e-12",
              "--keep-edges 30 --steps 3", "--keep-edges 30 --time-step-edges 1000"}) {
            CAPTURE(options);
            REQUIRE(w.smooth(mesh + " out.obj --report report.json " + options) == 0);
            const auto surface = w.json("report.json")["surface"];
            CHECK(surface["moved_max_absolute"].get<double>() <= 1e-12);
            CHECK(surface["flipped_faces"] == 0);
            CHECK(surface["new_self_intersections"] == 0);
        }
    // A sheet that is drawn through the other: the comparison tells both.
    (void)w.directory.with("apart.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 1\nv 1 2 1\nv 2 1 1\nf 1 2 3\nf 4 5 6\n");
    (void)w.directory.with("through.obj", "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 1\nv 2 1 -1\nv 1 2 1\nf 1 2 3\nf 4 5 6\n");
    REQUIRE(w.run(COMPARE " apart.obj through.obj --report compared.json") == 0);
    CHECK(w.said().find("flipped     1 face by") != std::string::npos);
    CHECK(w.said().find("crossing    0 pairs of faces in the reference, 1 in the candidate") != std::string::npos);
    CHECK(w.json("compared.json")["flipped_faces"] == 1);
    CHECK(w.json("compared.json")["self_intersections"] == 0);
    CHECK(w.json("compared.json")["candidate_self_intersections"] == 1);
    REQUIRE(w.run(INSPECT " through.obj") == 0);
    CHECK(w.said().find("pairs of faces that cross each other (1): 0-1") != std::string::npos);
    REQUIRE(w.run(INSPECT " through.obj --json") == 0);
    CHECK(seamflow::test::Json::parse(w.said())["self_intersections"] == seamflow::test::Json{{0, 1}});
}

TEST_CASE("options that are given go before those of a preset")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere sphere.obj --vertices 3000") == 0);
    REQUIRE(w.smooth("sphere.obj out.obj --laplacian fujiwara --steps 2") == 0);
    CHECK(chosen(w).starts_with("--order 3 --time-step-edges"));
    REQUIRE(w.smooth("mesh.obj out.obj --preset fair --time-step-edges 2") == 0);
    CHECK(chosen(w) == "--laplacian virtual-refinement --flow conformalized --steps 5 ");
    REQUIRE(w.smooth("mesh.obj out.obj --keep-edges 50") == 0);
    CHECK(chosen(w) == "--boundary free ");
    REQUIRE(w.smooth("mesh.obj out.obj --laplacian ptackova-velho") == 0);
    CHECK(chosen(w).find("--filter") == std::string::npos);
    REQUIRE(w.smooth("mesh.obj out.obj --time-step 1e-3") == 0);
    CHECK(w.said().find("preset ") == std::string::npos);
}

TEST_CASE("a remark says what a preset has no place for beside a Laplacian without symmetry")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere sphere.obj --vertices 3000") == 0);
    REQUIRE(w.smooth("sphere.obj out.obj --preset terrain --laplacian ptackova-velho") == 0);
    CHECK(
        w.said().find(
            "--preset terrain leaves out --order 3, --attach 5%, which --laplacian ptackova-velho does not support") !=
        std::string::npos);
    REQUIRE(w.smooth("sphere.obj out.obj --preset terrain --laplacian fujiwara") == 0);
    CHECK(w.said().find("leaves out") == std::string::npos);
}

TEST_CASE("reports name the flow that was taken")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere sphere.obj --vertices 1000") == 0);
    REQUIRE(w.smooth("sphere.obj out.obj --verbose --keep-edges 25 --time-step-edges 8 --report report.json") == 0);
    CHECK(w.said().find("flow       edges sharper than 25 degrees kept, time step") != std::string::npos);
    CHECK(w.json("report.json")["keep_edges"] == 25.0);
    CHECK(!w.json("report.json").contains("approach"));
    CHECK(w.json("report.json")["rescale"] == "none");
    REQUIRE(w.smooth("sphere.obj out.obj --flow conformalized --filter low-pass --laplacian virtual-refinement "
                     "--attach 0.5 --rescale volume --time-step-edges 8 --verbose --report report.json") == 0);
    CHECK(w.said().find(
              "virtual-refinement, conformalized, low-pass of order 2, attached with 4 / length², volume kept, time") !=
          std::string::npos);
    CHECK(w.json("report.json")["rescale"] == "volume");
    CHECK(w.json("report.json")["attachment"] == 4.0);
    CHECK(!w.json("report.json").contains("keep_edges"));
}

namespace {

/// A roof of n by n quads over the unit square, its ridge at x = .5, noise on everything else.
struct Roof {
    static constexpr int n = 20;
    std::string obj;
    /// The edges of the ridge: pairs of vertices, and as polylines of OBJ.
    std::string pairs;
    std::string polylines;

    Roof()
    {
        unsigned random = 1;
        for (int y = 0; y <= n; ++y)
            for (int x = 0; x <= n; ++x) {
                random = random * 1664525U + 1013904223U;
                const double noise = x == n / 2 ? 0.0 : 0.006 * (random / 2147483648.0 - 1.0);
                obj += "v " + std::to_string(1.0 * x / n) + " " + std::to_string(1.0 * y / n) + " " +
                       std::to_string(0.09 * std::min(x, n - x) / n + noise) + "\n";
            }
        for (int y = 0; y < n; ++y) {
            const int ridge = y * (n + 1) + n / 2;
            pairs += std::to_string(ridge) + " " + std::to_string(ridge + n + 1) + "\n";
            polylines += "l " + std::to_string(ridge + 1) + " " + std::to_string(ridge + n + 2) + "\n";
            for (int x = 0; x < n; ++x) {
                const int v = y * (n + 1) + x + 1;
                obj += "f " + std::to_string(v) + " " + std::to_string(v + 1) + " " + std::to_string(v + n + 2) + " " +
                       std::to_string(v + n + 1) + "\n";
            }
        }
    }
};

/// How far the vertices of the ridge in an OBJ file are off it.
double off_ridge(const Workshop& w, const char* mesh)
{
    std::ifstream file(w.directory / mesh);
    std::string keyword;
    double largest = 0.0;
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    for (int v = 0; file >> keyword >> x >> y >> z && keyword == "v"; ++v)
        if (v % (Roof::n + 1) == Roof::n / 2)
            largest = std::max({largest, std::abs(x - 0.5), std::abs(z - 0.045)});
    return largest;
}

}  // namespace

TEST_CASE(
    "where edges are kept without an amount, clean round parts stay byte for byte; an amount says how far things went")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere ball.obj --vertices 2000 --noise 0 --amplitude 0") == 0);
    for (const std::string options : {"--keep-edges 30", "--keep-edges 20 --steps 3", "--preset cad"}) {
        CAPTURE(options);
        REQUIRE(w.smooth("ball.obj out.obj " + options) == 0);
        CHECK(w.said().find("No noise was found: nothing is smoothed") != std::string::npos);
        CHECK(w.run("cmp ball.obj out.obj") == 0);
    }
    REQUIRE(w.smooth("ball.obj out.obj --keep-edges 30 --time-step-edges 32") == 0);
    CHECK(w.said().find("whether there is noise or not: vertices moved by up to 0.") != std::string::npos);
    (void)w.directory.with("cube.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                       "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    REQUIRE(w.smooth("cube.obj out.obj --keep-edges 30 --time-step-edges 32") == 0);
    CHECK(w.said().find("Nothing was smoothed: most faces lie in planes") != std::string::npos);
}

TEST_CASE("edges that are given stay as they are, from whichever file, and vertices on them move along them alone")
{
    const Workshop w;
    const Roof roof;
    (void)w.directory.with("roof.obj", roof.obj + roof.polylines);
    (void)w.directory.with("pairs", roof.pairs);
    REQUIRE(w.smooth("roof.obj kept.obj --edges pairs") == 0);
    CHECK(w.said().find("preset     cad") != std::string::npos);
    REQUIRE(w.smooth("roof.obj by_file.obj --preset cad --edges-from-file") == 0);
    CHECK(w.run("cmp kept.obj by_file.obj") == 0);
    REQUIRE(w.smooth("roof.obj lost.obj --preset cad") == 0);
    CHECK(off_ridge(w, "kept.obj") < 1e-12);
    CHECK(off_ridge(w, "lost.obj") > 1e-3);
    REQUIRE(w.smooth("roof.obj along.obj --edges pairs --keep-edges 30 --time-step-edges 32") == 0);
    CHECK(off_ridge(w, "along.obj") < 1e-12);
    CHECK(w.smooth("roof.obj out.obj --radius 1% --edges pairs") == 2);
    CHECK(w.said().find("--edges names edges to keep: give --preset cad, or --keep-edges") != std::string::npos);
    CHECK(w.smooth("roof.obj out.obj --edges pairs --edges-from-file") == 2);
    CHECK(w.smooth("- out.obj --edges-from-file <roof.obj") == 2);
    (void)w.directory.with("bare.obj", roof.obj);
    CHECK(w.smooth("bare.obj out.obj --preset cad --edges-from-file") == 3);
    (void)w.directory.with("wrong", "0 99\n");
    CHECK(w.smooth("roof.obj out.obj --edges wrong") == 3);
    CHECK(w.said().find("vertices 0 and 99 (numbered from 0) of a feature edge share no edge") != std::string::npos);
}
