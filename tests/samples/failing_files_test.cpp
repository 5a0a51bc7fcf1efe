// A disk that is full or broken, at any call of the system: the exit status, the message, and what is left.

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "tests/samples/workshop.h"
#include "tests/support/sanitizers.h"

using namespace seamflow;
using test::Workshop;
namespace fs = std::filesystem;

namespace {

/// One way in which a call of the system fails (see failing_calls.cpp).
struct Fault {
    std::string call;
    int error;
    std::string further = {};
};

/// Runs a program whose n-th such call fails.
/// @returns its exit status, or -1 if there are not so many calls.
int run_with(const Workshop& w, const std::string& command, const Fault& fault, int n)
{
    fs::remove(w.directory / "failed");
    const std::string folder = fs::canonical(w.directory.path()).string();
    const int status = w.run("env LD_PRELOAD=" FAILING_CALLS " FAIL_UNDER='" + folder + "' FAIL_CALL=" + fault.call +
                             " FAIL_AT=" + std::to_string(n) + " FAIL_WITH=" + std::to_string(fault.error) +
                             " FAIL_NOTE='" + folder + "/failed' " + fault.further + "timeout 60 " + command);
    return w.has("failed") ? status : -1;
}

bool is_remnant(const fs::path& path)
{
    return path.filename().string().starts_with(".seamflow");
}

/// Whether standard error ends with a message of the program that names one of the files and the system's reason.
bool is_explained(const Workshop& w, const std::vector<std::string>& files, int error)
{
    const std::string said = w.said();
    const std::size_t line = said.rfind('\n', said.size() - 2) + 1;
    const std::string last = said.substr(line);
    const auto is_named = [&](const std::string& file) { return last.find(file + ": ") != std::string::npos; };
    return std::any_of(files.begin(), files.end(), is_named) && last.find(std::strerror(error)) != std::string::npos;
}

/// Whether a file has all that a run without failures writes. Reports and pages have times in them, which differ.
bool is_whole(const std::string& name, const std::string& content, const std::string& of_other_run)
{
    if (name.ends_with(".json"))
        return test::Json::accept(content);
    if (name.ends_with(".html"))
        return content.ends_with(of_other_run.substr(of_other_run.rfind("</")));
    return content == of_other_run;
}

/// Not every file system has files without a name.
bool has_files_without_name(const fs::path& folder)
{
    const int descriptor = ::open(folder.c_str(), O_WRONLY | O_TMPFILE, 0600);
    if (descriptor >= 0)
        ::close(descriptor);
    return descriptor >= 0;
}

/// The ways in which calls can fail that have to do with outputs in this folder. Where a file without a name cannot be
/// opened, one with a name is: so that this fails is of no consequence.
std::vector<Fault> faults_of_outputs(const fs::path& folder)
{
    std::vector<Fault> faults{{"open", EACCES, "NO_TMPFILE=1 "},
                              {"write", ENOSPC},
                              {"write", EIO, "NO_TMPFILE=1 SHORT=1 "},
                              {"fsync", EIO},
                              {"close", EIO},
                              {"rename", EIO, "NO_TMPFILE=1 "}};
    if (has_files_without_name(folder))
        faults.push_back({"linkat", ENOSPC});
    return faults;
}

/// Lets every call of a program fail that has to do with its outputs. Each of these files is there before, whole
/// afterwards, and never there in part.
/// @param own files that the program makes for itself and may name as well.
void fail_every_output(const Workshop& w, const std::string& command, const std::vector<std::string>& outputs,
                       const std::vector<std::string>& own = {})
{
    std::vector<std::string> files = outputs;
    files.insert(files.end(), own.begin(), own.end());
    const auto begin_anew = [&] {
        for (const std::string& name : outputs)
            static_cast<void>(w.directory.with(name, "old"));
    };
    begin_anew();
    REQUIRE(w.run(command) == 0);
    std::vector<std::string> whole;
    for (const std::string& name : outputs)
        whole.push_back(test::content_of(w.directory / name));
    for (const Fault& fault : faults_of_outputs(w.directory.path())) {
        int n = 1;
        int n_harmless = 0;
        for (;; ++n) {
            CAPTURE(command);
            CAPTURE(fault.call);
            CAPTURE(fault.further);
            CAPTURE(n);
            begin_anew();
            const int status = run_with(w, command, fault, n);
            if (status < 0)
                break;
            CAPTURE(w.said());
            // Room that was reserved for the result is given back, which matters to nothing.
            if (fault.call == "close" && status == 0) {
                CHECK(++n_harmless == 1);
                for (std::size_t i = 0; i < outputs.size(); ++i)
                    CHECK(is_whole(outputs[i], test::content_of(w.directory / outputs[i]), whole[i]));
                continue;
            }
            CHECK(status == 5);
            CHECK(is_explained(w, files, fault.error));
            int n_old = 0;
            for (std::size_t i = 0; i < outputs.size(); ++i) {
                const std::string content = test::content_of(w.directory / outputs[i]);
                CAPTURE(outputs[i]);
                n_old += content == "old" ? 1 : 0;
                CHECK((content == "old" || is_whole(outputs[i], content, whole[i])));
            }
            CHECK(n_old > 0);
            for (const auto& entry : fs::recursive_directory_iterator(w.directory.path()))
                CHECK_FALSE(is_remnant(entry.path()));
        }
        CHECK(n > static_cast<int>(outputs.size()));
    }
}

}  // namespace

