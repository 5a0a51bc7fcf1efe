// A disk that is really full: a small tmpfs, mounted in a name space of its own.

#include <string>

#include "tests/samples/workshop.h"

using namespace seamflow;
using test::Workshop;

namespace {

/// Runs a command with a file system of so many bytes at the folder `small`, and lists what is there afterwards in the
/// file `left`.
int run_on_small_disk(const Workshop& w, const std::string& size, const std::string& command)
{
    return w.run("unshare -rm sh -c 'mount -t tmpfs -o size=" + size + " tmpfs small && echo old >small/out.obj && " +
                 command + "; status=$?; cp small/out.obj out.obj; ls -A small >left; exit $status'");
}

}  // namespace

TEST_CASE("on a disk that is full, smooth says so with status 5, and leaves nothing that is not whole")
{
    const Workshop w;
    std::filesystem::create_directory(w.directory / "small");
    if (run_on_small_disk(w, "1m", "true") != 0) {
        MESSAGE("skipped: file systems cannot be mounted here");
        return;
    }
    REQUIRE(w.run(GENERATE " mixed large.obj --vertices 9000") == 0);
    const std::string command = SMOOTH " large.obj small/out.obj --time-step-edges 2 --subdomains 3";
    REQUIRE(run_on_small_disk(w, "16m", command) == 0);
    CHECK(test::content_of(w.directory / "left") == "out.obj\n");
    const auto is_refused = [&](const std::string& output, const std::string& file) {
        CAPTURE(file);
        // The input's own size is some 600 kB.
        CHECK(run_on_small_disk(w, "200k", output) == 5);
        CHECK(w.said().find(file + ": cannot be written: No space left on device") != std::string::npos);
        CHECK(test::content_of(w.directory / "left") == "out.obj\n");
        CHECK(test::content_of(w.directory / "out.obj") == "old\n");
    };
    const std::string elsewhere = SMOOTH " large.obj there.obj --time-step-edges 2 --subdomains 3 ";
    is_refused(command, "small/out.obj");
    // Before the work.
    CHECK(w.said().find("amount") != std::string::npos);
    CHECK(run_on_small_disk(w, "200k", command + " --steps 1000000000") == 5);
    is_refused(elsewhere + "--parts small/parts.ply", "small/parts.ply");
    is_refused(elsewhere + "--every-step small/at-%d.ply", "small/at-1.ply");
    is_refused(SMOOTH " large.obj there.obj --time-step 1e-12 --steps 100 --subdomains 9 --converge never "
                      "--trace small/trace.json",
               "small/trace.json");
    if (HAS_PAGE)
        is_refused(elsewhere + "--html small/page.html", "small/page.html");
    CHECK(run_on_small_disk(w, "200k", elsewhere + "--checkpoint small") == 5);
    CHECK(w.said().find("small/smooth.checkpoint: cannot be written: No space left") != std::string::npos);
    CHECK(test::content_of(w.directory / "left") == "out.obj\n");
}
