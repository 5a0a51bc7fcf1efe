// smooth-distributed on ranks of MPI, beside smooth.

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/samples/ranks.h"
#include "tests/samples/workshop.h"

using namespace seamflow;
using test::messages;
using test::on_ranks;
using test::Workshop;
using test::write_labels_of;
namespace fs = std::filesystem;

namespace {

/// Writes an OBJ file in which every face has vertices of its own.
void write_soup(const fs::path& from, const fs::path& to)
{
    std::ifstream file(from);
    std::ofstream soup(to);
    std::vector<std::string> vertices;
    std::size_t n = 0;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("v "))
            vertices.push_back(line);
        if (!line.starts_with("f "))
            continue;
        std::istringstream corners(line.substr(2));
        std::string face = "f";
        for (std::size_t v = 0; corners >> v;) {
            soup << vertices.at(v - 1) << '\n';
            face.append(" ").append(std::to_string(++n));
        }
        soup << face << '\n';
    }
}

}  // namespace

TEST_CASE("the file is the same for any number of ranks, and that of smooth with the same cut")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere ball.ply --vertices 9000") == 0);
    REQUIRE(w.run(GENERATE " noisy-sphere ball.stl --vertices 2000") == 0);
    REQUIRE(w.run(GENERATE " noisy-sphere ball.off --vertices 2000") == 0);
    for (const std::string name : {"mesh.obj", "ball.ply", "ball.stl", "ball.off"}) {
        CAPTURE(name);
        const std::string options = " --time-step-edges 3 --steps 3 --converge never --threads 1";
        const std::string extension = name.substr(4);
        REQUIRE(on_ranks(w, 1, name + " 1" + extension + options + " --subdomains 9 --parts cut.ply") == 0);
        write_labels_of(w.directory / "cut.ply", w.directory / "labels");
        const std::string expected = test::content_of(w.directory / ("1" + extension));
        const std::string cut = test::content_of(w.directory / "cut.ply");
        REQUIRE(w.smooth(name + " s" + extension + options + " --labels labels") == 0);
        CHECK((test::content_of(w.directory / ("s" + extension)) == expected));
        for (const int n : {2, 3, 5}) {
            CAPTURE(n);
            REQUIRE(on_ranks(w, n, name + " n" + extension + options + " --subdomains 9 --parts cut.ply") == 0);
            CHECK((test::content_of(w.directory / ("n" + extension)) == expected));
            CHECK((test::content_of(w.directory / "cut.ply") == cut));
            // In slices.
            const std::string by_slices = " --labels labels --parts cut.ply --whole-up-to 1";
            REQUIRE(on_ranks(w, n, name + " n" + extension + options + by_slices) == 0);
            CHECK((test::content_of(w.directory / ("n" + extension)) == expected));
            CHECK((test::content_of(w.directory / "cut.ply") == cut));
        }
    }
}

TEST_CASE("vertices that are fixed stay, on whichever rank they are")
{
    const Workshop w;
    REQUIRE(w.run("sh -c 'seq 100 3 700 > stay; seq 0 2000 | awk \"{print int(\\$1 / 80)}\" > labels'") == 0);
    REQUIRE(w.run("sh -c 'head -n $(grep -c ^f mesh.obj) labels > cut'") == 0);
    const std::string options = " --radius 2% --fix stay --labels cut --converge never --threads 1";
    REQUIRE(w.smooth("mesh.obj s.obj" + options) == 0);
    REQUIRE(on_ranks(w, 3, "mesh.obj n.obj" + options) == 0);
    CHECK((test::content_of(w.directory / "n.obj") == test::content_of(w.directory / "s.obj")));
}

TEST_CASE("the report tells of every rank, and rank 0 alone prints")
{
    const Workshop w;
    REQUIRE(on_ranks(w, 3, "mesh.obj n.off --radius 2% --steps 2 --subdomains 6 --report r.json --verbose") == 0);
    for (const std::string line : {"input ", "amount ", "step 1 of 2 ", "step 2 of 2 ", "cut ", "time ", "result "})
        CHECK(w.count_lines("said", line) == 1);
    const test::Json report = w.json("r.json");
    CHECK(report["subdomains"] == 6);
    CHECK(report["steps"].size() == 2);
    REQUIRE(report["ranks"].size() == 3);
    for (const test::Json& rank : report["ranks"]) {
        CHECK(rank["vertices"] > 0);
        CHECK(rank["messages"] > 0);
    }
    REQUIRE(w.smooth("mesh.obj s.off --radius 2% --steps 2 --report s.json") == 0);
    for (const std::string name : {"mean_edge", "diagonal", "time_step", "radius"})
        CHECK(report[name] == w.json("s.json")[name]);
}

