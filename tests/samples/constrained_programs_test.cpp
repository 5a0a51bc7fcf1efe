// How much to smooth, what may move, and what is wrong with a mesh: from the command line.

#include <algorithm>
#include <array>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "partition/formats/mesh_io.h"
#include "solvers/direct/factorisation.h"
#include "tests/samples/all_programs.h"
#include "tests/samples/workshop.h"
#include "tests/support/relative.h"

using namespace seamflow;
using test::Json;
using test::Workshop;

TEST_CASE("three ways to say how much to smooth say the same")
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj radius.obj --radius 5% --steps 3 --report radius.json") == 0);
    CHECK(w.said().find("5% of the diagonal") != std::string::npos);
    const Json report = w.json("radius.json");
    CHECK(report["radius"].get<double>() == test::relative(0.05 * report["diagonal"].get<double>(), 1e-5));
    for (const auto& [option, key] :
         {std::pair("--time-step ", "time_step"), {"--time-step-edges ", "time_step_edges"}}) {
        REQUIRE(w.smooth("mesh.obj other.obj --steps 3 " + std::string(option) + report[key].dump()) == 0);
        REQUIRE(w.run(COMPARE " radius.obj other.obj --report distance.json") == 0);
        CHECK(w.json("distance.json")["v_max"].get<double>() < 1e-9);
    }
}

TEST_CASE("vertices of a file stay, by their numbers or by a property")
{
    const Workshop w;
    (void)w.directory.with("fixed.txt", "100\n101 # a corner\n500\n");
    REQUIRE(w.smooth("mesh.obj held.obj --time-step-edges 5 --fix fixed.txt --report report.json") == 0);
    const PolygonMesh before = read_mesh(w.directory / "mesh.obj").mesh;
    const PolygonMesh after = read_mesh(w.directory / "held.obj").mesh;
    for (const Index v : {100, 101, 500})
        CHECK(after.vertices.row(v) == before.vertices.row(v));
    CHECK(after.vertices.row(102) != before.vertices.row(102));

    std::vector<double> mask(before.n_vertices(), 0.0);
    mask[100] = mask[101] = mask[500] = 1.0;
    const std::vector<Colour> grey(mask.size(), Colour{128, 128, 128});
    const std::vector<VertexValues> values{{"rigid", mask}};
    write_valued_ply(w.directory / "mask.ply", before, grey, values);
    REQUIRE(w.smooth("mesh.obj masked.obj --time-step-edges 5 --fix mask.ply --fix-property rigid") == 0);
    CHECK(read_mesh(w.directory / "masked.obj").mesh.vertices == after.vertices);
    CHECK(w.smooth("mesh.obj out.obj --time-step-edges 5 --fix mask.ply") == 3);
    CHECK(w.said().find("rigid") != std::string::npos);
    CHECK(w.smooth("mesh.obj out.obj --time-step-edges 5 --fix mesh.obj") == 3);
    CHECK(w.smooth("mask.ply out.ply --time-step-edges 5 --fix mask.ply --fix-property rigid") == 0);
    CHECK(w.smooth("mesh.obj out.obj --time-step-edges 5 --fix fixed.txt --report fixed.txt") == 2);
    CHECK_FALSE(w.has("out.obj"));
}

