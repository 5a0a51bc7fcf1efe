// Runs that resume from a checkpoint.

#include <random>
#include <string>
#include <thread>

#include "tests/samples/running_program.h"
#include "tests/samples/workshop.h"

using namespace seamflow;
using test::Json;
using test::RunningProgram;
using test::Workshop;

namespace {

/// All that does not depend on time, nor on the command line.
Json results_in(Json report)
{
    for (const char* key : {"date", "seconds", "arguments", "output", "peak_memory_bytes", "page_faults",
                            "factor_memory_bytes", "live_factors", "threads"})
        report.erase(key);
    for (Json& step : report["steps"])
        for (const char* key : {"seconds", "reference_seconds"})
            step.erase(key);
    return report;
}

/// Runs until it has said that, or to its end.
void run_until(const Workshop& w, const std::string& arguments, const std::string& text)
{
    RunningProgram program(w.directory.path(), SMOOTH, arguments);
    while (program.runs() && w.said().find(text) == std::string::npos)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    program.send(SIGKILL);
    program.wait();
}

}  // namespace

TEST_CASE("a run that was killed goes on to the same bits and the same report")
{
    std::mt19937 random(5);
    for (const std::string flow :
         {"--converge never --subdomains 6", "--converge never --subdomains 6 --laplacian alexa-wardetzky",
          "--converge never --subdomains 6 --laplacian ptackova-velho", "--converge 1e-3 --subdomains 6",
          "--converge 1e-3 --subdomains 6 --laplacian alexa-wardetzky",
          "--converge 1e-2 --subdomains 4 --laplacian ptackova-velho", "--conditions schwarz --subdomains 6",
          "--conditions robin --subdomains 6", "--conditions ventcell --q 0.1 --subdomains 6 --keep-gaps",
          "--plain --subdomains 6", "--subdomains 1", "--converge never --subdomains 6 --reference",
          "--converge 1e-2 --reference", "--boundary free --rescale area", "--scheme explicit"}) {
        CAPTURE(flow);
        const Workshop w;
        const std::string time_step = flow == "--scheme explicit" ? "1e-9" : "1e-3";
        const std::string arguments = "mesh.obj out.obj --steps 6 --time-step " + time_step + " --report report.json ";
        REQUIRE(w.smooth(arguments + flow) == 0);
        const std::string expected = test::content_of(w.directory / "out.obj");
        const Json report = results_in(w.json("report.json"));
        std::filesystem::remove(w.directory / "out.obj");
        const std::string kept =
            arguments + flow + " --verbose --checkpoint kept --checkpoint-every " + std::to_string(1 + random() % 2);
        for (const int step : {2, 4})
            run_until(w, kept + " --threads " + std::to_string(1 + random() % 3),
                      "\nstep " + std::to_string(step) + " ");
        REQUIRE(w.smooth(kept) == 0);
        CHECK(w.said().find("resumed    after step ") != std::string::npos);
        CHECK(test::content_of(w.directory / "out.obj") == expected);
        const bool same_report = results_in(w.json("report.json")) == report;
        CHECK(same_report);
    }
}

TEST_CASE("--checkpoint changes no result, stays at the end, and lets more steps go on")
{
    const Workshop w;
    const std::string flow = " --time-step 1e-3 --subdomains 6 --converge never --steps ";
    REQUIRE(w.smooth("mesh.obj five.obj" + flow + "5") == 0);
    REQUIRE(w.smooth("mesh.obj three.obj" + flow + "3 --checkpoint kept/here --every-step at-%d.obj") == 0);
    CHECK(w.has("kept/here/smooth.checkpoint"));
    for (const char* name : {"at-1.obj", "at-3.obj"})
        std::filesystem::remove(w.directory / name);
    REQUIRE(w.smooth("mesh.obj again.obj" + flow + "3 --checkpoint kept/here --every-step at-%d.obj") == 0);
    CHECK(test::content_of(w.directory / "again.obj") == test::content_of(w.directory / "three.obj"));
    REQUIRE(w.smooth("mesh.obj more.obj" + flow +
                     "5 --checkpoint kept/here --every-step at-%d.obj --threads 1 --report report.json") == 0);
    CHECK(test::content_of(w.directory / "more.obj") == test::content_of(w.directory / "five.obj"));
    CHECK(w.json("report.json")["steps"].size() == 5);
    CHECK_FALSE(w.has("at-1.obj"));
    CHECK_FALSE(w.has("at-3.obj"));
    CHECK(w.has("at-4.obj"));
}

