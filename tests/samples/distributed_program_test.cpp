// smooth-distributed on ranks of MPI, beside smooth.

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/samples/running_ranks.h"
#include "tests/samples/workshop.h"
#include "tests/support/relative.h"

using namespace seamflow;
using test::messages;
using test::on_ranks;
using test::on_ranks_of_which_one_is_killed;
using test::Workshop;
using test::write_labels_of;
using test::write_soup;

TEST_CASE("the help of ranks offers only what they take")
{
    const Workshop w;
    REQUIRE(w.run(SMOOTH_DISTRIBUTED " --help") == 0);
    const std::string help = w.said();
    for (const std::string other : {"--noise", "--keep-edges", "--html", "--reference", "--rescale", "|undecomposed",
                                    "|cg", "schwarz", "scan|", "cad"}) {
        CAPTURE(other);
        CHECK(help.find(other) == std::string::npos);
    }
    for (const char* own :
         {"--whole-up-to", "--csv", "adapted-ventcell", "--preset fair", "--region", "--feather", "--direction"})
        CHECK(help.find(own) != std::string::npos);
}

TEST_CASE("ranks print what a preset has chosen, as smooth does")
{
    const Workshop w;
    const auto preset_line = [&] {
        const std::string said = w.said();
        const std::size_t begin = said.find("preset     fair: ");
        REQUIRE(begin != std::string::npos);
        return said.substr(begin, said.find('\n', begin) - begin);
    };
    REQUIRE(on_ranks(w, 2, "mesh.obj ranks.obj --preset fair") == 0);
    const std::string of_ranks = preset_line();
    REQUIRE(w.smooth("mesh.obj one.obj --preset fair") == 0);
    CHECK(of_ranks == preset_line());
    CHECK(of_ranks.ends_with("--radius 3%"));
}

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

TEST_CASE("ranks smooth a region, and along lines, as smooth does with the same cut")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere ball.ply --vertices 6000") == 0);
    REQUIRE(w.run("sh -c 'seq 500 2100 >region; seq 0 12000 | awk \"{print int(\\$1 / 900)}\" >cut'") == 0);
    REQUIRE(w.run("sh -c 'head -n $(grep -a \"element face\" ball.ply | cut -d\" \" -f3) cut >labels'") == 0);
    for (const std::string how :
         {"--region region", "--region region --feather 6%", "--region region --direction normal --boundary free",
          "--direction 1,2,4 --within 1%", "--region region --feather 6% --direction normal"}) {
        CAPTURE(how);
        const std::string options =
            " --radius 3% --steps 3 --converge 1e-6 --threads 1 --labels labels --parts parts.ply --report r.json " +
            how;
        REQUIRE(w.smooth("ball.ply s.ply" + options) == 0);
        const test::Json expected = w.json("r.json");
        const std::string parts = test::content_of(w.directory / "parts.ply");
        for (const int n : {1, 3}) {
            CAPTURE(n);
            REQUIRE(on_ranks(w, n, "ball.ply n.ply" + options) == 0);
            CHECK((test::content_of(w.directory / "n.ply") == test::content_of(w.directory / "s.ply")));
            CHECK((test::content_of(w.directory / "parts.ply") == parts));
            const test::Json report = w.json("r.json");
            for (const std::string name : {"subdomains", "interface_vertices", "vertices", "faces", "remarks"})
                CHECK(report[name] == expected[name]);
            for (const std::string when : {"before", "after"})
                CHECK(report["surface"][when]["area"].get<double>() ==
                      test::relative(expected["surface"][when]["area"].get<double>(), 1e-12));
        }
    }
    // A region that lies far from the origin, of a mesh that does not; in slices.
    REQUIRE(w.run(GENERATE " noisy-sphere near.off --vertices 6000") == 0);
    REQUIRE(w.run("sh -c 'awk \"NR > 2 && NF == 3 {\\$1 += 20} 1\" near.off >ball.off'") == 0);
    const std::string far = " --radius 3% --converge 1e-6 --threads 1 --subdomains 4 --region region ";
    REQUIRE(on_ranks(w, 3, "ball.off n.off --whole-up-to 1" + far + "--parts parts.ply --checkpoint kept") == 0);
    write_labels_of(w.directory / "parts.ply", w.directory / "labels");
    REQUIRE(w.smooth("ball.off s.off --radius 3% --converge 1e-6 --region region --labels labels") == 0);
    CHECK((test::content_of(w.directory / "n.off") == test::content_of(w.directory / "s.off")));

    CHECK(on_ranks(w, 2, "ball.off no.off --feather 1%" + far + "--whole-up-to 1") == 2);
    CHECK(messages(w, "smooth-distributed").front().find("--feather needs distances on the whole mesh") == 0);
    for (const std::string sweeps : {"--converge never", "--approach sweep", "--coloring label"}) {
        CAPTURE(sweeps);
        const std::string refused = "ball.off no.off --radius 3% --region region " + sweeps;
        REQUIRE(w.smooth(refused) == 2);
        const auto expected = messages(w, "smooth");
        CHECK(expected.front().find("--region is given") == 0);
        CHECK(expected.front().find(sweeps.substr(0, sweeps.find(' '))) != std::string::npos);
        CHECK(on_ranks(w, 2, refused) == 2);
        CHECK(messages(w, "smooth-distributed") == expected);
        // Before the file is dealt.
        CHECK(w.count_lines("said", "input ") == 0);
    }
    REQUIRE(on_ranks(w, 2, "ball.off n.off --radius 3% --weld 5%") == 0);
    CHECK(w.count_lines("said", "remark     --weld has joined no vertices: ") == 1);
    REQUIRE(w.run("touch none") == 0);
    REQUIRE(on_ranks(w, 2, "ball.off n.off --radius 3% --region none --report r.json") == 0);
    CHECK(w.count_lines("said", "remark     The region is empty") == 1);
    // No face is measured.
    CHECK(w.said().find("roughness") == std::string::npos);
    CHECK(w.said().find("at most; area ") != std::string::npos);
    CHECK(w.json("r.json")["surface"]["before"]["roughness_rms"].is_null());
    CHECK(w.json("r.json")["surface"]["after"]["area"].get<double>() > 1.0);
    CHECK((test::content_of(w.directory / "n.off") == test::content_of(w.directory / "ball.off")));
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
        for (const std::string name :
             {"tolerance", "steps_short_of_tolerance", "steps_stagnated", "non_manifold_vertices", "attachment_weights",
              "subdomain_vertices", "subdomain_faces", "subdomain_colours", "interface_vertices", "vertices",
              "repaired_faces"})
            CHECK(report[name] == expected[name]);
        for (const std::string when : {"before", "after"}) {
            for (const std::string name : {"area", "volume"})
                CHECK(report["surface"][when][name].get<double>() ==
                      test::relative(expected["surface"][when][name].get<double>(), 1e-12));
            for (const std::string name : {"roughness_rms", "roughness_percentile_95"})
                CHECK(report["surface"][when][name] == expected["surface"][when][name]);
        }
        for (const std::string name : {"moved_mean", "moved_rms", "moved_max", "moved_max_absolute"})
            CHECK(report["surface"][name].get<double>() ==
                  test::relative(expected["surface"][name].get<double>(), 1e-12));
        REQUIRE(report["steps"].size() == 3);
        for (std::size_t i = 0; i < 3; ++i) {
            const test::Json& step = report["steps"][i];
            CHECK(step["iterations"] == expected["steps"][i]["iterations"]);
            CHECK(step["residual"] == expected["steps"][i]["residual"]);
            CHECK(step["moved_mean"].get<double>() > 0.0);
            CHECK(step["estimated_v_max"].get<double>() ==
                  test::relative(expected["steps"][i]["estimated_v_max"].get<double>(), 1e-9));
        }
    }
}

