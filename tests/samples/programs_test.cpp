#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "partition/formats/mesh_io.h"
#include "tests/samples/all_programs.h"
#include "tests/samples/workshop.h"
#include "tests/support/relative.h"
#include "tests/support/skipped.h"

using namespace seamflow;
using test::Json;
using test::Workshop;
namespace fs = std::filesystem;

TEST_CASE("help and success end with 0")
{
    const Workshop w;
    for (const std::string& program : test::all_programs())
        CHECK(w.run(program + " --help") == 0);
    CHECK(w.smooth("mesh.obj out.obj --time-step 1e-3") == 0);
    CHECK(w.has("out.obj"));
    CHECK(w.run(COMPARE " mesh.obj out.obj --report distance.json") == 0);
    CHECK(w.json("distance.json")["v_mean"].get<double>() > 0.0);
    CHECK(w.json("distance.json")["mean_edge"].get<double>() > 0.0);
}

TEST_CASE("unusable input ends with 3")
{
    const Workshop w;
    (void)w.directory.with("broken.obj", "v 0 0 0\nv 1 0\n");
    (void)w.directory.with("few.txt", "0\n1\n");
    CHECK(w.smooth("nothing.obj out.obj --time-step 1") == 3);
    CHECK(w.smooth("broken.obj out.obj --time-step 1") == 3);
    CHECK(w.smooth("mesh.obj out.obj --time-step 1 --labels nothing.txt") == 3);
    CHECK(w.smooth("mesh.obj out.obj --time-step 1 --labels few.txt") == 3);
    CHECK(w.said().find("few.txt") != std::string::npos);
    (void)w.directory.with("points.obj", "v 0 0 0\nv 1 0 0\n");
    CHECK(w.run(COMPARE " mesh.obj nothing.obj") == 3);
    CHECK(w.run(COMPARE " mesh.obj points.obj") == 3);
    CHECK(w.said().find("vertices") != std::string::npos);
    REQUIRE(w.run(GENERATE " mixed smaller.obj --vertices 500") == 0);
    CHECK(w.run(COMPARE " mesh.obj smaller.obj --error-map map.ply --show vertex-distance") == 3);
    CHECK(w.said().find("correspond") != std::string::npos);
    CHECK_FALSE(w.has("map.ply"));
    CHECK_FALSE(w.has("out.obj"));
}

TEST_CASE("what an option does not take is said with all that it takes")
{
    const Workshop w;
    CHECK(w.smooth("sphere.obj out.obj --radius 1% --time-step 2") == 2);
    CHECK(w.said().find("--time-step, --time-step-edges and --radius all say how much to smooth") != std::string::npos);
    CHECK(w.smooth("sphere.obj out.obj --weld always") == 2);
    CHECK(w.said().find("(2%), nor never") != std::string::npos);
}

TEST_CASE("output that cannot be written ends with 5, before the work begins")
{
    const Workshop w;
    CHECK(w.smooth("mesh.obj nowhere/out.obj --time-step 1") == 5);
    CHECK(w.smooth("mesh.obj out.obj --time-step 1 --report nowhere/report.json") == 5);
    CHECK(w.smooth("mesh.obj out.obj --time-step 1 --trace nowhere/trace.json") == 5);
    CHECK(w.smooth("mesh.obj out.obj --time-step 1 --parts nowhere/parts.ply") == 5);
    CHECK(w.smooth("mesh.obj out.obj --time-step 1 --every-step nowhere/%d.obj") == 5);
    CHECK(w.smooth("mesh.obj out.stl --time-step 1") == 5);
    CHECK(w.said().find("result ") == std::string::npos);
    CHECK(w.run(COMPARE " mesh.obj mesh.obj --report nowhere/report.json") == 5);
    CHECK(w.run(COMPARE " mesh.obj mesh.obj --error-map nowhere/map.ply") == 5);
    CHECK(w.run(GENERATE " quads nowhere/out.obj") == 5);
    CHECK_FALSE(w.has("out.obj"));
}

