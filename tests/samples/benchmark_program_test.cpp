#include <string>
#include <vector>

#include "tests/samples/workshop.h"
#include "tests/support/relative.h"

using namespace seamflow;
using test::Json;
using test::Workshop;

namespace {

/// The first row of a method.
Json row_of(const Json& rows, const std::string& method)
{
    for (const Json& row : rows)
        if (row["method"] == method)
            return row;
    FAIL("no row of ", method);
    return {};
}

}  // namespace

TEST_CASE("benchmark holds peers beside ours, each in a process of its own")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " triangles grid.obj --vertices 2000") == 0);
    const std::string command = BENCHMARK " --mesh grid.obj --subdomains 4 --steps 3 --threads 2 --json rows.json "
                                          "--peers cholmod,cg ";
    REQUIRE(w.run(command + "--converge never") == 0);
    const Json rows = w.json("rows.json");
    REQUIRE(rows.size() == 3);
    for (const Json& row : rows) {
        CAPTURE(row.dump());
        CHECK(row["mesh"] == "grid.obj");
        CHECK(row["steps"] == 3);
        CHECK(row["dt_over_h2"] == 5.0);
        CHECK(row["threads"] == 2);
        CHECK(row["setup_s"].get<double>() > 0.0);
        CHECK(row["step_s"].get<double>() > 0.0);
        CHECK(row["peak_memory_mb"].get<double>() > 1.0);
        CHECK(row["ratio"].get<double>() ==
              test::relative(row["all_s"].get<double>() / rows[0]["all_s"].get<double>(), 1e-5));
    }
    CHECK(rows[0]["method"] == "ours");
    CHECK(rows[0]["approach"] == "sweep");
    CHECK(rows[0]["v_max"].get<double>() > 1e-6);
    CHECK(row_of(rows, "cholmod")["v_max"] == 0.0);
    const Json cg = row_of(rows, "cg");
    for (const char* key : {"v_mean", "v_max"})
        CHECK(cg[key].get<double>() <= rows[0][key].get<double>());
    CHECK(cg["iterations"] > 0);
    CHECK(w.count_lines("said", "grid.obj ") == 3);
    REQUIRE(w.run(command + "--converge 1e-8") == 0);
    CHECK(row_of(w.json("rows.json"), "cg")["tolerance"] == 1e-8);
    REQUIRE(w.run(command + "--peers none") == 2);
    REQUIRE(w.run(BENCHMARK " --vertices 2000 --steps 1 --peers none --json rows.json") == 0);
    REQUIRE(w.json("rows.json").size() == 1);
    CHECK_FALSE(w.json("rows.json")[0].contains("v_max"));
}

TEST_CASE("benchmark takes a limit of memory")
{
    const Workshop w;
    const std::string ours = BENCHMARK " --mesh mesh.obj --steps 1 --subdomains 12 --peers cholmod --converge never "
                                       "--json rows.json ";
    REQUIRE(w.run(ours) == 0);
    const Json free = w.json("rows.json");
    REQUIRE(w.run(ours + "--memory-limit 1GiB") == 0);
    CHECK(w.json("rows.json")[0]["v_max"] == free[0]["v_max"]);
    CHECK(w.run(ours + "--memory-limit 1K") == 4);
    CHECK(w.said().find("memory_limit is 1000 bytes") != std::string::npos);
}

TEST_CASE("benchmark finds out for a grid of cells who is the fastest at equal accuracy")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK
                  " --grid mesh.obj --kind triangles --vertices 10000 --time-step-edges 5 --steps 2 --turns 2 "
                  "--peers cholmod,cg --json grid.json") == 0);
    const Json rows = w.json("grid.json");
    REQUIRE(rows.size() == 6);
    for (const std::string mesh : {"triangles", "mesh.obj"}) {
        CAPTURE(mesh);
        Json cell = Json::array();
        for (const Json& row : rows)
            if (row["mesh"] == mesh)
                cell.push_back(row);
        REQUIRE(cell.size() == 3);
        const Json ours = row_of(cell, "ours");
        CHECK(ours["turns_s"].size() == 2);
        double ratio = 1e300;
        for (const char* peer : {"cholmod", "cg"}) {
            const Json row = row_of(cell, peer);
            CHECK(row["dt_over_h2"] == 5.0);
            if (!row.contains("ratio"))
                continue;
            CHECK(row["v_max"].get<double>() <= std::max(ours["v_max"].get<double>(), 1e-3));
            CHECK(row["v_mean"].get<double>() <= std::max(ours["v_mean"].get<double>(), 1e-4));
            ratio = std::min(ratio, row["ratio"].get<double>());
        }
        CHECK(ratio < 1e300);
        CHECK(w.count_lines("said", "  " + mesh + ", ") == (ratio < 1.0 ? 1 : 0));
    }
    CHECK(w.count_lines("said", "| mesh | vertices | dt 5 |") == 1);
}