TEST_CASE("what ranks measure is what smooth measures, and remarks come once")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere ball.off --vertices 3000") == 0);
    const std::string options = " --radius 12% --steps 3 --converge 1e-6 --threads 1 --verbose";
    REQUIRE(on_ranks(w, 1, "ball.off 1.off --subdomains 7 --parts cut.ply" + options) == 0);
    write_labels_of(w.directory / "cut.ply", w.directory / "labels");
    REQUIRE(w.smooth("ball.off s.off --labels labels --report s.json" + options) == 0);
    const test::Json expected = w.json("s.json");
    for (const int n : {1, 2, 3}) {
        CAPTURE(n);
        REQUIRE(on_ranks(w, n, "ball.off n.off --labels labels --report n.json" + options) == 0);
        CHECK((test::content_of(w.directory / "n.off") == test::content_of(w.directory / "s.off")));
        CHECK(w.count_lines("said", "step ") == 3);
        CHECK(w.count_lines("said", "remark     The surface has lost ") == 1);
        CHECK(w.said().find(", volume ") != std::string::npos);
        CHECK(w.said().find("; by estimate ") != std::string::npos);
        const test::Json report = w.json("n.json");
        for (const std::string name : {"tolerance", "steps_short_of_tolerance", "steps_stagnated",
                                       "non_manifold_vertices", "attachment_weights"})
            CHECK(report[name] == expected[name]);
        for (const std::string when : {"before", "after"})
            for (const std::string name : {"area", "volume"})
                CHECK(report["surface"][when][name].get<double>() ==
                      doctest::Approx(expected["surface"][when][name].get<double>()).epsilon(1e-12));
        for (const std::string name : {"moved_mean", "moved_rms", "moved_max", "moved_max_absolute"})
            CHECK(report["surface"][name].get<double>() ==
                  doctest::Approx(expected["surface"][name].get<double>()).epsilon(1e-12));
        REQUIRE(report["steps"].size() == 3);
        for (std::size_t i = 0; i < 3; ++i) {
            const test::Json& step = report["steps"][i];
            CHECK(step["iterations"] == expected["steps"][i]["iterations"]);
            CHECK(step["residual"] == expected["steps"][i]["residual"]);
            CHECK(step["moved_mean"].get<double>() > 0.0);
            CHECK(step["estimated_v_max"].get<double>() ==
                  doctest::Approx(expected["steps"][i]["estimated_v_max"].get<double>()).epsilon(1e-9));
        }
    }
}

TEST_CASE("rims move freely, vertices are attached by weights, and every step is written, as with smooth")
{
    const Workshop w;
    write_soup(w.directory / "mesh.obj", w.directory / "soup.obj");
    for (const std::string mesh : {"mesh.obj", "soup.obj"}) {
        CAPTURE(mesh);
        const std::ptrdiff_t n_faces = w.count_lines(mesh, "f ");
        std::ofstream labels(w.directory / "labels");
        for (std::ptrdiff_t f = 0; f < n_faces; ++f)
            labels << 8 * f / n_faces << '\n';
        labels.close();
        std::ofstream weights(w.directory / "weights");
        for (std::ptrdiff_t v = w.count_lines(mesh, "v "); v > 0; --v)
            weights << v * 37 % 101 << '\n';
        weights.close();
        for (const std::string options : {" --boundary free --converge 1e-6", " --converge never"}) {
            CAPTURE(options);
            const std::string all =
                options + " --labels labels --radius 2% --steps 3 --attach-weights weights --threads 1 --every-step ";
            REQUIRE(w.smooth(mesh + " s.obj" + all + "s%d.obj") == 0);
            for (const int n : {1, 2, 3}) {
                CAPTURE(n);
                REQUIRE(on_ranks(w, n, mesh + " n.obj" + all + "n%d.obj") == 0);
                for (const std::string step : {"", "1", "2", "3"})
                    CHECK((test::content_of(w.directory / ("n" + step + ".obj")) ==
                           test::content_of(w.directory / ("s" + step + ".obj"))));
            }
        }
    }
    CHECK(on_ranks(w, 2, "mesh.obj n.obj --radius 2% --boundary free") == 2);
    REQUIRE(messages(w, "smooth-distributed").size() == 1);
    CHECK(messages(w, "smooth-distributed").front().find("add --approach converged") != std::string::npos);
}

TEST_CASE("a tolerance that steps miss is told of as by smooth")
{
    const Workshop w;
    const std::string options = " --radius 2% --steps 2 --subdomains 5 --converge 1e-100 --threads 1";
    REQUIRE(w.smooth("mesh.obj s.obj" + options) == 4);
    const auto expected = messages(w, "smooth");
    REQUIRE(expected.size() == 1);
    CHECK(w.count_lines("said", "remark     The tolerance was not reached in 2 steps") == 1);
    REQUIRE(on_ranks(w, 3, "mesh.obj s.obj" + options) == 4);
    CHECK(messages(w, "smooth-distributed") == expected);
    CHECK(w.count_lines("said", "remark     The tolerance was not reached in 2 steps") == 1);
}