TEST_CASE("a report goes to standard output, and one of a run that fails says why")
{
    const Workshop w;
    REQUIRE(w.run("(" SMOOTH " mesh.obj out.obj --time-step-edges 2 --report - > report.json 2> printed)") == 0);
    CHECK(w.json("report.json")["output"] == "out.obj");
    CHECK(test::content_of(w.directory / "printed").find("result     out.obj") != std::string::npos);
    CHECK(w.run("(cat mesh.obj | " SMOOTH " - out.obj --time-step-edges 2 --report - --quiet > report.json)") == 0);
    CHECK(w.json("report.json")["input"] == "-");
    CHECK(w.smooth("mesh.obj - --time-step-edges 2 --report -") == 2);
    CHECK(w.smooth("mesh.obj out.obj --time-step-edges 2 --trace -") == 2);
    CHECK(w.run("(" COMPARE " mesh.obj out.obj --report - > report.json 2> printed)") == 0);
    CHECK(w.json("report.json")["v_max"].get<double>() > 0.0);

    CHECK(w.smooth("nothing.obj other.obj --time-step-edges 2 --report report.json") == 3);
    const Json failed = w.json("report.json");
    CHECK(failed["input"] == "nothing.obj");
    CHECK(failed["arguments"].size() == 6);
    CHECK(failed["error"]["exit_status"] == 3);
    CHECK("smooth: " + failed["error"]["message"].get<std::string>() + "\n" == w.said());
    CHECK(w.run("(" SMOOTH " nothing.obj other.obj --time-step-edges 2 --report - > report.json)") == 3);
    CHECK(w.json("report.json")["error"]["exit_status"] == 3);
}

TEST_CASE("faces that are none take no part, stay in the file and are told of; --strict refuses them")
{
    const Workshop w;
    const std::string faces = "f 1 2 3\nf 1 1 2\nf 2 4 3\n";
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
    static_cast<void>(w.directory.with("bad.obj", vertices + faces));
    REQUIRE(w.smooth("bad.obj out.obj --time-step 1e-2") == 0);
    CHECK(w.count_lines("said", "remark     1 face names a vertex twice or has fewer than three corners") == 1);
    CHECK(w.said().find("bad.obj:6: the face names vertex 1 twice") != std::string::npos);
    CHECK(w.said().find("the result keeps all this unchanged") != std::string::npos);
    CHECK(test::content_of(w.directory / "out.obj").find(faces) != std::string::npos);
    REQUIRE(w.smooth("bad.obj out.ply --time-step 1e-2") == 0);
    CHECK(w.said().find("the result leaves all this out") != std::string::npos);
    CHECK(read_mesh(w.directory / "out.ply").mesh.n_faces() == 2);
    CHECK(w.smooth("bad.obj out.obj --time-step 1e-2 --strict") == 3);
    CHECK(w.run(COMPARE " bad.obj out.obj") == 0);
    CHECK(w.run(INSPECT " bad.obj") == 0);
    CHECK(w.said().find("refuses the file with --strict") != std::string::npos);
    // Labels are those of the file.
    static_cast<void>(w.directory.with("labels.txt", "0\n7\n0\n"));
    CHECK(w.smooth("bad.obj out.obj --time-step 1e-2 --labels labels.txt") == 0);
    static_cast<void>(w.directory.with("labels.txt", "0\n0\n"));
    CHECK(w.smooth("bad.obj out.obj --time-step 1e-2 --labels labels.txt") == 3);
}

TEST_CASE("the report of smooth has its keys")
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj out.obj --time-step-edges 2 --plain --subdomains 2 --steps 3 --threads 1 "
                     "--laplacian ptackova-velho --reference --report report.json --verbose") == 0);
    const Json report = w.json("report.json");
    for (const char* key : {"vertices",
                            "faces",
                            "subdomains",
                            "colours",
                            "laplacian",
                            "time_step",
                            "threads",
                            "p",
                            "seconds",
                            "steps",
                            "displacement",
                            "peak_memory_bytes",
                            "page_faults",
                            "subdomain_vertices",
                            "interface_vertices",
                            "repaired_faces",
                            "surface",
                            "choices",
                            "remarks",
                            "mean_edge",
                            "input",
                            "output"})
        CHECK_MESSAGE(report.contains(key), key);
    for (const char* key :
         {"read", "choose", "cut", "analyse", "assemble", "factorise", "solve", "correct", "step", "total", "write"})
        CHECK_MESSAGE(report["seconds"][key].is_number(), key);
    REQUIRE(report["steps"].size() == 3);
    for (const char* key :
         {"seconds", "max_mean_curvature_before", "max_mean_curvature_after", "v_mean", "v_rms", "v_max",
          "tangential_mean", "tangential_rms", "tangential_max", "normal_mean", "normal_rms", "normal_max"})
        CHECK_MESSAGE(report["steps"][2][key].is_number(), key);
    for (const char* key : {"tangential_mean", "tangential_rms", "tangential_max", "normal_mean", "normal_rms",
                            "normal_max", "drift_mean", "drift_rms", "drift_max"})
        CHECK_MESSAGE(report["displacement"][key].get<double>() > 0.0, key);
    CHECK(report["laplacian"] == "ptackova-velho");
    CHECK(report["threads"] == 1);
    CHECK(report["p"].size() == report["subdomains"].get<std::size_t>());
    const double edge = report["mean_edge"].get<double>();
    CHECK(report["time_step"].get<double>() == test::relative(2.0 * edge * edge, 1e-5));
    CHECK(w.count_lines("said", "step ") == 3);
    CHECK(w.said().find("V_mean") != std::string::npos);
}

