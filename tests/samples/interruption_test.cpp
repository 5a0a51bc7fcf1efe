// Signals at any time: what the user is left with.

#include <chrono>
#include <random>
#include <string>
#include <thread>

#include <fcntl.h>
#include <pty.h>

#include "partition/formats/mesh_io.h"
#include "tests/samples/running_program.h"
#include "tests/samples/workshop.h"

using namespace seamflow;
using test::RunningProgram;
using test::Workshop;

namespace {

using Clock = std::chrono::steady_clock;

void sleep_for(double seconds)
{
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

RunningProgram start(const Workshop& w, const std::string& arguments)
{
    return RunningProgram(w.directory.path(), SMOOTH, arguments);
}

/// Waits until the program has said that.
void await(const Workshop& w, RunningProgram& program, const std::string& text)
{
    while (w.said().find(text) == std::string::npos) {
        REQUIRE(program.runs());
        sleep_for(0.002);
    }
}

bool has_remnants(const Workshop& w)
{
    for (const auto& entry : std::filesystem::recursive_directory_iterator(w.directory.path()))
        if (entry.path().filename().string().starts_with(".seamflow"))
            return true;
    return false;
}

/// The number after "has the mesh after step ".
std::string step_of_interrupted(const Workshop& w)
{
    const std::string before = "has the mesh after step ";
    const std::string said = w.said();
    const std::size_t begin = said.find(before);
    REQUIRE(begin != std::string::npos);
    return said.substr(begin + before.size(), said.find(' ', begin + before.size()) - begin - before.size());
}

}  // namespace

TEST_CASE("SIGINT and SIGTERM leave the last complete step beside the output, and end with 130 and 143")
{
    for (const auto& [signal, status] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}})
        for (const std::string flow : {"--converge never --subdomains 5", "--converge 1e-3 --subdomains 5",
                                       "--laplacian ptackova-velho --converge 1e-2 --subdomains 3", "--subdomains 1",
                                       "--conditions robin --keep-gaps", "--scheme explicit"}) {
            CAPTURE(flow);
            const Workshop w;
            const std::string arguments =
                "mesh.obj out.obj --time-step 1e-9 --steps 2000 --verbose --every-step at-%d.obj " + flow;
            RunningProgram program = start(w, arguments);
            await(w, program, "\nstep 3 ");
            program.send(signal);
            REQUIRE(program.wait() == status);
            CHECK_FALSE(w.has("out.obj"));
            CHECK_FALSE(has_remnants(w));
            const std::string step = step_of_interrupted(w);
            CHECK(test::content_of(w.directory / "out.interrupted.obj") ==
                  test::content_of(w.directory / ("at-" + step + ".obj")));
            CHECK(read_mesh(w.directory / "out.interrupted.obj").mesh.n_vertices() >= 900);
        }
}

TEST_CASE("a signal before the first step is complete leaves nothing")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " triangles large.ply --vertices 150000") == 0);
    for (const bool waits : {false, true})
        for (const int signal : {SIGINT, SIGTERM}) {
            RunningProgram program = start(w, "large.ply out.ply --time-step-edges 3 --subdomains 1 --steps 1");
            waits ? await(w, program, "input ") : sleep_for(0.02);
            program.send(signal);
            const int status = program.wait();
            // 1000 and the signal: it had not begun to listen.
            CHECK((status == 128 + signal || (!waits && status == 1000 + signal)));
            if (status < 1000)
                CHECK(w.said().find("interrupted before ") != std::string::npos);
            CHECK_FALSE(w.has("out.ply"));
            CHECK_FALSE(w.has("out.interrupted.ply"));
            CHECK_FALSE(has_remnants(w));
        }
}

TEST_CASE("a signal at any time, when a mesh is read, cut or written, too, leaves all or the last complete step")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere large.ply --vertices 15000") == 0);
    const std::string arguments = "large.ply out.obj --time-step-edges 2 --steps 3 --verbose";
    const auto begin = Clock::now();
    REQUIRE(w.smooth(arguments + " --every-step at-%d.obj") == 0);
    double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    const std::string expected = test::content_of(w.directory / "out.obj");
    int n_stopped = 0;
    // More of them, and sooner, where the run that was measured took longer than others do.
    for (int i = 0; i < 16 || (n_stopped <= 2 && i < 160); ++i) {
        CAPTURE(i);
        for (const char* name : {"out.obj", "out.interrupted.obj"})
            std::filesystem::remove(w.directory / name);
        RunningProgram program = start(w, arguments);
        sleep_for(0.01 + seconds * (i % 16) / 16);
        program.send(i % 2 == 0 ? SIGINT : SIGTERM);
        const int status = program.wait();
        CAPTURE(w.said());
        CHECK_FALSE(has_remnants(w));
        // More than 1000: it did not listen yet, or no longer.
        if (status == 0 || (status > 1000 && !w.said().empty())) {
            CHECK(test::content_of(w.directory / "out.obj") == expected);
            seconds *= 0.95;
            continue;
        }
        ++n_stopped;
        if (status > 1000)
            continue;
        CHECK(status == (i % 2 == 0 ? 130 : 143));
        CHECK_FALSE(w.has("out.obj"));
        const bool is_step = w.has("out.interrupted.obj");
        CHECK(is_step == (w.count_lines("said", "step ") > 0));
        if (is_step)
            CHECK(test::content_of(w.directory / "out.interrupted.obj") ==
                  test::content_of(w.directory / ("at-" + step_of_interrupted(w) + ".obj")));
    }
    CHECK(n_stopped > 2);
}