TEST_CASE("a region of a file, of another one, or of the mesh's own file is smoothed alone")
{
    const Workshop w;
    const PolygonMesh before = read_mesh(w.directory / "mesh.obj").mesh;
    std::vector<double> strength(before.n_vertices(), 0.0);
    std::string numbers;
    for (Index v = 300; v < 600; ++v) {
        strength[v] = 1.0;
        numbers += std::to_string(v) + "\n";
    }
    (void)w.directory.with("numbers.txt", numbers);
    const std::vector<Colour> grey(strength.size(), Colour{128, 128, 128});
    const std::vector<VertexValues> values{{"paint", strength}};
    write_valued_ply(w.directory / "painted.ply", before, grey, values);
    const auto result = [&](const std::string& arguments) {
        REQUIRE(w.smooth(arguments + " --time-step-edges 5 --converge 1e-8") == 0);
        return read_mesh(w.directory / arguments.substr(arguments.find("out"), 7)).mesh.vertices;
    };
    const Points after = result("mesh.obj out.obj --region numbers.txt");
    CHECK(after.topRows(300) == before.vertices.topRows(300));
    CHECK(after.bottomRows(before.n_vertices() - 600) == before.vertices.bottomRows(before.n_vertices() - 600));
    CHECK(after.middleRows(300, 300) != before.vertices.middleRows(300, 300));
    CHECK(result("mesh.obj out.obj --region painted.ply --region-property paint") == after);
    CHECK(result("painted.ply out.ply --region paint") == result("painted.ply out.ply --region numbers.txt"));
    const Points soft = result("mesh.obj out.obj --region numbers.txt --feather 10%");
    CHECK(soft.topRows(300) == before.vertices.topRows(300));
    CHECK(w.said().find("--feather") == std::string::npos);
    result("mesh.obj out.obj --region numbers.txt --feather 500%");
    CHECK(w.said().find("less deep than --feather is long") != std::string::npos);
    // The rim, beside vertex 300, is soft.
    CHECK((soft - before.vertices).middleRows(300, 25).norm() <
          0.75 * (after - before.vertices).middleRows(300, 25).norm());
    const Points along_z = result("mesh.obj out.obj --direction z");
    CHECK(along_z.leftCols(2) == before.vertices.leftCols(2));
    CHECK(along_z.col(2) != before.vertices.col(2));

    CHECK(w.smooth("mesh.obj no.obj --time-step-edges 5 --region painted.ply") == 3);
    CHECK(w.said().find("'region'") != std::string::npos);
    CHECK(w.smooth("painted.ply no.ply --time-step-edges 5 --region red") == 3);
    CHECK(w.said().find("'red' is 128; write a number from 0") != std::string::npos);
    CHECK(w.smooth("mesh.obj no.obj --time-step-edges 5 --region numbers.txt --converge never") == 2);
    CHECK(w.said().find("--region is given, whose steps are converged or undecomposed, but --converge never is") !=
          std::string::npos);
    CHECK_FALSE(w.has("no.obj"));
}

TEST_CASE("rims draw in where they are free, and the size stays where that is asked for")
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj free.obj --radius 10% --boundary free --rescale area --report report.json") == 0);
    CHECK(w.json("report.json")["fixed_vertices"].get<int>() == 0);
    CHECK(w.smooth("mesh.obj out.obj --radius 10% --rescale area") == 3);
    CHECK(w.said().find("held fixed") != std::string::npos);
    CHECK(w.smooth("mesh.obj out.obj --radius 10% --rescale volume --boundary free") == 3);
    CHECK(w.said().find("closed") != std::string::npos);
    (void)w.directory.with("some.txt", "1\n");
    CHECK(w.smooth("mesh.obj out.obj --radius 10% --rescale area --fix some.txt") == 2);
    CHECK(w.said().find("--filter low-pass") != std::string::npos);
    CHECK_FALSE(w.has("out.obj"));
}

namespace {

/// A tetrahedron of four faces that share no vertices.
std::string loose_tetrahedron(double gap)
{
    const std::vector<std::vector<int>> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const std::vector<std::array<double, 3>> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::string text;
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (const int corner : faces[f]) {
            const auto& p = corners[static_cast<std::size_t>(corner)];
            text += "v " + std::to_string(p[0] + gap * static_cast<double>(f)) + " " + std::to_string(p[1]) + " " +
                    std::to_string(p[2]) + "\n";
        }
    return text + "f 1 2 3\nf 4 5 6\nf 7 8 9\nf 10 11 12\n";
}

}  // namespace