TEST_CASE("--memory-limit bounds the factors, which the summary tells, and changes nothing else")
{
    const Workshop w;
    const std::string flow =
        " --time-step-edges 2 --subdomains 12 --converge never --steps 2 --threads 1 --report report.json";
    REQUIRE(w.smooth("mesh.obj free.obj" + flow + " --memory-limit 1GiB --verbose") == 0);
    const int enough = w.json("report.json")["live_factors"];
    CHECK(w.count_lines("said", "factors    at most " + std::to_string(enough) + " at once, ") == 1);
    CHECK(w.smooth("mesh.obj tight.obj" + flow + " --memory-limit 1K") == 2);
    const std::string complaint = w.said();
    const std::string least = complaint.substr(complaint.find(" take ") + 6);
    REQUIRE(w.smooth("mesh.obj tight.obj" + flow + " --memory-limit " + least.substr(0, least.find(':'))) == 0);
    CHECK(w.json("report.json")["live_factors"] < enough);
    CHECK(w.json("report.json")["factor_memory_bytes"].get<std::size_t>() <= std::stoul(least));
    CHECK(test::content_of(w.directory / "tight.obj") == test::content_of(w.directory / "free.obj"));
    REQUIRE(w.smooth("mesh.obj free.obj --time-step-edges 2") == 0);
    REQUIRE(w.smooth("mesh.obj lean.obj --time-step-edges 2 --memory-limit 1") == 0);
    CHECK(w.said().find("at once by conjugate gradients") != std::string::npos);
    REQUIRE(w.smooth("mesh.obj out.obj --time-step 1e-7 --scheme explicit --memory-limit 1") == 0);
    CHECK(w.count_lines("said", "factors") == 0);
}

TEST_CASE("a missed tolerance ends with 4 and the last state, fewer iterations on request with 0")
{
    const Workshop w;
    const std::string flow = " --time-step-edges 2 --subdomains 12 --steps 2 --report report.json --converge ";
    REQUIRE(w.smooth("mesh.obj exact.obj" + flow + "1e-9") == 0);
    const Json report = w.json("report.json");
    CHECK(report["steps_short_of_tolerance"] == 0);
    for (const auto& step : report["steps"]) {
        CHECK(step["residual"].get<double>() <= 1e-9);
        CHECK(step["estimated_v_max"].get<double>() < 1e-6);
    }
    CHECK(w.smooth("mesh.obj missed.obj" + flow + "1e-100") == 4);
    CHECK(w.said().find("the tolerance 1e-100 was missed in 2 steps; missed.obj has the last state") !=
          std::string::npos);
    CHECK(w.has("missed.obj"));
    CHECK(w.json("report.json")["steps_short_of_tolerance"] == 2);
    CHECK(w.json("report.json")["steps_stagnated"] == 2);
    CHECK(w.smooth("mesh.obj missed.obj" + flow + "1e-100 --converge-iterations 900") == 4);
    REQUIRE(w.smooth("mesh.obj early.obj" + flow + "1e-9 --converge-iterations 2") == 0);
    CHECK(w.json("report.json")["steps"][1]["iterations"] == 2);
    CHECK(w.json("report.json")["steps_stagnated"] == 0);
    CHECK(w.said().find("not reached in 2 steps") != std::string::npos);
}

TEST_CASE("to miss a tolerance that nobody asked for is a remark, and no failure")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere sphere.ply --vertices 400") == 0);
    const std::string flow = "sphere.ply out.ply --time-step-edges 2 --steps 3 --subdomains 5 --converge-iterations 1";
    CHECK(w.smooth(flow) == 0);
    CHECK(w.said().find("The tolerance was not reached in ") != std::string::npos);
}