TEST_CASE("a second signal ends the program at once")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " triangles large.ply --vertices 150000") == 0);
    RunningProgram program = start(w, "large.ply out.ply --time-step-edges 3 --subdomains 1 --steps 9 --verbose");
    await(w, program, "\nstep 1 ");
    sleep_for(0.02);
    program.send(SIGINT);
    sleep_for(0.02);
    program.send(SIGINT);
    CHECK(program.wait() == 1000 + SIGINT);
    CHECK_FALSE(w.has("out.ply"));
    CHECK_FALSE(has_remnants(w));
}

TEST_CASE("a signal that is ignored from the start stays ignored")
{
    const Workshop w;
    REQUIRE(w.run("(trap '' INT; " SMOOTH " mesh.obj out.obj --time-step 1e-9 --steps 300 & sleep 0.02; kill -INT $!; "
                  "wait $!)") == 0);
    CHECK(w.has("out.obj"));
}

TEST_CASE("whenever the program is killed, every output file is as it was before, or whole")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " quads large.obj --vertices 4000") == 0);
    const std::string arguments = " --time-step-edges 2 --steps 2 --every-step at-%d.obj --report report.json "
                                  "--parts parts.ply --checkpoint kept";
    const auto begin = Clock::now();
    REQUIRE(w.smooth("large.obj expected.obj" + arguments) == 0);
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    const std::string expected = test::content_of(w.directory / "expected.obj");
    const std::string parts = test::content_of(w.directory / "parts.ply");
    const std::string steps[] = {test::content_of(w.directory / "at-1.obj"),
                                 test::content_of(w.directory / "at-2.obj")};
    const auto is_whole = [&](const char* name, const std::string& content) {
        return !w.has(name) || test::content_of(w.directory / name) == content;
    };
    std::mt19937 random(4);
    int n_killed = 0;
    // More of them where the run that was measured took longer than others do, so that few are killed in time.
    for (int i = 0; i < 50 || (n_killed <= 20 && i < 500); ++i) {
        CAPTURE(i);
        for (const char* name : {"at-1.obj", "at-2.obj", "report.json", "parts.ply"})
            std::filesystem::remove(w.directory / name);
        if (i % 3 == 0)
            std::filesystem::remove_all(w.directory / "kept");
        const bool there_before = i % 2 == 0;
        if (there_before)
            static_cast<void>(w.directory.with("out.obj", "old"));
        else
            std::filesystem::remove(w.directory / "out.obj");
        RunningProgram program = start(w, "large.obj out.obj" + arguments);
        sleep_for(seconds * static_cast<double>(random() % 1000) / 1000.0);
        program.send(SIGKILL);
        n_killed += program.wait() == 1000 + SIGKILL ? 1 : 0;
        REQUIRE(w.has("out.obj") >= there_before);
        CHECK(((there_before && test::content_of(w.directory / "out.obj") == "old") || is_whole("out.obj", expected)));
        CHECK(is_whole("at-1.obj", steps[0]));
        CHECK(is_whole("at-2.obj", steps[1]));
        CHECK(is_whole("parts.ply", parts));
        if (w.has("report.json"))
            CHECK_NOTHROW(static_cast<void>(w.json("report.json")));
    }
    CHECK(n_killed > 20);
    // And the checkpoint is of use whatever happened.
    REQUIRE(w.smooth("large.obj out.obj" + arguments) == 0);
    CHECK(test::content_of(w.directory / "out.obj") == expected);
}

TEST_CASE("a terminal gets a progress bar, which is gone in the end; anything else no control codes")
{
    const Workshop w;
    ::setenv("TERM", "xterm", 1);
    int master = -1;
    int slave = -1;
    winsize size{.ws_row = 24, .ws_col = 50, .ws_xpixel = 0, .ws_ypixel = 0};
    REQUIRE(::openpty(&master, &slave, nullptr, nullptr, &size) == 0);
    const std::string arguments = "mesh.obj out.obj --time-step 1e-9 --steps 40";
    for (const bool quiet : {false, true}) {
        RunningProgram program(w.directory.path(), SMOOTH, arguments + (quiet ? " --quiet" : ""), slave);
        CHECK(program.wait() == 0);
        ::fcntl(master, F_SETFL, O_NONBLOCK);
        std::string seen(100'000, ' ');
        const ssize_t n = ::read(master, seen.data(), seen.size());
        seen.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
        const std::string erase = "\r\033[K";
        if (quiet) {
            CHECK(seen.empty());
            CHECK(w.said().empty());
            continue;
        }
        CHECK(seen.find("cutting") != std::string::npos);
        CHECK(seen.find(" %") != std::string::npos);
        CHECK(seen.ends_with(erase));
        for (std::size_t begin = 0; begin < seen.size(); begin += erase.size()) {
            const std::size_t end = std::min(seen.find(erase, begin), seen.size());
            CHECK(end - begin < 50);
            begin = end;
        }
        CHECK(w.count_lines("said", "step ") == 0);
        CHECK(w.count_lines("said", "result ") == 1);
        CHECK(w.said().find('\033') == std::string::npos);
    }
    ::close(master);
    ::close(slave);
    REQUIRE(w.smooth(arguments) == 0);
    CHECK(w.said().find_first_of("\r\033") == std::string::npos);
    REQUIRE(w.smooth(arguments + " --quiet") == 0);
    CHECK(w.said().empty());
}