TEST_CASE("flows resume whatever the equation: the edge of uniform weights, the matrix of the linear flow")
{
    const Workshop w;
    for (const std::string flow :
         {" --laplacian uniform --converge never", " --laplacian uniform --approach cg",
          " --flow linear --subdomains 5", " --flow linear --filter low-pass --order 3 --approach undecomposed"}) {
        CAPTURE(flow);
        const std::string arguments = flow + " --time-step 1e-3 --steps ";
        REQUIRE(w.smooth("mesh.obj four.obj" + arguments + "4") == 0);
        REQUIRE(w.smooth("mesh.obj two.obj" + arguments + "2 --checkpoint kept") == 0);
        REQUIRE(w.smooth("mesh.obj more.obj" + arguments + "4 --checkpoint kept") == 0);
        CHECK(w.count_lines("said", "resumed ") == 1);
        CHECK(test::content_of(w.directory / "more.obj") == test::content_of(w.directory / "four.obj"));
        std::filesystem::remove_all(w.directory / "kept");
    }
}

TEST_CASE("a checkpoint of another run, or a damaged one, is refused with what to do")
{
    const Workshop w;
    const std::string flow = "mesh.obj out.obj --time-step 1e-3 --steps 3 --checkpoint kept ";
    REQUIRE(w.smooth(flow) == 0);
    std::filesystem::remove(w.directory / "out.obj");
    const auto refused = [&](const std::string& arguments, int status, const std::string& reason) {
        CAPTURE(arguments);
        CHECK(w.smooth(arguments) == status);
        CAPTURE(w.said());
        CHECK(w.said().find("kept/smooth.checkpoint: ") != std::string::npos);
        CHECK(w.said().find(reason) != std::string::npos);
        CHECK(w.said().find("remove it to start over") != std::string::npos);
        CHECK_FALSE(w.has("out.obj"));
    };
    const std::string another = "belongs to another input or to other options; continue with the same";
    refused("mesh.obj out.obj --time-step 2e-3 --steps 3 --checkpoint kept", 3, another);
    refused(flow + "--laplacian ptackova-velho", 3, another);
    refused("mesh.obj out.obj --time-step 1e-3 --steps 2 --checkpoint kept", 2, "is after step 3, but steps is 2");
    REQUIRE(w.run(GENERATE " mixed other.obj --vertices 900 --seed 7") == 0);
    refused("other.obj out.obj --time-step 1e-3 --steps 3 --checkpoint kept", 3, another);
    const std::string content = test::content_of(w.directory / "kept/smooth.checkpoint");
    static_cast<void>(w.directory.with("kept/smooth.checkpoint", content.substr(0, content.size() / 2)));
    refused(flow, 3, "is damaged");
    std::string older = content;
    older[std::string_view("seamflow checkpoint\n").size()] ^= 1;
    static_cast<void>(w.directory.with("kept/smooth.checkpoint", older));
    refused(flow, 3, "was written by another version of this program");
    static_cast<void>(w.directory.with("kept/smooth.checkpoint", ""));
    refused(flow, 3, "is not a checkpoint");
    CHECK(w.smooth("mesh.obj out.obj --time-step 1e-3 --checkpoint mesh.obj") == 5);
    CHECK(w.smooth("mesh.obj out.obj --time-step 1e-3 --checkpoint-every 3") == 2);
    CHECK(w.smooth(flow + "--checkpoint-every often") == 2);
    CHECK(w.smooth(flow + "--report kept/smooth.checkpoint") == 2);
}