TEST_CASE("what a shell puts through a pipe is recognised by its content, and a directory is no file to write")
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj alone.obj --radius 2%") == 0);
    for (const std::string command :
         {" /dev/stdin piped.obj --radius 2% < mesh.obj", " /dev/fd/0 piped.obj --radius 2% < mesh.obj",
          " - piped.obj --radius 2% < mesh.obj"}) {
        CAPTURE(command);
        std::filesystem::remove(w.directory / "piped.obj");
        CHECK(w.run(SMOOTH + command) == 0);
        CHECK(test::content_of(w.directory / "piped.obj") == test::content_of(w.directory / "alone.obj"));
    }
    CHECK(w.run("cat mesh.obj | " SMOOTH " /dev/stdin piped.ply --radius 2%") == 0);
    CHECK(w.run(SMOOTH " /dev/stdin piped.ply --radius 2% < /dev/null") == 3);
    CHECK(w.said().find("/dev/stdin: there is nothing in it") != std::string::npos);
    for (const std::string output : {".", "./", "folder", "folder/"}) {
        std::filesystem::create_directory(w.directory / "folder");
        CHECK(w.smooth("mesh.obj " + output + " --radius 2%") == 2);
        CHECK(w.said().find("smooth: " + output + ": is a directory; name a file in it") != std::string::npos);
    }
}

TEST_CASE("a file without faces that can flow is refused by all programs in one sentence")
{
    const Workshop w;
    std::ofstream(w.directory / "points.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    std::ofstream(w.directory / "lines.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\nf 3 3 3 1\n";
    const std::string points = "points.obj: has no faces: vertices alone are not a surface";
    const std::string lines = "lines.obj: has no faces: 2 faces cannot be used (the first: lines.obj:4: the face names "
                              "vertex 2 twice";
    for (const std::string options : {"", " --radius 1%", " --time-step 1", " --time-step-edges 1", " --preset cad",
                                      " --preset fair", " --preset terrain"}) {
        CAPTURE(options);
        for (const auto& [file, sentence] : {std::pair{"points.obj", points}, {"lines.obj", lines}}) {
            CHECK(w.smooth(std::string(file) + " out.obj" + options) == 3);
            CHECK(w.said().find("smooth: " + sentence) != std::string::npos);
            CHECK(w.said().find("inf") == std::string::npos);
            CHECK(!w.has("out.obj"));
        }
    }
    CHECK(w.run(INSPECT " points.obj") == 3);
    CHECK(w.said().find("inspect: " + points) != std::string::npos);
    CHECK(w.run(COMPARE " points.obj points.obj") == 3);
    CHECK(w.said().find("compare: " + points) != std::string::npos);
}

TEST_CASE("--trace writes which task ran when, and changes nothing else")
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj silent.obj --time-step-edges 2 --subdomains 4 --steps 3 --converge never") == 0);
    REQUIRE(
        w.smooth("mesh.obj out.obj --time-step-edges 2 --subdomains 4 --steps 3 --converge never --trace trace.json "
                 "--task-graph graph.dot "
                 "--report report.json") == 0);
    CHECK(test::content_of(w.directory / "silent.obj") == test::content_of(w.directory / "out.obj"));
    std::map<std::string, int> slices;
    std::ptrdiff_t starts = 0;
    const Json trace = w.json("trace.json");
    for (const Json& event : trace["traceEvents"]) {
        if (event["ph"] == "X")
            ++slices[event["name"]];
        starts += event["ph"] == "s" ? 1 : 0;
    }
    for (int s = 0; s < w.json("report.json")["subdomains"]; ++s)
        for (const char* phase : {"assemble and factorise ", "solve ", "accept "})
            CHECK_MESSAGE(slices[phase + std::to_string(s)] == 3, phase, s);
    CHECK(slices["step 3"] == 1);
    CHECK(starts > 0);
    const std::string graph = test::content_of(w.directory / "graph.dot");
    CHECK(graph.starts_with("digraph step {"));
    CHECK(graph.find("[label=\"accept 3\"]") != std::string::npos);
    CHECK(w.count_lines("trace.json", R"({"ph":"f")") == starts);
}