TEST_CASE("a surface whose file doubles vertices along seams is smoothed as the closed one that it is")
{
    const Workshop w;
    (void)w.directory.with("seams.obj", loose_tetrahedron(0.0));
    REQUIRE(w.run(INSPECT " seams.obj") == 0);
    CHECK(w.said().find("6 pairs of boundary edges") != std::string::npos);
    REQUIRE(w.run(INSPECT " seams.obj --json") == 0);
    CHECK(Json::parse(w.said())["seam_vertices"] == 12);
    REQUIRE(w.smooth("seams.obj out.obj --time-step .01 --report report.json") == 0);
    CHECK(w.said().find("12 vertices along seams") != std::string::npos);
    const Json report = w.json("report.json");
    CHECK(report["surface"]["before"]["volume"].get<double>() == test::relative(1.0 / 6.0, 1e-5));
    CHECK(report["surface"]["before"]["roughness_rms"].get<double>() > 90.0);
    CHECK(report["fixed_vertices"] == 0);
    const Points moved = read_mesh(w.directory / "out.obj").mesh.vertices;
    REQUIRE(moved.rows() == 12);
    CHECK(moved.row(0) == moved.row(3));
    CHECK(moved(0, 0) > 0.0);
    REQUIRE(w.smooth("seams.obj out.obj --time-step .01 --weld never --report report.json") == 0);
    CHECK(w.json("report.json")["fixed_vertices"] == 12);
    CHECK(w.json("report.json")["surface"]["before"]["volume"].is_null());

    (void)w.directory.with("gaps.obj", loose_tetrahedron(1e-5));
    REQUIRE(w.smooth("gaps.obj out.obj --time-step .01 --report report.json") == 0);
    CHECK(w.json("report.json")["fixed_vertices"] == 12);
    for (const char* within : {"1e-4", "0.01%"}) {
        REQUIRE(w.smooth("gaps.obj out.obj --time-step .01 --report report.json --weld " + std::string(within)) == 0);
        CHECK(w.json("report.json")["fixed_vertices"] == 0);
    }
    CHECK(w.smooth("gaps.obj out.obj --time-step .01 --weld sometimes") == 2);
}

TEST_CASE("normals stay continuous across gaps that --weld closes")
{
    const Workshop w;
    const MeshFile file = read_mesh(w.directory.with("gaps.obj", loose_tetrahedron(1e-5)));
    std::ostringstream text;
    text << "NOFF\n12 4 0\n";
    for (Index v = 0; v < 12; ++v)
        text << file.mesh.vertices.row(v) << ' ' << (file.mesh.vertices.row(v).array() - 0.25).matrix().normalized()
             << '\n';
    (void)w.directory.with("gaps.off", text.str() + "3 0 1 2\n3 3 4 5\n3 6 7 8\n3 9 10 11\n");
    // Vertices that stay do not come together.
    (void)w.directory.with("stay", "0\n");
    REQUIRE(w.smooth("gaps.off out.off --weld 1e-4 --fix stay --time-step .01 --every-step step%d.off") == 0);
    for (const std::string name : {"out.off", "step1.off"}) {
        std::istringstream lines(test::content_of(w.directory / name));
        std::string word;
        lines >> word >> word >> word >> word;
        Eigen::Matrix<double, 12, 6> numbers;
        for (Index v = 0; v < 12; ++v)
            for (Index k = 0; k < 6; ++k)
                lines >> numbers(v, k);
        // Copies of one corner.
        CHECK((numbers.row(0) - numbers.row(3)).tail<3>().norm() < 1e-3);
        CHECK((numbers.row(0) - numbers.row(3)).head<3>().norm() > 1e-6);
    }
}