TEST_CASE("whatever call fails while smooth writes: status 5, the reason, every file whole or as it was" *
          doctest::skip(test::under_sanitizers))
{
    const Workshop w;
    fail_every_output(w,
                      SMOOTH " mesh.obj out.obj --time-step-edges 2 --subdomains 3 --every-step at-%d.ply --parts "
                             "parts.ply --report report.json --trace trace.json",
                      {"out.obj", "at-1.ply", "parts.ply", "report.json", "trace.json"});
    if (HAS_PAGE)
        fail_every_output(w, SMOOTH " mesh.obj out.obj --time-step-edges 2 --html page.html", {"out.obj", "page.html"});
}

TEST_CASE("the same of a checkpoint: the next run continues from the one before" *
          doctest::skip(test::under_sanitizers))
{
    const Workshop w;
    const std::string command = SMOOTH " mesh.obj out.obj --time-step-edges 2 --checkpoint kept --steps ";
    REQUIRE(w.run(command + "1") == 0);
    const std::string before = test::content_of(w.directory / "kept/smooth.checkpoint");
    for (const Fault& fault : faults_of_outputs(w.directory.path())) {
        CAPTURE(fault.call);
        REQUIRE(run_with(w, command + "2", fault, 1) == 5);
        CHECK(is_explained(w, {"smooth.checkpoint"}, fault.error));
        CHECK(test::content_of(w.directory / "kept/smooth.checkpoint") == before);
    }
    REQUIRE(w.run(command + "2") == 0);
    CHECK(w.said().find("resumed    after step 1") != std::string::npos);
}

TEST_CASE("the same of the other programs" * doctest::skip(test::under_sanitizers))
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " mixed other.obj --vertices 900 --noise 0.1") == 0);
    for (const std::string name : {"a.obj", "a.off", "a.ply", "a.stl"})
        fail_every_output(w, GENERATE " triangles " + name + " --vertices 100", {name});
    fail_every_output(w, COMPARE " mesh.obj other.obj --report compared.json --error-map map.ply",
                      {"compared.json", "map.ply"});
    fail_every_output(w,
                      BENCHMARK " --vertices 200 --peers none --threads 1 --subdomains 2 --steps 1 "
                                "--json benchmark.json",
                      {"benchmark.json"}, {"input.ply", "task"});
}

TEST_CASE("whatever call fails while a file is read: status 3, and a message that names it" *
          doctest::skip(test::under_sanitizers))
{
    const Workshop w;
    for (const std::string name : {"a.obj", "a.off", "a.ply", "a.stl"})
        REQUIRE(w.run(GENERATE " triangles " + name + " --vertices 100") == 0);
    static_cast<void>(w.directory.with("held", "1\n2\n"));
    REQUIRE(w.smooth("a.obj out.obj --time-step 1e-9 --checkpoint kept") == 0);
    std::vector<std::string> commands{SMOOTH " a.obj out.obj --time-step 1e-9 --checkpoint kept",
                                      SMOOTH " a.obj out.obj --time-step 1e-9 --fix held", COMPARE " a.obj a.ply"};
    for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl"})
        commands.push_back(std::string(INSPECT " ") + name);
    for (const std::string& command : commands)
        for (const std::string further : {"", "SHORT=1 "}) {
            int n = 1;
            for (;; ++n) {
                CAPTURE(command);
                CAPTURE(n);
                const int status = run_with(w, command, {"read", EIO, further}, n);
                if (status < 0)
                    break;
                CAPTURE(w.said());
                // The end of a text is found whether or not another read confirms it.
                CHECK(status == 3);
                CHECK(w.said().find(" be read") != std::string::npos);
            }
            CHECK(n > 1);
        }
}

TEST_CASE("calls that do a part of the work only are repeated, and change no result" *
          doctest::skip(test::under_sanitizers))
{
    const Workshop w;
    REQUIRE(w.smooth("mesh.obj expected.obj --time-step-edges 2") == 0);
    CHECK(run_with(w, SMOOTH " mesh.obj out.obj --time-step-edges 2", {"none", 0, "SHORT=1 "}, 1) == -1);
    CHECK(test::content_of(w.directory / "out.obj") == test::content_of(w.directory / "expected.obj"));
}

TEST_CASE("standard output that is full is said, with status 5, by every program")
{
    const Workshop w;
    for (const std::string command : {SMOOTH " mesh.obj out.obj --time-step 1e-9", INSPECT " mesh.obj",
                                      COMPARE " mesh.obj mesh.obj", GENERATE " quads a.ply --vertices 100",
                                      SMOOTH " --help", BENCHMARK " --vertices 200 --peers none --steps 1"}) {
        CAPTURE(command);
        CHECK(w.run("(" + command + " >/dev/full)") == 5);
        CHECK(w.said().find("standard output could not be written") != std::string::npos);
    }
}
