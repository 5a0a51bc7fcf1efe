#include <string>
#include <vector>

#include "tests/samples/workshop.h"
#include "tests/support/relative.h"
#include "tests/support/sanitizers.h"

using namespace seamflow;
using test::Json;
using test::Workshop;

TEST_CASE("benchmark holds every peer beside ours, each in a process of its own")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " triangles grid.obj --vertices 2000") == 0);
    REQUIRE(w.run(BENCHMARK " --mesh grid.obj --subdomains 4 --steps 3 --threads 2 --json case.json --export exported "
                            "--peers cholmod,umfpack,cg,cg-ic,cgal") == 0);
    const Json json = w.json("case.json");
    for (const char* key : {"vertices", "dt_over_h2", "laplacian", "threads", "ours", "peers", "ratios", "reference"})
        CHECK_MESSAGE(json.contains(key), key);
    for (const char* key : {"subdomains", "setup_s", "step_s", "phases", "peak_memory_bytes", "v_mean", "v_max"})
        CHECK_MESSAGE(json["ours"].contains(key), key);
    CHECK(json["reference"] == "cholmod");
    CHECK(json["ours"]["subdomains"] == 4);
    CHECK(json["ours"]["v_max"].get<double>() > 1e-6);
    for (const char* name : {"cholmod", "umfpack", "cg-1e-8", "cg-1e-4", "cg-equal-accuracy", "cg-ic-1e-8",
                             "cg-ic-1e-4", "cg-ic-equal-accuracy", "cgal"}) {
        CAPTURE(name);
        REQUIRE(json["peers"].contains(name));
        const Json peer = json["peers"][name];
        CHECK(peer["setup_s"].get<double>() > 0.0);
        CHECK(peer["step_s"].get<double>() > 0.0);
        CHECK(peer["peak_memory_bytes"].get<double>() > 1e6);
        CHECK(json["ratios"][name].get<double>() ==
              test::relative(peer["step_s"].get<double>() / json["ours"]["step_s"].get<double>(), 1e-5));
    }
    CHECK(json["peers"]["umfpack"]["v_max"].get<double>() < 1e-9);
    CHECK(json["peers"]["cg-equal-accuracy"]["v_max"] <= json["ours"]["v_max"]);
    for (const char* key : {"v_mean", "v_max"})
        CHECK(json["peers"]["cg-equal-both"][key] <= json["ours"][key]);
    CHECK(json["peers"]["cg-equal-both"]["tolerance"] <= json["peers"]["cg-equal-accuracy"]["tolerance"]);
    CHECK(json["peers"]["cg-equal-both"]["iterations"] > 0);
    CHECK_FALSE(json["peers"]["cgal"].contains("v_max"));
    CHECK(w.count_lines("said", "cg-ic-equal-accuracy") == 1);
    for (const char* name : {"system", "system_rhs", "symmetric", "symmetric_rhs", "symmetric_vertices", "positions"})
        CHECK(w.has(std::string("exported/") + name + ".mtx"));
}

TEST_CASE("benchmark says which peers cannot take part, and goes on")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK " --mesh mesh.obj --laplacian ptackova-velho --steps 2 --json case.json") == 0);
    const Json json = w.json("case.json");
    CHECK(json["reference"] == "umfpack");
    CHECK(json["peers"]["cholmod"]["error"] == "left out: Ptáčková-Velho is not symmetric");
    CHECK(json["peers"]["cgal"]["error"] == "left out: smooth_shape takes triangles only");
    CHECK(json["peers"]["bicgstab-1e-8"]["step_s"].get<double>() > 0.0);
    CHECK_FALSE(json["ratios"].contains("cholmod"));
}

TEST_CASE("benchmark without peers knows its distance to the undecomposed flow, or does without")
{
    const Workshop w;
    const std::string ours = BENCHMARK " --vertices 2000 --steps 1 --subdomains 4 --peers none --json case.json";
    REQUIRE(w.run(ours) == 0);
    const double direct = w.json("case.json")["ours"]["v_max"].get<double>();
    REQUIRE(w.run(ours + " --reference iterative") == 0);
    CHECK(w.json("case.json")["reference"] == "cg-1e-12");
    CHECK(w.json("case.json")["ours"]["v_max"].get<double>() == test::relative(direct, 1e-6));
    REQUIRE(w.run(ours + " --reference none") == 0);
    CHECK_FALSE(w.json("case.json")["ours"].contains("v_max"));
}