TEST_CASE("the roughness, by a sample where there is much, and the estimate of sweeps are those of smooth")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere ball.ply --vertices 20000") == 0);
    write_soup(w.directory / "mesh.obj", w.directory / "soup.obj");
    for (const std::string mesh : {"ball.ply", "soup.obj"}) {
        CAPTURE(mesh);
        const std::string options = " --radius 2% --steps 2 --converge never --threads 1";
        const std::string out = mesh.substr(mesh.size() - 4);
        REQUIRE(on_ranks(w, 1, mesh + " 1" + out + options + " --subdomains 9 --parts cut.ply") == 0);
        write_labels_of(w.directory / "cut.ply", w.directory / "labels");
        REQUIRE(w.smooth(mesh + " s" + out + options + " --labels labels --report s.json") == 0);
        const test::Json expected = w.json("s.json");
        std::string said = w.said().substr(w.said().find("; roughness "));
        for (const int n : {1, 2, 3, 5}) {
            CAPTURE(n);
            REQUIRE(on_ranks(w, n,
                             mesh + " n" + out + options + " --labels labels --report n.json --whole-up-to " +
                                 (n == 5 ? "1" : "16MiB")) == 0);
            CHECK(w.said().find(said) != std::string::npos);
            const test::Json report = w.json("n.json");
            for (const std::string when : {"before", "after"})
                for (const std::string name : {"roughness_rms", "roughness_percentile_95"})
                    CHECK(report["surface"][when][name] == expected["surface"][when][name]);
            for (std::size_t step = 0; step < 2; ++step)
                CHECK(report["steps"][step]["estimated_v_max"].get<double>() ==
                      test::relative(expected["steps"][step]["estimated_v_max"].get<double>(), 1e-12));
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
        for (const std::string options :
             {" --boundary free --converge 1e-6", " --converge never", " --boundary free"}) {
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
    const std::string shared = "mesh.obj n.obj --radius 2% --boundary free --converge never --subdomains 8";
    REQUIRE(w.smooth(shared) == 2);
    const auto expected = messages(w, "smooth");
    CHECK(on_ranks(w, 3, shared) == 2);
    CHECK(messages(w, "smooth-distributed") == expected);
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
                                     "--scheme explicit", "--trace t.json", "--noise 1%"}) {
        CAPTURE(option);
        // MPI takes a program that is started alone as one rank.
        CHECK(w.run(SMOOTH_DISTRIBUTED " mesh.obj n.obj --radius 1% " + option) == 2);
        const auto said = messages(w, "smooth-distributed");
        REQUIRE(said.size() == 1);
        CHECK(said.front().starts_with("smooth-distributed has no " + option.substr(0, option.find(' ')) + ": "));
    }
    CHECK(on_ranks(w, 2, "mesh.obj n.obj") == 2);
    REQUIRE(messages(w, "smooth-distributed").size() == 1);
    CHECK(messages(w, "smooth-distributed").front().starts_with("say how much to smooth with --time-step"));
    CHECK(!w.has("n.obj"));
}

TEST_CASE("a rank that is killed ends the others, and the file that was there stays")
{
    const Workshop w;
    std::ofstream(w.directory / "n.obj") << "as it was\n";
    const int status =
        on_ranks_of_which_one_is_killed(w, "mesh.obj n.obj --radius 1% --steps 1000000 --subdomains 6 --threads 1",
                                        "[ -s pid.1 ] && grep -q amount out");
    CHECK(status > 0);
    CHECK(status != 124);
    CHECK((test::content_of(w.directory / "n.obj") == "as it was\n"));
}
