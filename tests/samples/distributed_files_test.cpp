// Files of smooth-distributed, beside those of smooth.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/samples/running_ranks.h"
#include "tests/samples/workshop.h"

using namespace seamflow;
using test::messages;
using test::on_ranks;
using test::Workshop;
using test::write_labels_of;
namespace fs = std::filesystem;

TEST_CASE("files that no rank reads as a whole are refused with what to do, before anything is done")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere ball.ply --vertices 900") == 0);
    REQUIRE(w.run(GENERATE " noisy-sphere ball.off.gz --vertices 900") == 0);
    CHECK(on_ranks(w, 2, "ball.off.gz n.off --radius 1% --whole-up-to 1") == 3);
    REQUIRE(messages(w, "smooth-distributed").size() == 1);
    CHECK(messages(w, "smooth-distributed").front().find("unpack it") != std::string::npos);
    CHECK(on_ranks(w, 2, "ball.ply n.obj --radius 1% --whole-up-to 1") == 2);
    REQUIRE(messages(w, "smooth-distributed").size() == 1);
    CHECK(messages(w, "smooth-distributed").front().find("an uncompressed .ply file") != std::string::npos);
    CHECK(!w.has("n.obj"));
}

TEST_CASE("faces that smooth leaves out are left out by ranks, with the same file and remark")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere ball.obj --vertices 2000") == 0);
    std::ofstream(w.directory / "ball.obj", std::ios::app) << "f 1 2\nf 3 4 3\n";
    const std::string options = " --time-step-edges 3 --converge never --threads 1";
    REQUIRE(on_ranks(w, 1, "ball.obj 1.obj --subdomains 5 --parts cut.ply" + options) == 0);
    write_labels_of(w.directory / "cut.ply", w.directory / "labels");
    // Those that are left out have labels, too.
    std::ofstream(w.directory / "labels", std::ios::app) << "9\n9\n";
    REQUIRE(w.smooth("ball.obj n.obj --labels labels" + options) == 0);
    const std::string expected = test::content_of(w.directory / "n.obj");
    const std::string remark = "remark     2 faces name a vertex twice or have fewer than three corners";
    CHECK(w.count_lines("said", remark) == 1);
    for (const int n : {1, 2, 3})
        for (const std::string sharing : {"1", "1G"}) {
            CAPTURE(n);
            REQUIRE(on_ranks(w, n, "ball.obj n.obj --labels labels --whole-up-to " + sharing + options) == 0);
            CHECK((test::content_of(w.directory / "n.obj") == expected));
            CHECK(w.count_lines("said", remark) == 1);
        }
}

TEST_CASE("nasty files of the corpus end as with smooth")
{
    const char* const folder = std::getenv("SEAMFLOW_CORPUS");
    if (folder == nullptr)
        return;
    const Workshop w;
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / "nasty")) {
        const std::string file = entry.path().string();
        CAPTURE(file);
        const std::string options = " n" + entry.path().extension().string() +
                                    " --time-step-edges 1 --subdomains 3 --converge never --threads 1";
        const int status = w.smooth("'" + file + "'" + options);
        const auto expected = messages(w, "smooth");
        for (const std::string sharing : {"", " --whole-up-to 1"}) {
            CAPTURE(sharing);
            CHECK(on_ranks(w, 3, "'" + file + "'" + options + sharing) == status);
            CHECK(messages(w, "smooth-distributed") == expected);
        }
    }
}