TEST_CASE("compare tells V_, H_ and displacements of meshes that correspond")
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj out.obj --time-step-edges 1") == 0);
    REQUIRE(w.run(COMPARE " mesh.obj out.obj --report compared.json --direction both --error-map map.ply "
                          "--show tangential") == 0);
    const Json compared = w.json("compared.json");
    const double edge = compared["mean_edge"].get<double>();
    for (const std::string name : {"v", "h", "h_back"})
        for (const std::string which : {"_mean", "_rms", "_max"}) {
            const std::string key = name + which;
            CAPTURE(key);
            const double relative = compared[key].get<double>();
            CHECK(relative > 0.0);
            CHECK(compared[key + "_absolute"].get<double>() == test::relative(relative * edge, 1e-5));
        }
    for (const char* key :
         {"tangential_mean", "tangential_rms", "tangential_max", "normal_mean", "normal_rms", "normal_max"})
        CHECK_MESSAGE(compared[key].get<double>() > 0.0, key);
    CHECK(compared["h_max"] <= compared["v_max"]);
    CHECK(compared["remarks"].empty());
    CHECK(w.said().find("H_RMS") != std::string::npos);
    CHECK(w.count_lines("map.ply", "property double tangential") == 1);
    CHECK(w.count_lines("map.ply", "property uchar red") == 1);
    REQUIRE(w.smooth("mesh.obj out.obj --time-step-edges 1 --report report.json") == 0);
    CHECK(w.json("report.json")["displacement"]["tangential_mean"].get<double>() ==
          test::relative(compared["tangential_mean"].get<double>(), 1e-5));
}

TEST_CASE("compare tells H_ alone of meshes that do not correspond")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " mixed other.obj --vertices 900 --seed 2") == 0);
    REQUIRE(w.run(GENERATE " mixed smaller.obj --vertices 500") == 0);
    for (const std::string candidate : {"other.obj", "smaller.obj"}) {
        CAPTURE(candidate);
        REQUIRE(w.run(COMPARE " mesh.obj " + candidate + " --report compared.json --error-map map.ply") == 0);
        CHECK(w.said().find("V_ and displacements are left out") != std::string::npos);
        CHECK_FALSE(w.json("compared.json").contains("v_mean"));
        CHECK(w.json("compared.json")["h_mean"].get<double>() > 0.0);
        CHECK(w.json("compared.json")["remarks"].size() == 1);
        CHECK(w.count_lines("map.ply", "property double distance") == 1);
    }
}

TEST_CASE("a time step given before --plain stays")
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj out.obj --time-step 0.003 --steps 2 --plain --report report.json") == 0);
    CHECK(w.json("report.json")["time_step"] == 0.003);
    CHECK(w.json("report.json")["steps"].size() == 2);
    CHECK_FALSE(w.json("report.json")["steps"][0].contains("v_mean"));
}

TEST_CASE("--every-step writes the mesh after each step, the last as OUTPUT")
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj out.obj --time-step 1e-3 --steps 3 --every-step step_%02d.obj") == 0);
    CHECK_FALSE(w.has("step_00.obj"));
    CHECK(w.has("step_01.obj"));
    CHECK(test::content_of(w.directory / "step_02.obj") != test::content_of(w.directory / "step_03.obj"));
    CHECK(test::content_of(w.directory / "step_03.obj") == test::content_of(w.directory / "out.obj"));
    CHECK_FALSE(w.has("step_04.obj"));
}

TEST_CASE("smooth keeps what a file holds besides positions, over the file itself, too")
{
    const Workshop w;
    static_cast<void>(w.directory.with("a.obj", "# theirs\n" + test::content_of(w.directory / "mesh.obj") +
                                                    "vt 0 1\r\ng last # group"));
    REQUIRE(w.smooth("a.obj b.obj --time-step-edges 1 --every-step step-%d.obj") == 0);
    CHECK(w.run("diff a.obj b.obj | grep '^[<>]' | grep -qv '^[<>] v '") == 1);
    CHECK(w.run("diff a.obj b.obj | grep -q '^> v '") == 0);
    CHECK(w.run("cmp step-1.obj b.obj") == 0);
    REQUIRE(w.smooth("a.obj a.obj --time-step-edges 1") == 0);
    CHECK(w.run("cmp a.obj b.obj") == 0);
    REQUIRE(w.smooth("a.obj c.off --time-step-edges 1 --report report.json") == 0);
    CHECK(w.said().find("c.off lacks the input's data besides the surface: texture coordinates, groups") !=
          std::string::npos);
    CHECK(w.json("report.json")["remarks"].dump().find("texture coordinates, groups") != std::string::npos);
}