TEST_CASE("benchmark goes on where ours fails in a cell of its grid")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK " --grid --kind quads --vertices 10000 --steps 1 --turns 1 --converge 1e-8 "
                            "--subdomains 4 --memory-limit 1K --peers none --json grid.json") == 0);
    CHECK(w.json("grid.json")[3].contains("error"));
    CHECK(w.count_lines("said", "| quads | 10000 | failed | failed | failed | failed |") == 1);
}

TEST_CASE("benchmark explains by which costs ours chooses its approach")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK " --explain --vertices 3000 --steps 2 --json explained.json") == 0);
    const Json rows = w.json("explained.json");
    REQUIRE(rows.size() == 4);
    std::string cheapest;
    std::string chosen;
    double least = 1e300;
    for (const Json& row : rows) {
        CAPTURE(row.dump());
        const auto number = [&](const char* key) { return row.at(key).get<double>(); };
        CHECK(number("v_max") < 1.0);
        CHECK(number("coefficients") == test::relative(6.0, 1e-5));
        CHECK(number("predicted_all_s") ==
              test::relative(number("predicted_setup_s") + 2.0 * number("predicted_step_s"), 1e-5));
        if (number("predicted_all_s") < least) {
            least = number("predicted_all_s");
            cheapest = row["approach"];
        }
        if (row["chosen"] == true)
            chosen = row["approach"];
    }
    CHECK(chosen == cheapest);
    CHECK(w.said().find(" * ") != std::string::npos);
}

TEST_CASE("benchmark runs smooth from file to file beside peers of equal accuracy")
{
    const Workshop w;
    REQUIRE(w.run("mkdir scratch; TMPDIR=scratch " BENCHMARK " --whole-run --vertices 10000 --subdomains 4 --steps 2 "
                  "--turns 2 --json whole.json") == 0);
    CHECK(std::filesystem::is_empty(w.directory / "scratch"));
    const Json rows = w.json("whole.json");
    REQUIRE(rows.size() == 8);
    REQUIRE(w.run(BENCHMARK " --vertices 10000 --subdomains 4 --steps 2 --peers cholmod --json rows.json") == 0);
    const double v_max = w.json("rows.json")[0]["v_max"].get<double>();
    for (const std::string format : {"obj", "ply"}) {
        CAPTURE(format);
        Json of_format = Json::array();
        for (const Json& row : rows)
            if (row["format"] == format)
                of_format.push_back(row);
        const Json smooth = row_of(of_format, "smooth");
        CHECK(smooth["v_max"].get<double>() == test::relative(v_max, 1e-6));
        for (const char* phase : {"read", "cut", "analyse", "steps_s", "write"})
            CHECK_MESSAGE(smooth[phase].get<double>() > 0.0, phase);
        CHECK(smooth["rest"].get<double>() >= 0.0);  // a difference of two runs
        for (const char* method : {"smooth", "cholmod", "cg", "step of cholmod"}) {
            CAPTURE(method);
            const Json row = row_of(of_format, method);
            CHECK(row["turns_s"].size() == 2);
            CHECK(row["ratio"].get<double>() ==
                  test::relative(row["all_s"].get<double>() / smooth["all_s"].get<double>(), 1e-5));
        }
    }
    CHECK(row_of(rows, "smooth")["format"] == "obj");
}