TEST_CASE("benchmark sweeps over sizes and over threads")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK " --scaling --vertices 15000 --steps 1 --json scaling.json") == 0);
    const Json sizes = w.json("scaling.json")["scaling"];
    REQUIRE(sizes.size() == 2);
    CHECK(sizes[0]["vertices"].get<double>() == test::relative(10'000, 0.1));
    CHECK(sizes[1]["vertices"].get<double>() == test::relative(15'000, 0.1));
    REQUIRE(w.run(BENCHMARK " --threads-sweep --vertices 1000 --threads 2 --steps 2 --json sweep.json") == 0);
    const Json threads = w.json("sweep.json")["threads_sweep"];
    REQUIRE(threads.size() == 2);
    CHECK(threads[1]["threads"] == 2);
}

TEST_CASE("benchmark finds out for a grid of cells who is the fastest at equal accuracy")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK
                  " --grid mesh.obj --kind triangles --vertices 10000 --time-step-edges 5 --steps 2 --turns 2 "
                  "--peers cholmod,cg,our-cg,undecomposed --json grid.json") == 0);
    const Json cells = w.json("grid.json")["grid"];
    REQUIRE(cells.size() == 2);
    CHECK(cells[0]["mesh"] == "triangles");
    CHECK(cells[1]["mesh"] == "mesh.obj");
    int losses = 0;
    for (const Json& cell : cells) {
        CHECK(cell["steps"] == 2);
        CHECK(cell["dt_over_h2"] == 5.0);
        const Json& ours = cell["ours"];
        CHECK(ours["total"]["turns_s"].size() == 2);
        const Json& fastest = cell["peers"][cell["fastest_peer"].get<std::string>()];
        CHECK(fastest["v_max"].get<double>() <= std::max(ours["v_max"].get<double>(), 1e-3));
        CHECK(fastest["v_mean"].get<double>() <= std::max(ours["v_mean"].get<double>(), 1e-4));
        CHECK(
            cell["ratio"].get<double>() ==
            test::relative(fastest["total"]["median_s"].get<double>() / ours["total"]["median_s"].get<double>(), 1e-5));
        losses += cell["ratio"].get<double>() < 1.0 ? 1 : 0;
        CHECK(cell["peers"]["our-cg"]["approach"] == "cg");
    }
    CHECK(w.count_lines("said", "ours is not the fastest in " + std::to_string(losses) + " of 2 cells") == 1);
    CHECK(w.count_lines("said", "  triangles, ") + w.count_lines("said", "  mesh.obj, ") == losses);
}

TEST_CASE("benchmark goes on where ours fails in a cell of its grid")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK " --grid --kind quads --vertices 10000 --steps 1 --turns 1 --converge 1e-8 "
                            "--memory-limit 1K --peers none --json grid.json") == 0);
    CHECK(w.json("grid.json")["grid"][3]["ours"].contains("error"));
    CHECK(w.count_lines("said", "| quads | 10000 | failed | failed | failed | failed |") == 1);
}

TEST_CASE("benchmark explains by which costs ours chooses its approach")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK " --explain --vertices 3000 --steps 2 --json explained.json") == 0);
    const Json json = w.json("explained.json");
    REQUIRE(json["approaches"].size() == 4);
    std::string cheapest;
    double least = 1e300;
    for (const auto& [key, approach] : json["approaches"].items()) {
        const std::string name = key;
        CAPTURE(name);
        CHECK(approach["measured"]["approach"] == name);
        CHECK(approach["measured"]["v_max"].get<double>() < 1.0);
        const Json& predicted = approach["predicted"];
        const double all = predicted["setup_s"].get<double>() + 2.0 * predicted["step_s"].get<double>();
        CHECK(predicted["all_s"].get<double>() == test::relative(all, 1e-5));
        if (all < least) {
            least = all;
            cheapest = name;
        }
    }
    CHECK(json["chosen"] == cheapest);
    CHECK(json["coefficients"].get<double>() == test::relative(6.0, 1e-5));
    CHECK(json["constants"].size() == 9);
    CHECK(w.count_lines("said", cheapest + " *") == 1);
}

