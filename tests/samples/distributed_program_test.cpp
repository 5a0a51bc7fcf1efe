// smooth-distributed on ranks of MPI writes the files of smooth.

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/samples/running_ranks.h"
#include "tests/samples/workshop.h"

using namespace seamflow;
using test::content_of;
using test::messages;
using test::on_ranks;
using test::on_ranks_of_which_one_is_killed;
using test::Workshop;
namespace fs = std::filesystem;

namespace {

/// A report without what may differ.
test::Json comparable(test::Json report)
{
    for (const char* key : {"seconds", "threads", "live_factors", "factor_memory_bytes", "peak_memory_bytes", "ranks",
                            "arguments", "date"})
        report.erase(key);
    for (test::Json& step : report["steps"])
        step.erase("seconds");
    return report;
}

/// Runs smooth, and smooth-distributed on each of these numbers of ranks, and compares files and reports.
/// @param result the name of OUTPUT.
void check_bytes(const Workshop& w, const std::string& input, const std::string& result, const std::string& options,
                 const std::vector<int>& n_ranks)
{
    CAPTURE(input + " " + options);
    const std::string arguments = input + " " + result + " " + options + " --threads 1 --report r.json";
    REQUIRE(w.smooth(arguments) == 0);
    const std::string expected = content_of(w.directory / result);
    const test::Json report = comparable(w.json("r.json"));
    for (const int n : n_ranks) {
        CAPTURE(n);
        fs::remove(w.directory / result);
        REQUIRE(on_ranks(w, n, arguments) == 0);
        CHECK((content_of(w.directory / result) == expected));
        CHECK(comparable(w.json("r.json")) == report);
    }
}

}  // namespace

TEST_CASE("the file and the report are those of smooth, on any number of ranks, in all formats")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere ball.ply --vertices 9000") == 0);
    REQUIRE(w.run(GENERATE " noisy-sphere ball.stl --vertices 2000") == 0);
    REQUIRE(w.run(GENERATE " noisy-sphere ball.off.gz --vertices 2000") == 0);
    for (const auto& [input, result] :
         {std::pair{"mesh.obj", "n.obj"}, {"ball.ply", "n.ply"}, {"ball.stl", "n.stl"}, {"ball.off.gz", "n.off"}})
        for (const char* how : {"--approach sweep", "--converge 1e-6"})
            check_bytes(w, input, result,
                        std::string("--time-step-edges 3 --steps 3 --subdomains 9 --parts cut.ply ") + how,
                        {1, 2, 3, 5});
}

TEST_CASE("the file is that of smooth whatever the options, those that ranks do not share included")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere ball.ply --vertices 6000") == 0);
    REQUIRE(w.run("sh -c 'seq 500 2100 >region; seq 100 3 700 >stay'") == 0);
    for (const char* options :
         {"--radius 2% --steps 2 --approach sweep --fix stay", "--radius 2% --direction 1,2,4 --within 1% --approach sweep",
          "--radius 3% --region region --converge 1e-6",
          "--radius 3% --region region --feather 6% --direction normal --approach converged",
          "--radius 2% --approach sweep --filter low-pass --attach 5% --within 1%",
          "--radius 2% --converge 1e-4 --rescale volume --self-intersections",
          "--radius 2% --flow conformalized --approach sweep --sweep alternating --weld 1%",
          "--radius 2% --flow linear --approach converged --laplacian alexa-wardetzky",
          "--preset fair --approach sweep", "--radius 2% --approach sweep --noise 1% --reference",
          "--radius 2% --approach cg", "--radius 2% --approach undecomposed", "--keep-edges 30 --radius 1%",
          "--scheme explicit --time-step-edges 0.1", "--paper --radius 1% --keep-gaps",
          "--conditions schwarz --radius 1%", "--strict --radius 1% --converge never"})
        check_bytes(w, "ball.ply", "n.ply", options, {3});
    for (const char* options : {"--fields red --fwhm 3% --steps 2 --approach converged", "--from stay"})
        check_bytes(w, "ball.ply", "n.ply", options, {3});
}

TEST_CASE("left to themselves ranks take steps that they can share, the same on any number")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere ball.ply --vertices 9000") == 0);
    std::set<std::string> results;
    for (const int n : {1, 2, 5}) {
        REQUIRE(on_ranks(w, n, "ball.ply n.ply --radius 1% --steps 3 --report r.json") == 0);
        CHECK(w.json("r.json")["approach"] == "sweep");
        CHECK(w.json("r.json")["ranks"].size() == (n > 1 ? static_cast<std::size_t>(n) : 0));
        results.insert(content_of(w.directory / "n.ply"));
    }
    REQUIRE(w.smooth("ball.ply n.ply --radius 1% --steps 3 --approach sweep") == 0);
    results.insert(content_of(w.directory / "n.ply"));
    CHECK(results.size() == 1);
    REQUIRE(on_ranks(w, 2, "ball.ply n.ply --radius 1% --approach cg") == 0);
    CHECK(w.count_lines("said", "ranks      rank 0 of 2 has done all of it") == 1);
}