TEST_CASE("sheets that meet flow unless they are to be held, and the report counts their vertices")
{
    const Workshop w;
    // Three tetrahedra around an edge.
    (void)w.directory.with("cells.obj", "v 0 0 1\nv 0 0 -1\nv 1 0 0\nv -.5 .8 0\nv -.5 -.8 0\n"
                                        "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 3 4\nf 1 4 5\nf 1 5 3\n"
                                        "f 2 4 3\nf 2 5 4\nf 2 3 5\n");
    REQUIRE(w.smooth("cells.obj out.obj --time-step .01 --report report.json") == 0);
    CHECK(w.said().find("5 vertices on edges of three faces or more flow") != std::string::npos);
    CHECK(w.json("report.json")["junction_vertices"] == 5);
    CHECK(w.json("report.json")["non_manifold_vertices"] == 0);
    CHECK(w.json("report.json")["surface"]["before"]["volume"].is_null());
    REQUIRE(w.smooth("cells.obj out.obj --time-step .01 --junctions hold --report report.json") == 0);
    CHECK(w.json("report.json")["junction_vertices"] == 0);
    CHECK(w.json("report.json")["non_manifold_vertices"] == 5);
}

TEST_CASE("the manual page and what shells complete have every option that --help-all has")
{
    const Workshop w;
    for (const std::string program : {SMOOTH, COMPARE, GENERATE, INSPECT}) {
        REQUIRE(w.run(program + " --help-man") == 0);
        const std::string manual = w.said();
        REQUIRE(w.run(program + " --help-bash") == 0);
        const std::string for_bash = w.said();
        REQUIRE(w.run(program + " --help-zsh") == 0);
        const std::string for_zsh = w.said();
        REQUIRE(w.run(program + " --help-all") == 0);
        const std::string help = w.said();
        int n_options = 0;
        for (std::size_t begin = help.find(" --"); begin != std::string::npos; begin = help.find(" --", begin + 1)) {
            const std::string name = help.substr(begin + 1, help.find_first_of(" ,\n", begin + 1) - begin - 1);
            // Where it is listed, not where it is spoken of.
            if (help.find_last_not_of(' ', begin) != help.rfind('\n', begin) && help[begin - 1] != ',')
                continue;
            CAPTURE(name);
            ++n_options;
            std::string in_manual = "\\fB\\&";
            for (const char c : name)
                in_manual += c == '-' ? "\\-" : std::string(1, c);
            CHECK(manual.find(in_manual + "\\fR") != std::string::npos);
            CHECK(for_bash.find(name) != std::string::npos);
            CHECK(for_zsh.find("'" + name) != std::string::npos);
        }
        CHECK(n_options >= 2);
    }
    // Words are completed, by the shell itself.
    (void)w.directory.with("try.bash", "eval \"$(" SMOOTH " --help-bash)\"\n"
                                       "COMP_WORDS=(smooth --laplacian vir); COMP_CWORD=2; _seamflow_smooth\n"
                                       "COMP_WORDS=(smooth --filter = lo); COMP_CWORD=3; words=\"$COMPREPLY\"\n"
                                       "_seamflow_smooth; echo \"$words $COMPREPLY\"\n");
    REQUIRE(w.run("bash try.bash") == 0);
    CHECK(w.said() == "virtual-refinement low-pass\n");
}