TEST_CASE("benchmark runs smooth from file to file beside peers of equal accuracy")
{
    const Workshop w;
    REQUIRE(w.run("mkdir scratch; TMPDIR=scratch " BENCHMARK " --whole-run --vertices 10000 --subdomains 4 --steps 2 "
                  "--turns 2 --json whole.json") == 0);
    CHECK(std::filesystem::is_empty(w.directory / "scratch"));
    REQUIRE(w.run(BENCHMARK " --vertices 10000 --subdomains 4 --steps 2 --peers none --json case.json") == 0);
    const double v_max = w.json("case.json")["ours"]["v_max"].get<double>();
    const Json runs = w.json("whole.json")["whole_runs"];
    REQUIRE(runs.size() == 2);
    CHECK(runs[0]["format"] == "obj");
    CHECK(runs[1]["format"] == "ply");
    CHECK(runs[1]["file_bytes"] < runs[0]["file_bytes"]);
    for (const Json& run : runs) {
        CHECK(run["v_max"].get<double>() == test::relative(v_max, 1e-6));
        CHECK(run["smooth"]["turns_s"].size() == 2);
        for (const auto& [key, seconds] : run["phases"].items()) {
            const std::string name = key;
            CAPTURE(name);
            if (name == "rest")  // a difference of two runs: nothing may be left on a busy machine
                CHECK(seconds.get<double>() >= 0.0);
            else
                CHECK(seconds.get<double>() > 0.0);
        }
        CHECK(run["ratio_to_cholmod_step"].get<double>() ==
              test::relative(run["smooth"]["median_s"].get<double>() / run["cholmod_step"]["median_s"].get<double>(),
                             1e-5));
        for (const char* peer : {"cholmod", "cg"}) {
            CHECK(run["peers"][peer]["whole"]["turns_s"].size() == 2);
            CHECK(run["peers"][peer]["whole"]["least_s"].get<double>() > 0.0);
        }
    }
}

TEST_CASE("benchmark runs smooth on a given file, and on larger and larger ones")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK " --whole-run --mesh mesh.obj --steps 1 --turns 1 --peers none --json whole.json") == 0);
    const Json run = w.json("whole.json")["whole_runs"][0];
    CHECK(run["file_bytes"] == std::filesystem::file_size(w.directory / "mesh.obj"));
    CHECK_FALSE(run.contains("v_max"));
    REQUIRE(w.run(BENCHMARK " --whole-run --scaling --vertices 15000 --steps 1 --turns 1 --json whole.json") == 0);
    CHECK(w.json("whole.json")["whole_runs"].size() == 4);
    CHECK(w.count_lines("said", "     10000     obj") == 1);
}