TEST_CASE("rank 0 alone prints, and tells of every rank")
{
    const Workshop w;
    REQUIRE(on_ranks(w, 3, "mesh.obj n.off --radius 2% --steps 2 --subdomains 6 --report r.json --verbose") == 0);
    for (const char* line : {"input ", "amount ", "step 1 of 2 ", "step 2 of 2 ", "cut ", "ranks ", "time ", "result "})
        CHECK(w.count_lines("said", line) == 1);
    const test::Json report = w.json("r.json");
    REQUIRE(report["ranks"].size() == 3);
    std::int64_t n_vertices = 0;
    for (const test::Json& rank : report["ranks"]) {
        CHECK(rank["vertices"] > 0);
        CHECK(rank["messages"] > 0);
        n_vertices += rank["vertices"].get<std::int64_t>();
    }
    CHECK(n_vertices == report["vertices"]);
}

TEST_CASE("a run resumes with and without ranks, on any number of them")
{
    const Workshop w;
    for (const char* how :
         {"--converge never --filter low-pass --attach 5%", "--converge 1e-3 --boundary free --flow conformalized"}) {
        CAPTURE(how);
        const std::string flow = std::string("mesh.obj n.obj --time-step-edges 3 --subdomains 7 ") + how + " --steps ";
        fs::remove_all(w.directory / "c");
        REQUIRE(w.smooth(flow + "5 --checkpoint c") == 0);
        const std::string expected = content_of(w.directory / "n.obj");
        fs::remove_all(w.directory / "c");
        REQUIRE(on_ranks(w, 3, flow + "2 --checkpoint c") == 0);
        REQUIRE(on_ranks(w, 5, flow + "3 --checkpoint c") == 0);
        CHECK(w.count_lines("said", "resumed    after step 2, from c/smooth.checkpoint") == 1);
        REQUIRE(w.smooth(flow + "4 --checkpoint c") == 0);
        CHECK(w.count_lines("said", "resumed    after step 3") == 1);
        REQUIRE(on_ranks(w, 2, flow + "5 --checkpoint c --every-step s%d.obj") == 0);
        CHECK((content_of(w.directory / "n.obj") == expected));
        CHECK((content_of(w.directory / "s5.obj") == expected));
    }
}

TEST_CASE("what cannot be done is said once, with the exit status of smooth, and nothing is written")
{
    const Workshop w;
    std::ofstream(w.directory / "far.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n";
    std::ofstream(w.directory / "letters") << "0\none\n";
    for (const std::string arguments :
         {"far.obj n.obj --radius 1%", "missing.obj n.obj --radius 1%", "mesh.xyz n.obj --radius 1%",
          "mesh.obj n.obj --radius 1% --labels letters", "mesh.obj nowhere/n.obj --radius 1%",
          "mesh.obj n.obj --radius 0", "mesh.obj n.obj --radius 1% --time-step 1",
          "mesh.obj n.obj --radius 2% --boundary free --converge never --subdomains 8",
          "mesh.obj n.obj --radius 2% --subdomains 8 --converge never --memory-limit 1"}) {
        CAPTURE(arguments);
        const int status = w.smooth(arguments);
        CHECK(status > 0);
        const auto expected = messages(w, "smooth");
        CHECK(on_ranks(w, 3, arguments) == status);
        const auto found = messages(w, "smooth-distributed");
        REQUIRE(found.size() == 1);
        // How many factors a sweep needs at once depends on who has them.
        if (arguments.find("--memory-limit") == std::string::npos)
            CHECK(found == expected);
        CHECK(!w.has("n.obj"));
    }
    const std::string missed = "mesh.obj n.obj --radius 2% --steps 2 --subdomains 5 --converge 1e-100";
    REQUIRE(w.smooth(missed) == 4);
    const auto expected = messages(w, "smooth");
    REQUIRE(on_ranks(w, 3, missed) == 4);
    CHECK(messages(w, "smooth-distributed") == expected);
}

TEST_CASE("a disk that is full ends all ranks with one message, and the file that was there stays")
{
    const Workshop w;
    fs::create_directory(w.directory / "small");
    REQUIRE(w.run(GENERATE " mixed large.obj --vertices 9000") == 0);
    const auto on_small_disk = [&](const std::string& command) {
        return w.run("unshare -rm sh -c 'mount -t tmpfs -o size=200k tmpfs small && echo old >small/out.obj && " +
                     command + "; status=$?; cp small/out.obj out.obj; exit $status'");
    };
    if (on_small_disk("true") != 0) {
        MESSAGE("skipped: file systems cannot be mounted here");
        return;
    }
    CHECK(on_small_disk(MPIRUN " -n 3 " SMOOTH_DISTRIBUTED
                               " large.obj small/out.obj --time-step-edges 2 --subdomains 5 --threads 1") == 5);
    REQUIRE(messages(w, "smooth-distributed").size() == 1);
    CHECK(messages(w, "smooth-distributed").front().find("small/out.obj: cannot be written: No space left") == 0);
    CHECK(content_of(w.directory / "out.obj") == "old\n");
}

TEST_CASE("a rank that is killed ends the others, and the file that was there stays")
{
    const Workshop w;
    for (const std::string approach : {"--converge never", "--converge 1e-3"}) {
        CAPTURE(approach);
        fs::remove_all(w.directory / "c");
        std::ofstream(w.directory / "n.obj") << "as it was\n";
        const std::string flow = "mesh.obj n.obj --time-step-edges 0.1 --subdomains 6 --threads 1 " + approach;
        const int status = on_ranks_of_which_one_is_killed(w, flow + " --steps 1000000 --checkpoint c",
                                                           "[ -s pid.1 ] && [ -s c/smooth.checkpoint ]");
        CHECK(status > 0);
        CHECK(status != 124);
        CHECK((content_of(w.directory / "n.obj") == "as it was\n"));
    }
}
