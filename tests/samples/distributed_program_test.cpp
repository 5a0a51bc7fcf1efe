// smooth-distributed on ranks of MPI writes the files of smooth.

#include <filesystem>
#include <fstream>
#include <sstream>
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

/// What may differ between reports of the same flow.
void leave_out_of(test::Json& json)
{
    if (json.is_object())
        for (const char* key : {"seconds", "reference_seconds", "threads", "live_factors", "factor_memory_bytes",
                                "peak_memory_bytes", "page_faults", "ranks", "arguments", "date"})
            json.erase(key);
    for (test::Json& one : json)
        if (one.is_structured())
            leave_out_of(one);
}

test::Json comparable(test::Json report)
{
    leave_out_of(report);
    return report;
}

/// A page without what may differ of its report.
std::string comparable_page(const std::string& page)
{
    const std::string start = R"(<script type="application/json" id="facts">)";
    const std::size_t begin = page.find(start) + start.size();
    const std::size_t end = page.find("</script>", begin);
    REQUIRE(page.find(start) < end);
    return page.substr(0, begin) + comparable(test::Json::parse(page.substr(begin, end - begin))).dump() +
           page.substr(end);
}

/// A table of steps without its times.
std::string comparable_table(const std::string& table)
{
    std::string kept;
    std::vector<bool> is_time;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line); kept += '\n') {
        const bool is_heading = is_time.empty();
        std::istringstream cells(line);
        std::size_t column = 0;
        for (std::string cell; std::getline(cells, cell, ','); ++column) {
            if (is_heading)
                is_time.push_back(cell.find("seconds") != std::string::npos);
            if (!is_time.at(column))
                kept += cell + ',';
        }
    }
    return kept;
}

std::string comparable_content(const fs::path& file)
{
    const std::string content = content_of(file);
    if (file.extension() == ".html")
        return comparable_page(content);
    return file.extension() == ".csv" ? comparable_table(content) : content;
}

/// Who takes the steps.
enum class Steps { Shared, OfRank0 };

/// A run of smooth.
struct Case {
    std::string input;
    std::string options;
    Steps steps = Steps::Shared;
    std::string result = "n.ply";
    /// What it writes beside OUTPUT and the report.
    std::vector<std::string> further = {};
    /// How `smooth` is told what ranks choose by themselves.
    std::string chosen = {};
};

/// Runs smooth, and smooth-distributed on each of these numbers of ranks, and compares files and reports.
void check_bytes(const Workshop& w, const Case& run, const std::vector<int>& n_ranks)
{
    CAPTURE(run.input + " " + run.options);
    const std::string arguments = run.input + " " + run.result + " " + run.options + " --threads 1 --report r.json";
    std::vector<std::string> files = run.further;
    files.push_back(run.result);
    const auto contents = [&] {
        std::vector<std::string> all;
        for (const std::string& file : files)
            all.push_back(comparable_content(w.directory / file));
        return all;
    };
    const auto report = [&] {
        test::Json json = comparable(w.json("r.json"));
        if (!run.chosen.empty())
            json.erase("choices");
        return json;
    };
    const int status = w.smooth(arguments + " " + run.chosen);
    CAPTURE(w.said());
    REQUIRE(status == 0);
    const std::vector<std::string> expected = contents();
    const test::Json expected_report = report();
    for (const int n : n_ranks) {
        CAPTURE(n);
        for (const std::string& file : files)
            fs::remove(w.directory / file);
        REQUIRE(on_ranks(w, n, arguments) == 0);
        const std::vector<std::string> found = contents();
        for (std::size_t i = 0; i < files.size(); ++i) {
            CAPTURE(files[i]);
            CHECK((found[i] == expected[i]));
        }
        CHECK(test::Json::diff(expected_report, report()).dump() == "[]");
        const std::size_t n_sharing = run.steps == Steps::Shared && n > 1 ? static_cast<std::size_t>(n) : 0;
        CHECK(w.json("r.json")["ranks"].size() == n_sharing);
    }
}

/// A patch of a wavy height field, as the text of an .obj file. @param first its first column.
std::string wavy_patch(int first, int n_columns, int n_rows)
{
    std::ostringstream text;
    for (int row = 0; row < n_rows; ++row)
        for (int column = first; column < first + n_columns; ++column)
            text << "v " << column << ' ' << row << ' ' << (7 * column + 5 * row) % 4 << '\n';
    for (int row = 0; row + 1 < n_rows; ++row)
        for (int v = row * n_columns + 1; v < (row + 1) * n_columns; ++v)
            text << "f " << v << ' ' << v + 1 << ' ' << v + n_columns + 1 << ' ' << v + n_columns << '\n';
    return text.str();
}