TEST_CASE("benchmark replays its tasks with more threads than there are")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK " --vertices 5000 --subdomains 30 --steps 3 --simulate-threads 1,2,1024 "
                            "--memory-bandwidth 1e-3 --json simulated.json") == 0);
    const Json json = w.json("simulated.json");
    CHECK(json["threads"] == 1);
    REQUIRE(json["simulated_threads"].size() == 3);
    CHECK(json["simulated_threads"][2]["threads"] == 1024);
    CHECK(json["simulated_threads"][0]["efficiency"].get<double>() == test::relative(1.0, 1e-5));
    CHECK(json["simulated_threads"][2]["speed_up"] >= json["simulated_threads"][1]["speed_up"]);
    CHECK(json["simulated_threads"][2]["makespan_s"] >= json["simulated_threads"][2]["critical_path_s"]);
    CHECK(w.count_lines("said", "   1024 ") == 1);
    const Json& approaches = json["approaches"]["entries"];
    CHECK(json["approaches"]["memory_bytes_per_second"] == 1e6);
    for (const char* approach : {"sweep", "converged", "cg", "undecomposed"}) {
        CAPTURE(approach);
        const Json& costs = approaches[approach];
        REQUIRE(costs.size() == 3);
        CHECK(costs[2]["cores"] == 1024);
        CHECK(costs[0]["setup_s"].get<double>() > costs[1]["setup_s"].get<double>());
        CHECK(costs[1]["setup_s"].get<double>() > costs[2]["setup_s"].get<double>());
        CHECK(costs[1]["all_s"].get<double>() ==
              test::relative(costs[1]["setup_s"].get<double>() + 3 * costs[1]["step_s"].get<double>(), 1e-9));
        CHECK(w.count_lines("said", std::string(approach) + " ") >= 4);
    }
    // Of an iteration of 256 bytes for each vertex, and a megabyte a second, cores save nothing.
    CHECK(approaches["cg"][2]["step_s"].get<double>() > 5000 * 256 / 1e6);
    CHECK(approaches["cg"][2]["step_s"] == approaches["cg"][0]["step_s"]);
    CHECK(approaches["undecomposed"][2]["step_s"] == approaches["undecomposed"][0]["step_s"]);
    CHECK(approaches["converged"][2]["step_s"].get<double>() < approaches["converged"][1]["step_s"].get<double>());
}

TEST_CASE("benchmark solves k-harmonic steps, as exactly as direct solvers of the whole mesh")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK " --vertices 5000 --k-harmonic 1,2,3 --json k.json") == 0);
    const Json list = w.json("k.json")["k_harmonic"];
    REQUIRE(list.size() == 15);
    for (const Json& row : list) {
        CAPTURE(row.dump());
        const std::string method = row["method"];
        const double error = row.value("backward_error", 1.0);
        CHECK(error < (method.starts_with("cg") ? 1e-8 : method == "ours 1e-08" ? 1e-7 : 1e-12));
        CHECK(row.value("solve_s", 0.0) > 0.0);
    }
    CHECK(w.count_lines("said", "k = ") == 3);
    REQUIRE(w.run(BENCHMARK " --kind hexagons --vertices 2000 --k-harmonic 2 --laplacian virtual-refinement "
                            "--json k.json") == 0);
    CHECK(w.json("k.json")["k_harmonic"].size() == 5);
    for (const Json& row : w.json("k.json")["k_harmonic"])
        CHECK(row["backward_error"].get<double>() < 1e-7);
}

TEST_CASE("benchmark counts what ranks say to each other")
{
    const Workshop w;
    REQUIRE(w.run(BENCHMARK " --vertices 5000 --subdomains 30 --steps 2 --simulate-ranks 1,2,6 --json ranks.json") ==
            0);
    const Json list = w.json("ranks.json")["simulated_ranks"];
    REQUIRE(list.size() == 3);
    CHECK(list[0]["messages"] == 0);
    CHECK(list[2]["messages"] > list[1]["messages"].get<int>() / 3);
    CHECK(list[2]["most_vertices"] < 1500);
    for (const Json& run : list) {
        CHECK(run["same_bits"] == true);
        CHECK(run["sub_meshes"] == 30);
        CHECK(run["most_vertices"].get<double>() >= run["mean_vertices"].get<double>());
        CHECK(!run.contains("iterations"));
    }
    CHECK(w.count_lines("said", "a model, not a measurement: ") == 1);
    REQUIRE(w.run(BENCHMARK " --vertices 5000 --subdomains 30 --steps 1 --converge 1e-8 --simulate-ranks 1,3 "
                            "--json converged.json") == 0);
    const Json converged = w.json("converged.json")["simulated_ranks"];
    CHECK(converged[0]["iterations"] > 5);
    CHECK(converged[1]["iterations"] == converged[0]["iterations"]);
    CHECK(converged[1]["messages"] > converged[1]["iterations"]);
    CHECK(converged[1]["same_bits"] == true);
}