TEST_CASE("a dash is standard input or output, compressed or not, and what a program says does not get into a mesh")
{
    const Workshop w;
    const auto content = [&](const std::string& name) { return test::content_of(w.directory / name); };
    REQUIRE(w.run(GENERATE " mixed ascii.ply --vertices 900") == 0);
    REQUIRE(w.run(GENERATE " triangles binary.stl --vertices 900") == 0);
    REQUIRE(w.run(GENERATE " mixed a.off --vertices 900") == 0);
    for (const std::string name : {"mesh.obj", "ascii.ply", "binary.stl", "a.off"}) {
        CAPTURE(name);
        const std::string expected = "expected" + fs::path(name).extension().string();
        REQUIRE(w.smooth(name + " " + expected + " --time-step-edges 1") == 0);
        CHECK(w.run("(cat " + name + " | " SMOOTH " - - --time-step-edges 1 >piped)") == 0);
        CHECK(content("piped") == content(expected));
        CHECK(w.said().find("result     -") != std::string::npos);
        CHECK(w.run("(gzip -c " + name + " | " SMOOTH " - - --time-step-edges 1 --quiet >piped)") == 0);
        CHECK(content("piped") == content(expected));
        CHECK(w.run("(cat " + name + " | " INSPECT " -)") == 0);
        CHECK(w.run("(cat " + name + " | " COMPARE " - " + expected + ")") == 0);
    }
    CHECK(w.run("(" GENERATE " mixed - --vertices 900 >piped)") == 0);
    CHECK(content("piped") == content("mesh.obj"));
    CHECK(w.run("(" GENERATE " mixed - --vertices 900 >/dev/full)") == 5);
    CHECK(w.said().find("standard output: cannot be written") != std::string::npos);
    CHECK(w.run(INSPECT " - </dev/null") == 3);
    CHECK(w.said().find("standard input: there is nothing in it") != std::string::npos);
    CHECK(w.run("(echo v 1 2 | " INSPECT " -)") == 3);
    CHECK(w.said().find("standard input:1: expected coordinate z") != std::string::npos);
    CHECK(w.smooth("mesh.obj out.obj.gz --time-step-edges 1") == 0);
    CHECK(w.run("(gzip -dc out.obj.gz | cmp - expected.obj)") == 0);
}

TEST_CASE("--labels cuts as told and --parts writes the cut")
{
    const Workshop w;
    const auto faces = w.count_lines("mesh.obj", "f ");
    std::string labels;
    for (std::ptrdiff_t f = 0; f < faces; ++f)
        labels += 3 * f < faces ? "0\n" : "1\n";
    (void)w.directory.with("labels.txt", labels);
    REQUIRE(w.smooth("mesh.obj out.obj --time-step 1e-3 --labels labels.txt --coloring label --p 3.5 --no-correction "
                     "--parts parts.ply --report report.json") == 0);
    CHECK(w.json("report.json")["subdomains"] == 2);
    CHECK(w.json("report.json")["p"] == Json::array({3.5, 3.5}));
    CHECK(w.count_lines("parts.ply", "element face " + std::to_string(faces)) == 1);
    CHECK(w.count_lines("parts.ply", "property int label") == 1);
}

TEST_CASE("the alternating Schwarz method and explicit Euler steps are options")
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj robin.obj --time-step 1e-3 --subdomains 4") == 0);
    REQUIRE(w.smooth("mesh.obj one.obj --time-step 1e-3 --subdomains 4 --conditions schwarz") == 0);
    REQUIRE(w.smooth("mesh.obj three.obj --time-step 1e-3 --subdomains 4 --conditions schwarz --overlap 3 --plain") ==
            0);
    REQUIRE(w.smooth("mesh.obj explicit.obj --time-step 1e-7 --scheme explicit") == 0);
    CHECK(test::content_of(w.directory / "robin.obj") != test::content_of(w.directory / "one.obj"));
    CHECK(test::content_of(w.directory / "one.obj") != test::content_of(w.directory / "three.obj"));
    CHECK(w.smooth("mesh.obj out.obj --time-step 1 --scheme explicit") == 2);
    CHECK(w.said().find("must be at most") != std::string::npos);
}