/// A ball, and files about its vertices and faces.
struct BallWorkshop : Workshop {
    BallWorkshop()
    {
        REQUIRE(run(GENERATE " noisy-sphere ball.ply --vertices 4000") == 0);
        REQUIRE(run("sh -c 'seq 500 2100 >region; seq 100 3 700 >stay; seq 0 7995 | awk \"{print int(\\$1 / 900)}\" "
                    ">labels; seq 0 3999 | awk \"{print \\$1 % 5}\" >weights'") == 0);
        REQUIRE(smooth("ball.ply fields.ply --from stay") == 0);
        // Without obtuse angles.
        REQUIRE(run(GENERATE " quads grid.ply --vertices 4000") == 0);
        REQUIRE(smooth("grid.ply even.ply --from stay") == 0);
    }
};

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
            check_bytes(w,
                        {.input = input,
                         .options = std::string("--time-step-edges 3 --steps 3 --subdomains 9 --parts cut.ply ") + how,
                         .result = result,
                         .further = {"cut.ply"}},
                        {1, 2, 3, 5});
}

TEST_CASE("the file is that of smooth whatever the options of steps that ranks share")
{
    const BallWorkshop w;
    REQUIRE(w.run(GENERATE " foam foam.ply --vertices 1500") == 0);
    const std::string sweeps = "--approach sweep --subdomains 7 --steps 2 --radius 2% ";
    const std::string converged = "--approach converged --subdomains 7 --steps 2 --radius 2% ";
    for (const char* options : {"--fix stay --reference --coloring label --no-correction",
                                "--direction 1,2,4 --within 1% --transmission derivative --p-rule inverse-step",
                                "--filter low-pass --attach 5%", "--laplacian ptackova-velho --p-edge mean",
                                "--flow conformalized --rescale volume --sweep fixed --weld 1%",
                                "--conditions adapted-ventcell --q 0.1 --factorisation cholmod",
                                "--p 3 --strict --self-intersections --attach-weights weights --memory-limit 20M"})
        check_bytes(w, {"ball.ply", sweeps + options}, {2, 5});
    for (const char* options : {"--region region --feather 6% --direction normal --precision double",
                                "--flow linear --laplacian alexa-wardetzky --fix stay --converge-iterations 50",
                                "--order 2 --attach-weights weights --rescale area", "--direction z --memory-limit 1M"})
        check_bytes(w, {"ball.ply", converged + options}, {3, 5});
    check_bytes(w, {"foam.ply", converged + "--junctions flow --boundary free"}, {2, 3});
    check_bytes(w, {"mesh.obj", converged + "--laplacian uniform", Steps::Shared, "n.obj"}, {5});
    check_bytes(w, {"ball.ply", "--labels labels --radius 2% --approach sweep"}, {2, 5});
    check_bytes(w, {"ball.ply", "--paper --radius 1% --subdomains 5"}, {2, 3});
    check_bytes(w, {"ball.ply", "--preset fair --approach sweep --subdomains 4"}, {3});
    check_bytes(w, {"ball.ply", "--noise 1% --approach sweep --subdomains 4"}, {3});
    check_bytes(w, {"ball.ply", "--preset terrain --noise 2% --approach converged --subdomains 4"}, {2});
    check_bytes(w, {"even.ply", "--fields distance --fwhm 3% --steps 2 --approach converged --subdomains 5"}, {2, 5});
    check_bytes(w, {"even.ply", "--fields distance --radius 2% --fill --fix stay --subdomains 5"}, {3});
}