TEST_CASE("the help has examples first, then a line for each option in the order of use; the manual has the rest")
{
    const Workshop w;
    for (const std::string& program : test::all_programs()) {
        CAPTURE(program);
        REQUIRE(w.run(program + " --help-all") == 0);
        const std::string help = w.said();
        std::istringstream lines(help);
        for (std::string line; std::getline(lines, line);) {
            CAPTURE(line);
            // Of characters, whose first bytes are counted.
            CHECK(std::ranges::count_if(line, [](char c) { return (c & '\xc0') != '\x80'; }) <= 160);
        }
        const auto examples = help.find("\nExamples:\n  ");
        REQUIRE(examples != std::string::npos);
        CHECK(examples < help.find("  --"));
        const std::string name = program.substr(program.rfind('/') + 1);
        const std::string begin = std::string("\n  ").append(name).append(" ");
        std::size_t n_examples = 0;
        for (auto at = help.find(begin); at != std::string::npos; at = help.find(begin, at + 1))
            ++n_examples;
        CHECK(n_examples == 3);
        REQUIRE(w.run(program + " --help-man") == 0);
        const std::string manual = w.said();
        std::size_t last = 0;
        for (const char* section : {"NAME", "SYNOPSIS", "EXAMPLES", "OPTIONS", "EXIT STATUS", "FILES", "SEE ALSO"}) {
            CAPTURE(section);
            const auto at = manual.find(std::string(".SH ").append(section).append("\n"));
            REQUIRE(at != std::string::npos);
            CHECK(at >= last);
            last = at;
        }
        CHECK(manual.find(std::string("\\fB\\&").append(name).append("\\fR(1)")) == std::string::npos);
    }
    REQUIRE(w.run(SMOOTH " --help-all") == 0);
    const std::string help = w.said();
    std::size_t last = 0;
    for (const char* group : {"How much is smoothed", "What kind of mesh", "What stays", "What is written", "Accuracy",
                              "Sub-meshes", "Machine", "Options"}) {
        CAPTURE(group);
        const auto at = help.find(std::string("\n").append(group).append(":\n  -"));
        REQUIRE(at != std::string::npos);
        CHECK(at > last);
        last = at;
    }
    CHECK(help.find("\n  --keep-edges NUMBER ") > help.find("What stays"));
    CHECK(help.find("\n  --keep-edges NUMBER ") < help.find("What is written"));
    CHECK(help.find("as much as there is noise, or") == std::string::npos);
    REQUIRE(w.run(SMOOTH " --help-man") == 0);
    CHECK(w.said().find("as much as there is noise, or") != std::string::npos);
}

TEST_CASE("the help of smooth fits a screen, and names what lists all options")
{
    const Workshop w;
    REQUIRE(w.run(SMOOTH " --help-all") == 0);
    const std::string all = w.said();
    REQUIRE(w.run(SMOOTH " --help") == 0);
    const std::string help = w.said();
    CHECK(std::ranges::count(help, '\n') <= 32);
    CHECK(help.find("smooth --help-all lists all options") != std::string::npos);
    std::istringstream lines(help.substr(help.find("Options that most people need")));
    int n_options = 0;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("  --")) {
            CAPTURE(line);
            ++n_options;
            CHECK(all.find("\n" + line + "\n") != std::string::npos);
        }
    CHECK(n_options == 12);
}

TEST_CASE("the examples of the help are accepted as they stand")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere scan.obj --vertices 800") == 0);
    REQUIRE(w.run(GENERATE " noisy-sphere scan.ply --vertices 800") == 0);
    REQUIRE(w.run(GENERATE " gear part.stl --vertices 800") == 0);
    for (const std::string program : {SMOOTH, INSPECT, GENERATE}) {
        REQUIRE(w.run(program + " --help-all") == 0);
        std::istringstream lines(w.said());
        int n = 0;
        for (std::string line; std::getline(lines, line);) {
            const std::string name = program.substr(program.rfind('/') + 1);
            if (!line.starts_with(std::string("  ").append(name).append(" ")))
                continue;
            ++n;
            const auto begin = 2 + name.size();
            const std::string arguments = line.substr(begin, line.find("   ", begin) - begin);
            CAPTURE(arguments);
            CHECK(w.run("(" + program + arguments + ")") == 0);
        }
        CHECK(n == 3);
    }
}