TEST_CASE("the classical conditions report their gaps, and leave them on request")
{
    const Workshop w;
    const std::string flow =
        "--time-step 1e-3 --subdomains 4 --conditions ventcell --q 0.1 --steps 2 --report report.json";
    REQUIRE(w.smooth("mesh.obj joined.obj --verbose " + flow) == 0);
    CHECK(w.said().find("gap mean ") != std::string::npos);
    CHECK(w.json("report.json")["steps"][1]["gap_max"] > w.json("report.json")["steps"][1]["gap_mean"]);
    CHECK(w.json("report.json")["steps"][1]["gap_max_absolute"] > 0.0);
    REQUIRE(w.smooth("mesh.obj apart.obj " + flow + " --keep-gaps --every-step step%d.obj") == 0);
    CHECK(w.count_lines("apart.obj", "f ") == w.count_lines("joined.obj", "f "));
    CHECK(w.count_lines("apart.obj", "v ") > w.count_lines("joined.obj", "v "));
    CHECK(test::content_of(w.directory / "step2.obj") == test::content_of(w.directory / "apart.obj"));
}

TEST_CASE("--html writes a page, and changes nothing else" * doctest::skip(!HAS_PAGE))
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj plain.obj --time-step-edges 2 --subdomains 3 --steps 2") == 0);
    REQUIRE(w.smooth("mesh.obj out.obj --time-step-edges 2 --subdomains 3 --steps 2 --reference --html page.html "
                     "--report report.json") == 0);
    CHECK(test::content_of(w.directory / "plain.obj") == test::content_of(w.directory / "out.obj"));
    CHECK(test::content_of(w.directory / "page.html").find("<title>mesh.obj</title>") != std::string::npos);
    CHECK(w.smooth("mesh.obj out.obj --time-step 1e-7 --scheme explicit --steps 300 --html page.html") == 0);
    CHECK(w.said().find("The page shows 200 of the 300 steps' surfaces") != std::string::npos);
    CHECK(w.smooth("mesh.obj out.obj --time-step 1 --steps 0 --html page.html") == 0);
    CHECK(w.smooth("mesh.obj out.obj --time-step 1 --html nowhere/page.html") == 5);
    CHECK(w.run(FIGURES " --out results --html texture") == 0);
    CHECK(test::content_of(w.directory / "results/texture.html").find("<title>Figure 10: ") != std::string::npos);
    CHECK(test::content_of(w.directory / "results/index.html").find("href=\"texture.html\"") != std::string::npos);
}

TEST_CASE("--html says what it takes where it is not built" * doctest::skip(HAS_PAGE))
{
    const Workshop w;
    CHECK(w.smooth("mesh.obj out.obj --time-step 1 --html page.html") == 2);
    CHECK(w.said().find("apt-get install nodejs npm") != std::string::npos);
    CHECK(w.run(FIGURES " --out results --html texture") == 2);
    CHECK_FALSE(w.has("out.obj"));
    CHECK_FALSE(w.has("page.html"));
}

TEST_CASE("the command in the table of a figure repeats its flow bit for bit")
{
    const Workshop w;
    REQUIRE(w.run(FIGURES " --out results texture polygons") == 0);
    int repeated = 0;
    for (const std::string figure : {"texture", "polygons"}) {
        std::ifstream table(w.directory / ("results/" + figure + ".csv"));
        std::string line;
        std::getline(table, line);
        while (std::getline(table, line)) {
            std::vector<std::string> fields;
            std::istringstream row(line);
            for (std::string field; std::getline(row, field, ',');)
                fields.push_back(field);
            const std::string& command = fields.back();
            CAPTURE(command);
            REQUIRE(command.starts_with("smooth "));
            CHECK(w.run("cd results && " SMOOTH " " + command.substr(7)) == 0);
            const Points expected =
                read_mesh(w.directory / ("results/" + figure + "-" + fields[3] + "-" + fields[4] + ".ply"))
                    .mesh.vertices;
            CHECK(read_mesh(w.directory / "results/out.ply").mesh.vertices == expected);
            ++repeated;
        }
    }
    CHECK(repeated == 12);
}