TEST_CASE("the file is that of smooth whatever the options of what rank 0 does alone")
{
    const BallWorkshop w;
    std::ofstream(w.directory / "left.obj") << wavy_patch(0, 21, 30);
    std::ofstream(w.directory / "right.obj") << wavy_patch(20, 25, 30);
    std::ofstream(w.directory / "creased.obj") << wavy_patch(0, 25, 30) << "l 102 103 104 105\n";
    std::ofstream(w.directory / "pairs") << "101 102\n102 103\n";
    for (const char* options :
         {"", "--preset cad", "--preset terrain", "--preset automatic --region region", "--keep-edges 30 --radius 1%",
          "--radius 2% --approach cg --tune-for 4", "--radius 2% --approach undecomposed --flow conformalized",
          "--scheme explicit --time-step-edges 0.02", "--conditions robin --radius 1% --keep-gaps --subdomains 3",
          "--conditions schwarz --radius 1% --overlap 2 --subdomains 3", "--conditions ventcell --q 0.1 --radius 1%",
          "--from stay"})
        check_bytes(w, {"ball.ply", options, Steps::OfRank0}, {3});
    check_bytes(w, {"fields.ply", "--fields distance --fwhm 3% --keep-field-edges 0.3", Steps::OfRank0}, {3});
    check_bytes(w, {"fields.ply", "--fields distance --fwhm 3% --steps 2 --subdomains 5", Steps::OfRank0}, {2});
    check_bytes(w, {"creased.obj", "--edges-from-file", Steps::OfRank0, "n.obj"}, {2});
    check_bytes(w, {"creased.obj", "--edges pairs --radius 1% --keep-edges 20", Steps::OfRank0, "n.obj"}, {5});
    const std::string tiles = "left.obj right.obj --time-step-edges 2 --steps 2 --threads 1 --out-dir ";
    REQUIRE(w.smooth(tiles + "expected") == 0);
    for (const int n : {2, 5}) {
        REQUIRE(on_ranks(w, n, tiles + "out") == 0);
        for (const char* tile : {"left.obj", "right.obj"})
            CHECK((content_of(w.directory / "out" / tile) == content_of(w.directory / "expected" / tile)));
    }
}

TEST_CASE("what is written beside the result is that of smooth")
{
    const BallWorkshop w;
    const std::string flow = "--radius 2% --steps 2 --subdomains 5 ";
    for (const char* approach : {"--approach sweep ", "--approach converged "})
        check_bytes(w,
                    {"ball.ply",
                     flow + approach + "--html n.html --csv n.csv --every-step s%d.ply --parts cut.ply --verbose",
                     Steps::Shared,
                     "n.off",
                     {"n.html", "n.csv", "s1.ply", "s2.ply", "cut.ply"}},
                    {2, 5});
    check_bytes(
        w, {"even.ply", "--fields distance --fwhm 3% --subdomains 5 --html n.html", Steps::Shared, "n.ply", {"n.html"}},
        {3});
    // Who does what when is known of one process alone.
    check_bytes(
        w,
        {"ball.ply", flow + "--approach sweep --trace t.json --task-graph g.dot", Steps::OfRank0, "n.ply", {"g.dot"}},
        {3});
    CHECK(!w.json("t.json").empty());
    check_bytes(w, {"-", flow + "--approach sweep <mesh.obj", Steps::Shared, "n.obj"}, {3});
    REQUIRE(w.smooth("mesh.obj n.obj --approach sweep " + flow) == 0);
    REQUIRE(w.run("sh -c '" MPIRUN " -n 2 " SMOOTH_DISTRIBUTED " mesh.obj - --approach sweep " + flow +
                  " >piped.obj'") == 0);
    CHECK((content_of(w.directory / "piped.obj") == content_of(w.directory / "n.obj")));
}

TEST_CASE("left to themselves ranks take steps that they can share, which they name: smooth does the same if told so")
{
    const BallWorkshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere large.ply --vertices 9000") == 0);
    struct Choice {
        std::string input;
        std::string options;
        std::string approach;
        Steps steps = Steps::Shared;
    };
    for (const Choice& choice :
         std::vector<Choice>{{"large.ply", "--radius 1% --steps 3", "sweep"},
                             {"large.ply", "--radius 20%", "converged"},
                             {"large.ply", "--radius 1% --flow conformalized --converge 1e-5", "converged"},
                             {"large.ply", "--preset scan", "converged"},
                             // Too small to be cut.
                             {"ball.ply", "--radius 3% --region region", "undecomposed", Steps::OfRank0}}) {
        CAPTURE(choice.options);
        REQUIRE(on_ranks(w, 2, choice.input + " n.ply " + choice.options + " --report r.json") == 0);
        const test::Json report = w.json("r.json");
        CHECK(report["approach"] == choice.approach);
        const std::string reason = "ranks can share such steps";
        CHECK((w.said().find(reason) == std::string::npos) ==
              (report["choices"].dump().find(reason) == std::string::npos));
        check_bytes(w,
                    {.input = choice.input,
                     .options = choice.options,
                     .steps = choice.steps,
                     .chosen = "--approach " + choice.approach},
                    {1, 2, 3, 5});
    }
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