TEST_CASE("--paper is --plain, and the paper's conditions without it get one remark")
{
    const Workshop w;
    const std::string flow = " --radius 3% --subdomains 5 ";
    REQUIRE(w.smooth("mesh.obj plain.obj --plain" + flow) == 0);
    REQUIRE(w.smooth("mesh.obj paper.obj --paper --conditions adapted-robin" + flow) == 0);
    CHECK(w.said().find("not the paper's own method") == std::string::npos);
    CHECK(w.run("cmp plain.obj paper.obj") == 0);
    REQUIRE(w.smooth("mesh.obj other.obj --conditions adapted-robin" + flow) == 0);
    CHECK(w.count_lines("said", "remark     --conditions adapted-robin alone is not the paper's own method") == 1);
    CHECK(w.run("cmp -s plain.obj other.obj") == 1);
}

TEST_CASE("--reference gives the distances that compare gives, and --csv has them step by step")
{
    const Workshop w;
    const std::string flow = "--time-step-edges 3 --steps 3 ";
    REQUIRE(w.smooth("mesh.obj parts.obj --subdomains 7 --converge never --reference --csv steps.csv --report r.json " +
                     flow) == 0);
    CHECK(w.said().find("H_mean ") != std::string::npos);
    REQUIRE(w.smooth("mesh.obj whole.obj --subdomains 1 " + flow) == 0);
    REQUIRE(w.run(COMPARE " whole.obj parts.obj --report distance.json") == 0);
    const Json last = w.json("r.json")["steps"][2];
    const Json distance = w.json("distance.json");
    for (const char* key : {"v_mean", "v_max", "h_mean", "h_rms", "h_max"}) {
        CAPTURE(key);
        CHECK(last[key].get<double>() == test::relative(distance[key].get<double>(), 1e-6));
    }
    REQUIRE(w.run(COMPARE " parts.obj whole.obj --report distance.json") == 0);
    CHECK(last["h_mean"].get<double>() != test::relative(w.json("distance.json")["h_mean"].get<double>(), 1e-4));
    CHECK(w.count_lines("steps.csv", "step,p_smallest,p_largest,seconds,") == 1);
    for (const char* step : {"1,", "2,", "3,"})
        CHECK(w.count_lines("steps.csv", step) == 1);
    CHECK(w.smooth("mesh.obj out.obj --csv nowhere/steps.csv " + flow) == 5);
    CHECK(w.smooth("mesh.obj out.obj --csv out.obj " + flow) == 2);
}

TEST_CASE("inspect names what is wrong, and ends with 3 for a file that cannot be used as it is")
{
    const Workshop w;
    REQUIRE(w.run(INSPECT " mesh.obj") == 0);
    CHECK(w.said().find("nothing wrong was found") != std::string::npos);
    (void)w.directory.with("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 nan\nv 0 1 0\nv 0 1 0\nf 1 2 4\nf 1 4 2\nf 1 2\n");
    CHECK(w.run(INSPECT " bad.obj") == 3);
    CHECK(w.said().find("bad.obj:8: the face has 2 corners") != std::string::npos);
    CHECK(w.said().find("faces with the same vertices as an earlier face (1): 1") != std::string::npos);
    REQUIRE(w.run(INSPECT " bad.obj --json") == 3);
    const Json found = Json::parse(w.said());
    CHECK(found["faults"] == 2);
    CHECK(found["vertices_not_finite"] == Json{2});
    CHECK(found["coincident_vertices"] == Json{4});
    CHECK(found["duplicate_faces"] == Json{1});
    CHECK(found["isolated_vertices"] == Json{2, 4});
    CHECK(w.run(INSPECT) == 2);
    CHECK(w.run(INSPECT " none.obj") == 3);
}

TEST_CASE("what standard output could not take ends with 5; every program knows its version and licence")
{
    const Workshop w;
    CHECK(w.run("( " INSPECT " mesh.obj --json >/dev/full )") == 5);
    CHECK(w.said().find("standard output") != std::string::npos);
    for (const std::string& program : test::all_programs()) {
        CHECK(w.run(program + " --version") == 0);
        CHECK(w.said().starts_with("seamflow "));
        CHECK((w.said().find("GPL") != std::string::npos) == !gpl_parts().empty());
        CHECK(w.said().find("MIT licence") != std::string::npos);
    }
}