TEST_CASE("benchmark takes all conditions, and a limit of memory")
{
    const Workshop w;
    const std::string ours = BENCHMARK " --mesh mesh.obj --steps 1 --subdomains 12 --peers none --json case.json ";
    std::vector<double> distances;
    for (const char* conditions :
         {"robin", "ventcell --q 0.1", "adapted-ventcell --q 0.1", "adapted-robin", "schwarz"}) {
        REQUIRE(w.run(ours + "--conditions " + conditions) == 0);
        distances.push_back(w.json("case.json")["ours"]["v_max"].get<double>());
        CHECK(std::count(distances.begin(), distances.end(), distances.back()) == 1);
    }
    REQUIRE(w.run(ours + "--converge never --memory-limit 1GiB") == 0);
    CHECK(w.json("case.json")["ours"]["v_max"] == distances[3]);
    CHECK(w.run(ours + "--memory-limit 1K") != 0);
    CHECK(w.said().find("memory_limit is 1000 bytes") != std::string::npos);
}

TEST_CASE("benchmark that is stopped leaves nothing behind")
{
    const Workshop w;
    // The shell waits until the mesh is there before it stops the program.
    CHECK(w.run("{ mkdir scratch; TMPDIR=scratch " BENCHMARK " --vertices 300000 --steps 1000 --peers none & "
                "for i in $(seq 100); do ls scratch/*/mesh.bin && break; sleep 0.1; done; kill $!; wait $!; "
                "test $? -eq 143; }") == 0);
    CHECK(w.count_lines("said", "scratch/benchmark-") == 1);
    CHECK(std::filesystem::is_empty(w.directory / "scratch"));
}

// Sanitizers reserve more addresses than that for themselves.
TEST_CASE("benchmark with little memory to address says which peers do without, and ends" *
          doctest::skip(test::under_sanitizers))
{
    // OpenBLAS takes its memory otherwise for some processors than for others.
    for (const std::string processor : {"", "env -u OPENBLAS_CORETYPE "}) {
        CAPTURE(processor);
        const Workshop w;
        REQUIRE(w.run("ulimit -v 760000; timeout 60 " + processor +
                      BENCHMARK " --vertices 400000 --steps 1 --threads 1 --reference none --peers umfpack --json "
                                "case.json") == 0);
        CHECK(w.json("case.json")["peers"]["umfpack"].contains("error"));
    }
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
                                  "--conditions none",
                                  "--peers everybody",
                                  "--reference nobody",
                                  "--mesh mesh.obj --vertices 1000",
                                  "--mesh mesh.obj --kind quads",
                                  "--scaling --threads-sweep",
                                  "--scaling --mesh mesh.obj",
                                  "--scaling --export exported",
                                  "--scaling --vertices 1000",
                                  "--threads-sweep --peers cg",
                                  "--simulate-threads 0",
                                  "--simulate-threads 1 --peers cg",
                                  "--memory-bandwidth 100",
                                  "--k-harmonic 4",
                                  "--k-harmonic 0",
                                  "--k-harmonic 1 --laplacian fujiwara",
                                  "--k-harmonic 1 --peers cg",
                                  "--simulate-threads 1 --memory-bandwidth 0",
                                  "--simulate-threads 1 --scaling",
                                  "--simulate-threads 1 --threads-sweep",
                                  "--simulate-ranks 0",
                                  "--simulate-ranks 2 --simulate-threads 2",
                                  "--grid --scaling",
                                  "--grid --mesh mesh.obj",
                                  "--grid --vertices 1000",
                                  "--grid --reference none",
                                  "--grid --turns 0",
                                  "--turns 2",
                                  "--explain --grid",
                                  "--explain --laplacian ptackova-velho",
                                  "--whole-run --grid",
                                  "--whole-run --threads-sweep",
                                  "--whole-run --export exported",
                                  "--whole-run --reference none",
                                  "--whole-run --memory-limit 1G",
                                  "--conditions ventcell",
                                  "--q 0.1",
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
    (void)w.directory.with("file", "");
    CHECK(w.run(BENCHMARK " --export file/below") == 5);
}