TEST_CASE("figures writes its tables, meshes and claims, and knows its figures")
{
    const Workshop w;
    CHECK(w.run(FIGURES " --out results texture") == 0);
    CHECK(w.has("results/texture-input.ply"));
    CHECK(w.count_lines("results/texture.csv", "texture,generated,3721,") == 9);
    CHECK(w.count_lines("results/claims.csv", "texture,") == 4);
    const std::string index = test::content_of(w.directory / "results/index.html");
    CHECK(index.find("<h2 id=\"figure-10\">Figure 10. ") != std::string::npos);
    CHECK(index.find("figure-9") == std::string::npos);
    CHECK(index.find("texture.html") == std::string::npos);
    // Every picture that the page shows is there, or the program says how to come to it.
    const std::string without_pictures = "The pictures were not drawn, for lack of Matplotlib: install it (Debian: "
                                         "apt-get install python3-matplotlib); python3 ";
    const bool is_drawn = w.said().find(without_pictures + "results/draw.py draws them\n") == std::string::npos;
    CHECK((index.find(without_pictures + "draw.py, run in the folder of this page, draws them<") ==
           std::string::npos) == is_drawn);
    if (!is_drawn)
        test::skip("there is no Matplotlib");
    Index shown = 0;
    for (std::size_t place = index.find("src=\""); place != std::string::npos;
         place = index.find("src=\"", place + 1)) {
        const std::size_t begin = place + 5;
        CHECK(w.has("results/" + index.substr(begin, index.find('"', begin) - begin)) == is_drawn);
        ++shown;
    }
    CHECK(shown == 12);
    CHECK(w.run(FIGURES " --out results figure-1") == 2);
    CHECK(w.said().find("there are teaser (1), ") != std::string::npos);
    CHECK(w.run(FIGURES " texture") == 2);
    CHECK(w.run(FIGURES " --out results --meshes none texture") == 3);
}

TEST_CASE("figures writes everything but the pictures where there is no Python, or none with Matplotlib")
{
    const Workshop w;
    // A python3 that has no Matplotlib, and one that is no program.
    std::filesystem::create_directories(w.directory / "bin/python3");
    std::filesystem::create_directories(w.directory / "other");
    (void)w.directory.with("other/python3", "#!/bin/sh\nexit 1\n");
    std::filesystem::permissions(w.directory / "other/python3", std::filesystem::perms::owner_all);
    for (const std::string path : {"/nonexistent", "$PWD/bin:$PWD/other"}) {
        CAPTURE(path);
        // Pictures of an earlier run, and one of another figure.
        CHECK(w.run("rm -rf results; mkdir results; touch results/schwarz-input.png results/schwarz-curves.svg "
                    "results/schwarz-width.svg results/texture-input.png") == 0);
        CHECK(w.run("PATH=" + path + " " FIGURES " --out results 5") == 0);
        const std::string remark = "The pictures were not drawn, for lack of Matplotlib: install it (Debian: apt-get "
                                   "install python3-matplotlib); python3 results/draw.py draws them\n";
        CHECK(w.said().find("\n" + remark) != std::string::npos);
        CHECK(w.said().find(remark) == w.said().rfind("The pictures were not drawn"));
        for (const char* file :
             {"schwarz.csv", "claims.csv", "schwarz-input.ply", "schwarz-cut.txt", "schwarz-ptackova-velho-schwarz.ply",
              "schwarz-ptackova-velho-undecomposed.ply", "index.html", "draw.py", "texture-input.png"}) {
            CAPTURE(file);
            CHECK(w.has(std::string("results/") + file));
        }
        CHECK(w.count_lines("results/schwarz.csv", "schwarz,generated,") == 4);
        CHECK(std::distance(fs::directory_iterator(w.directory / "results"), fs::directory_iterator()) == 9);
        const std::string index = test::content_of(w.directory / "results/index.html");
        CHECK(index.find("<p><strong>The pictures were not drawn, for lack of Matplotlib") != std::string::npos);
        CHECK(index.find("; python3 draw.py, run in the folder of this page, draws them<") != std::string::npos);
        CHECK(index.find("Schwarz has good outcomes") != std::string::npos);
    }
    CHECK(w.run("PATH=/nonexistent " FIGURES " --out \"it's here\" 5") == 0);
    CHECK(w.said().find("; python3 'it'\\''s here/draw.py' draws them\n") != std::string::npos);
}

TEST_CASE("a picture that cannot be drawn is a result that cannot be written")
{
    const Workshop w;
    std::filesystem::create_directories(w.directory / "bin");
    (void)w.directory.with("bin/python3", "#!/bin/sh\ncase $3 in --check) exit 0 ;; esac\nexit 3\n");
    std::filesystem::permissions(w.directory / "bin/python3", std::filesystem::perms::owner_all);
    CHECK(w.run("PATH=$PWD/bin " FIGURES " --out results 5") == 5);
    CHECK(w.said().find("schwarz cannot be drawn: ") != std::string::npos);
    CHECK(w.said().find("/bin/python3 results/draw.py ended with status 3") != std::string::npos);
}