TEST_CASE("a degenerate mesh flows but for its degenerate vertices, or is refused where that is asked for")
{
    const Workshop w;
    // Two rows of four squares: of the three inner vertices the first two are in one place.
    (void)w.directory.with(
        "flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\nv 0 1 0\nv 1 1 .3\nv 1 1 .3\nv 3 1 .3\nv 4 1 0\n"
                    "v 0 2 0\nv 1 2 0\nv 2 2 0\nv 3 2 0\nv 4 2 0\n"
                    "f 1 2 7 6\nf 2 3 8 7\nf 3 4 9 8\nf 4 5 10 9\nf 6 7 12 11\nf 7 8 13 12\nf 8 9 14 13\n"
                    "f 9 10 15 14\n");
    REQUIRE(w.smooth("flat.obj flowed.obj --time-step 0.01") == 0);
    CHECK(w.said().find("2 vertices are held fixed") != std::string::npos);
    const Points before = read_mesh(w.directory / "flat.obj").mesh.vertices;
    const Points after = read_mesh(w.directory / "flowed.obj").mesh.vertices;
    REQUIRE(after.rows() == before.rows());
    CHECK(after.row(8) != before.row(8));
    CHECK(after.topRows(8) == before.topRows(8));
    CHECK(after.bottomRows(6) == before.bottomRows(6));

    CHECK(w.smooth("flat.obj out.obj --time-step 0.01 --strict") == 3);
    CHECK_FALSE(w.has("out.obj"));
    CHECK(w.smooth("mesh.obj out.obj --time-step 0.01 --strict") == 0);
}

TEST_CASE("sheets that meet are generated with the cells of their faces, and smooth reports the volumes of cells")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " bubbles-quads bubbles.ply --vertices 2000") == 0);
    REQUIRE(w.run(GENERATE " bubbles-quads bubbles.off --vertices 2000") == 0);
    CHECK(read_mesh(w.directory / "bubbles.off").mesh.vertices == read_mesh(w.directory / "bubbles.ply").mesh.vertices);
    REQUIRE(w.smooth("bubbles.ply out.ply --time-step-edges 1 --report report.json") == 0);
    CHECK(w.said().find("cells      3 cells: volume 0.0") != std::string::npos);
    for (const char* property : {"property int front", "property int back"})
        CHECK(w.count_lines("out.ply", property) == 1);
    const Json surface = w.json("report.json")["surface"];
    CHECK(surface["before"]["volume"].is_null());
    const auto before = surface["before"]["cell_volumes"].get<std::vector<double>>();
    const auto after = surface["after"]["cell_volumes"].get<std::vector<double>>();
    REQUIRE(before.size() == 3);
    REQUIRE(after.size() == 3);
    CHECK(std::ranges::is_sorted(before, std::greater<>()));
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(after[c] < before[c]);
        CHECK(after[c] > 0.8 * before[c]);
    }
    REQUIRE(w.smooth("bubbles.ply out.ply --time-step-edges 200 --junctions hold") == 0);
    CHECK(w.said().find("cells      3 cells") != std::string::npos);
    CHECK(w.said().find("of 3 cells have lost more than 20% of their volume") != std::string::npos);
    // Sheets that enclose nothing, and a surface without junctions.
    REQUIRE(w.run(GENERATE " plates plates.ply --vertices 2000") == 0);
    for (const char* mesh : {"plates.ply", "mesh.obj"}) {
        REQUIRE(w.smooth(std::string(mesh) + " out.ply --time-step-edges 1 --report report.json") == 0);
        CHECK(w.said().find("cells") == std::string::npos);
        CHECK_FALSE(w.json("report.json")["surface"]["before"].contains("cell_volumes"));
    }
    CHECK(w.run(GENERATE " foam foam.ply --vertices 500") == 2);
}