TEST_CASE("a run goes on from its checkpoint on any number of ranks, with the same bytes")
{
    const Workshop w;
    write_soup(w.directory / "mesh.obj", w.directory / "soup.obj");
    {
        std::ifstream near(w.directory / "mesh.obj");
        std::ofstream far(w.directory / "far.obj");
        far.precision(17);
        for (std::string line; std::getline(near, line);) {
            std::istringstream words(line);
            std::string word;
            double x = 0.0;
            if (words >> word; word == "v" && words >> x)
                far << "v " << x + 1000.0 << words.str().substr(static_cast<std::size_t>(words.tellg())) << '\n';
            else
                far << line << '\n';
        }
    }
    REQUIRE(w.run(GENERATE " noisy-sphere ball.ply --vertices 9000") == 0);
    for (const std::string input :
         {"soup.obj n.obj", "far.obj n.obj --attach 5% --filter low-pass", "ball.ply n.ply --whole-up-to 1",
          "mesh.obj n.obj --flow conformalized --sweep alternating"}) {
        CAPTURE(input);
        const std::string result = input.substr(input.find(' ') + 1, 5);
        const std::string flow = input + " --time-step-edges 3 --subdomains 7 --converge never --threads 1 --steps ";
        REQUIRE(on_ranks(w, 2, flow + "5") == 0);
        const std::string expected = test::content_of(w.directory / result);
        fs::remove_all(w.directory / "c");
        REQUIRE(on_ranks(w, 3, flow + "2 --checkpoint c") == 0);
        CHECK((test::content_of(w.directory / result) != expected));
        REQUIRE(on_ranks(w, 2, flow + "4 --checkpoint c --checkpoint-every 3") == 0);
        CHECK(w.count_lines("said", "resumed    after step 2, from c/smooth-distributed.checkpoint") == 1);
        REQUIRE(on_ranks(w, 1, flow + "5 --checkpoint c --report r.json --every-step s%d.ply") == 0);
        CHECK(w.count_lines("said", "resumed    after step 4, ") == 1);
        CHECK(w.count_lines("said", "remark     --every-step has no files of the steps up to 4, ") == 1);
        CHECK((test::content_of(w.directory / result) == expected));
        const double area = w.json("r.json")["surface"]["after"]["area"];
        // Nothing is left to do, and nothing of earlier steps remains.
        REQUIRE(on_ranks(w, 3, flow + "5 --checkpoint c --report r.json") == 0);
        CHECK((test::content_of(w.directory / result) == expected));
        CHECK(w.json("r.json")["surface"]["after"]["area"].get<double>() == doctest::Approx(area).epsilon(1e-12));
        CHECK(std::distance(fs::directory_iterator(w.directory / "c"), {}) == 2);
    }
}

TEST_CASE("a checkpoint that belongs to another run of ranks, or is damaged, is refused with what to do")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " mixed other.obj --vertices 900 --seed 2") == 0);
    const std::string flow = "--time-step-edges 3 --converge never --threads 1 --checkpoint c";
    REQUIRE(on_ranks(w, 2, "mesh.obj n.obj --subdomains 5 --steps 3 " + flow) == 0);
    const std::string kept = test::content_of(w.directory / "n.obj");
    const auto refused = [&](const std::string& arguments, int status, const std::string& what) {
        CAPTURE(arguments);
        CHECK(on_ranks(w, 3, arguments + " " + flow) == status);
        const auto said = messages(w, "smooth-distributed");
        REQUIRE(said.size() == 1);
        CHECK(said.front().find(what) != std::string::npos);
        CHECK(said.front().find("to begin anew") != std::string::npos);
        CHECK((test::content_of(w.directory / "n.obj") == kept));
    };
    refused("mesh.obj n.obj --subdomains 5 --steps 2", 2, "is after step 3, but steps is 2");
    refused("mesh.obj n.obj --subdomains 4 --steps 4", 2, "subdomains was 5 then and is 4 now");
    refused("mesh.obj n.obj --subdomains 5 --steps 4 --attach 3%", 2, "attachment was 0 then");
    refused("other.obj n.obj --subdomains 5 --steps 4", 3, "the mesh was ");
    const fs::path folder = w.directory / "c";
    const std::string list = test::content_of(folder / "smooth-distributed.checkpoint");
    std::string changed = list;
    changed[changed.find("step 3") + 5] = '2';
    std::ofstream(folder / "smooth-distributed.checkpoint") << changed;
    refused("mesh.obj n.obj --subdomains 5 --steps 4", 3, "has been changed since it was written");
    std::ofstream(folder / "smooth-distributed.checkpoint") << list;
    std::string positions = test::content_of(folder / "smooth-distributed.step-3.1");
    if (positions.empty())
        positions = test::content_of(folder / "smooth-distributed.step-3.0");
    positions[positions.size() / 2] = static_cast<char>(positions[positions.size() / 2] ^ 1);
    for (const std::string rank : {"0", "1"})
        if (fs::file_size(folder / ("smooth-distributed.step-3." + rank)) > 0)
            std::ofstream(folder / ("smooth-distributed.step-3." + rank), std::ios::binary) << positions;
    refused("mesh.obj n.obj --subdomains 5 --steps 4", 3, "smooth-distributed.step-3.");
    fs::remove_all(folder);
    CHECK(on_ranks(w, 2, "mesh.obj n.obj --radius 1% --converge 1e-3 --checkpoint c") == 2);
    REQUIRE(messages(w, "smooth-distributed").size() == 1);
    CHECK(messages(w, "smooth-distributed").front().starts_with("ranks keep checkpoints of sweeps alone"));
}