TEST_CASE("benchmark runs smooth on a given file")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK " --whole-run --mesh mesh.obj --steps 1 --turns 1 --peers none --json whole.json") == 0);
    const Json rows = w.json("whole.json");
    REQUIRE(rows.size() == 1);
    CHECK(rows[0]["file_mb"].get<double>() ==
          test::relative(1e-6 * static_cast<double>(std::filesystem::file_size(w.directory / "mesh.obj")), 1e-9));
    CHECK_FALSE(rows[0].contains("v_max"));
}

TEST_CASE("benchmark solves k-harmonic steps, as exactly as direct solvers of the whole mesh")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK " --vertices 5000 --k-harmonic 1,2,3 --json k.json") == 0);
    const Json list = w.json("k.json");
    REQUIRE(list.size() == 15);
    for (const Json& row : list) {
        CAPTURE(row.dump());
        const std::string method = row["method"];
        const double error = row.value("backward_error", 1.0);
        CHECK(error < (method.starts_with("cg") ? 1e-8 : method == "ours 1e-08" ? 1e-7 : 1e-12));
        CHECK(row.value("solve_s", 0.0) > 0.0);
    }
    REQUIRE(w.run(BENCHMARK " --kind hexagons --vertices 2000 --k-harmonic 2 --laplacian virtual-refinement "
                            "--json k.json") == 0);
    CHECK(w.json("k.json").size() == 5);
    for (const Json& row : w.json("k.json"))
        CHECK(row["backward_error"].get<double>() < 1e-7);
}

TEST_CASE("benchmark that is stopped leaves nothing behind")
{
    const Workshop w;
    // The shell waits until the mesh is there before it stops the program.
    CHECK(w.run("{ mkdir scratch; TMPDIR=scratch " BENCHMARK " --vertices 300000 --steps 1000 --peers none & "
                "for i in $(seq 1000); do ls scratch/*/input.ply && break; sleep 0.1; done; kill $!; wait $!; "
                "test $? -eq 143; }") == 0);
    CHECK(w.count_lines("said", "scratch/benchmark-") == 1);
    CHECK(std::filesystem::is_empty(w.directory / "scratch"));
}

TEST_CASE("benchmark refuses wrong usage and unusable files")
{
    const Workshop w;
    for (const char* arguments : {"--vertices 10",
                                  "--vertices 1e5",
                                  "--kind dodecahedra",
                                  "--laplacian cotan",
                                  "--time-step-edges 0",
                                  "--steps 0",
                                  "--subdomains -1",
                                  "--threads 1025",
                                  "--laplacian ptackova-velho",
                                  "--peers everybody",
                                  "--mesh mesh.obj --vertices 1000",
                                  "--mesh mesh.obj --kind quads",
                                  "--k-harmonic 4",
                                  "--k-harmonic 0",
                                  "--k-harmonic 1,",
                                  "--k-harmonic 1 --laplacian fujiwara",
                                  "--k-harmonic 1 --peers cg",
                                  "--k-harmonic 1 --steps 2",
                                  "--grid --mesh mesh.obj",
                                  "--grid --vertices 1000",
                                  "--grid --turns 0",
                                  "--turns 2",
                                  "--explain --grid",
                                  "--explain --peers cg",
                                  "--whole-run --grid",
                                  "--whole-run --memory-limit 1G",
                                  "--memory-limit 0",
                                  "mesh.obj"}) {
        CAPTURE(arguments);
        CHECK(w.run(std::string(BENCHMARK " --json case.json ") + arguments) == 2);
        CHECK_FALSE(w.said().empty());
    }
    CHECK_FALSE(w.has("case.json"));
    CHECK(w.run(BENCHMARK " --mesh nothing.obj") == 3);
    (void)w.directory.with("sliver.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 -1 0\nv 0 0 0\n"
                                         "f 1 2 5\nf 5 2 3\nf 1 5 3\nf 3 4 1\n");
    CHECK(w.run(BENCHMARK " --mesh sliver.obj --peers none") == 3);
    CHECK(w.said().find("sliver.obj") != std::string::npos);
    CHECK(w.run(BENCHMARK " --json nowhere/case.json") == 5);
}