TEST_CASE("what cannot be done is said once, with the exit status of smooth, and nothing is written")
{
    const Workshop w;
    std::ofstream(w.directory / "far.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n";
    std::ofstream(w.directory / "nan.obj") << "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n";
    std::ofstream(w.directory / "short.ply") << "ply\nformat ascii 1.0\nelement vertex 3\n";
    std::ofstream(w.directory / "empty.stl");
    std::ofstream(w.directory / "letters") << "0\none\n";
    for (const std::string arguments :
         {"far.obj n.obj --radius 1%", "nan.obj n.obj --radius 1%", "short.ply n.ply --radius 1%",
          "empty.stl n.stl --radius 1%", "missing.obj n.obj --radius 1%", "mesh.xyz n.obj --radius 1%",
          "mesh.obj n.obj --radius 1% --labels letters", "mesh.obj n.obj --radius 1% --fix letters",
          "mesh.obj nowhere/n.obj --radius 1%", "mesh.obj n.stl --radius 1%", "mesh.obj n.obj --radius 0",
          "mesh.obj n.obj --radius 1% --time-step 1", "mesh.obj n.obj --radius 1% --steps -1"}) {
        CAPTURE(arguments);
        const int status = w.smooth(arguments);
        CHECK(status > 0);
        const auto expected = messages(w, "smooth");
        CHECK(on_ranks(w, 3, arguments) == status);
        CHECK(messages(w, "smooth-distributed") == expected);
        CHECK(!w.has("n.obj"));
    }
}

TEST_CASE("options of smooth that ranks do not know are refused by name")
{
    const Workshop w;
    for (const std::string option : {"--html p.html", "--keep-edges 30", "--reference", "--rescale area", "--strict",
                                     "--scheme explicit", "--trace t.json", "--preset fair"}) {
        CAPTURE(option);
        // MPI takes a program that is started alone as one rank.
        CHECK(w.run(SMOOTH_DISTRIBUTED " mesh.obj n.obj --radius 1% " + option) == 2);
        const auto said = messages(w, "smooth-distributed");
        REQUIRE(said.size() == 1);
        CHECK(said.front().starts_with("smooth-distributed has no " + option.substr(0, option.find(' ')) + ": "));
    }
    CHECK(on_ranks(w, 2, "mesh.obj n.obj") == 2);
    REQUIRE(messages(w, "smooth-distributed").size() == 1);
    CHECK(messages(w, "smooth-distributed").front().starts_with("say how much to smooth by --time-step"));
    CHECK(!w.has("n.obj"));
}

TEST_CASE("a rank that is killed ends the others, and the file that was there stays")
{
    const Workshop w;
    std::ofstream(w.directory / "n.obj") << "as it was\n";
    std::ofstream(w.directory / "rank.sh")
        << "echo $$ >pid.$OMPI_COMM_WORLD_RANK\n"
           "exec " SMOOTH_DISTRIBUTED " mesh.obj n.obj --radius 1% --steps 1000000 --subdomains 6 --threads 1\n";
    std::ofstream(w.directory / "kill.sh") << "timeout 100 " MPIRUN " -n 3 sh rank.sh >out 2>&1 &\n"
                                              "until [ -s pid.1 ] && grep -q amount out; do sleep 0.1; done\n"
                                              "kill -9 $(cat pid.1)\n"
                                              "wait $!\n";
    const int status = w.run("sh kill.sh");
    CHECK(status > 0);
    CHECK(status != 124);
    CHECK((test::content_of(w.directory / "n.obj") == "as it was\n"));
}
