// smooth-distributed continues from checkpoints.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>
#include <string>

#include "engine/state/checksum.h"
#include "tests/samples/running_ranks.h"
#include "tests/samples/workshop.h"
#include "tests/support/relative.h"

using namespace seamflow;
using test::messages;
using test::on_ranks;
using test::on_ranks_of_which_one_is_killed;
using test::Workshop;
using test::write_soup;
namespace fs = std::filesystem;

TEST_CASE("a run continues from its checkpoint on any number of ranks, with the same bytes")
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
            double y = 0.0;
            double z = 0.0;
            if (words >> word; word == "v" && words >> x >> y >> z)
                far << "v " << x + 1000.0 << ' ' << y - 700.0 << ' ' << z + 400.0 << '\n';
            else
                far << line << '\n';
        }
    }
    REQUIRE(w.run(GENERATE " noisy-sphere ball.ply --vertices 9000") == 0);
    for (const std::string input :
         {"soup.obj n.obj --converge never", "far.obj n.obj --attach 5% --filter low-pass --converge never",
          "ball.ply n.ply --whole-up-to 1 --converge never",
          "mesh.obj n.obj --flow conformalized --sweep alternating --converge never",
          "soup.obj n.obj --converge 1e-3 --boundary free",
          "far.obj n.obj --filter low-pass --converge 1e-3 --attach 5%",
          "ball.ply n.ply --whole-up-to 1 --converge 1e-4 --laplacian alexa-wardetzky",
          "mesh.obj n.obj --flow conformalized --converge 1e-3 --laplacian fujiwara"}) {
        CAPTURE(input);
        const std::string result = input.substr(input.find(' ') + 1, 5);
        const std::string flow = input + " --time-step-edges 3 --subdomains 7 --threads 1 --steps ";
        REQUIRE(on_ranks(w, 2, flow + "5") == 0);
        const std::string expected = test::content_of(w.directory / result);
        fs::remove_all(w.directory / "c");
        REQUIRE(on_ranks(w, 3, flow + "2 --checkpoint c") == 0);
        CHECK((test::content_of(w.directory / result) != expected));
        // On more ranks than before: ranges begin within those that were kept.
        REQUIRE(on_ranks(w, 4, flow + "4 --checkpoint c --checkpoint-every 3") == 0);
        CHECK(w.count_lines("said", "resumed    after step 2, from c/smooth-distributed.checkpoint") == 1);
        REQUIRE(on_ranks(w, 1, flow + "5 --checkpoint c --report r.json --every-step s%d.ply") == 0);
        CHECK(w.count_lines("said", "resumed    after step 4, ") == 1);
        CHECK(w.count_lines("said", "remark     --every-step wrote no files for the steps up to 4, ") == 1);
        CHECK((test::content_of(w.directory / result) == expected));
        const double area = w.json("r.json")["surface"]["after"]["area"];
        // Nothing is left to do, and nothing of earlier steps remains.
        REQUIRE(on_ranks(w, 3, flow + "5 --checkpoint c --report r.json") == 0);
        CHECK((test::content_of(w.directory / result) == expected));
        CHECK(w.json("r.json")["surface"]["after"]["area"].get<double>() == test::relative(area, 1e-12));
        CHECK(std::distance(fs::directory_iterator(w.directory / "c"), {}) == 2);
    }
}

TEST_CASE("a checkpoint that belongs to another run of ranks, or is damaged, is refused with what to do")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " mixed other.obj --vertices 900 --seed 2") == 0);
    const std::string flow = "--time-step-edges 3 --converge never --threads 1 --checkpoint c";
    std::string ones;
    for (std::ptrdiff_t v = 0; v < w.count_lines("mesh.obj", "v "); ++v)
        ones += "1\n";
    (void)w.directory.with("ones", ones);
    (void)w.directory.with("some", "7\n11\n");
    REQUIRE(on_ranks(w, 2, "mesh.obj n.obj --subdomains 5 --steps 3 " + flow) == 0);
    const std::string kept = test::content_of(w.directory / "n.obj");
    const auto refused = [&](const std::string& arguments, int status, const std::string& what) {
        CAPTURE(arguments);
        CHECK(on_ranks(w, 3, arguments + " " + flow) == status);
        const auto said = messages(w, "smooth-distributed");
        REQUIRE(said.size() == 1);
        CHECK(said.front().find(what) != std::string::npos);
        CHECK(said.front().find("to start over") != std::string::npos);
        CHECK((test::content_of(w.directory / "n.obj") == kept));
    };
    refused("mesh.obj n.obj --subdomains 5 --steps 2", 2, "is after step 3, but steps is 2");
    refused("mesh.obj n.obj --subdomains 4 --steps 4", 2, "--subdomains was 5 then and is 4 now");
    refused("mesh.obj n.obj --subdomains 5 --steps 4 --attach 3%", 2, "--attach was 0 then");
    refused("mesh.obj n.obj --subdomains 5 --steps 4 --attach-weights ones", 2, "--attach-weights was ");
    refused("mesh.obj n.obj --subdomains 5 --steps 4 --fix some", 2, "--fix was ");
    refused("mesh.obj n.obj --subdomains 5 --steps 4 --laplacian virtual-refinement", 2, "--laplacian was ");
    refused("other.obj n.obj --subdomains 5 --steps 4", 3, "the mesh was ");
    const fs::path folder = w.directory / "c";
    const std::string list = test::content_of(folder / "smooth-distributed.checkpoint");
    std::string changed = list;
    changed[changed.size() / 2] = static_cast<char>(changed[changed.size() / 2] ^ 1);
    std::ofstream(folder / "smooth-distributed.checkpoint") << changed;
    refused("mesh.obj n.obj --subdomains 5 --steps 4", 3, "is damaged: it is not as it was written");
    changed = list;
    changed[changed.find('\n') + 1] = static_cast<char>(changed[changed.find('\n') + 1] ^ 1);
    std::ofstream(folder / "smooth-distributed.checkpoint") << changed;
    refused("mesh.obj n.obj --subdomains 5 --steps 4", 3, "was written by another version");
    // One array more than there is, in a list that is whole: its number follows the line, the format and the step.
    changed = list.substr(0, list.size() - sizeof(std::uint64_t));
    ++changed[changed.find('\n') + 1 + 4 + 8];
    Checksum checksum;
    checksum.add(std::as_bytes(std::span(changed)));
    const std::uint64_t value = checksum.value();
    changed.append(reinterpret_cast<const char*>(&value), sizeof value);
    std::ofstream(folder / "smooth-distributed.checkpoint", std::ios::binary) << changed;
    refused("mesh.obj n.obj --subdomains 5 --steps 4", 3, "does not hold what the list of the checkpoint says");
    std::ofstream(folder / "smooth-distributed.checkpoint") << list;
    std::string positions = test::content_of(folder / "smooth-distributed.step-3.1");
    if (positions.empty())
        positions = test::content_of(folder / "smooth-distributed.step-3.0");
    positions[positions.size() / 2] = static_cast<char>(positions[positions.size() / 2] ^ 1);
    for (const std::string rank : {"0", "1"})
        if (fs::file_size(folder / ("smooth-distributed.step-3." + rank)) > 0)
            std::ofstream(folder / ("smooth-distributed.step-3." + rank), std::ios::binary) << positions;
    refused("mesh.obj n.obj --subdomains 5 --steps 4", 3, "smooth-distributed.step-3.");
}

TEST_CASE("a rank that is killed leaves the output as it was, and a checkpoint from which others go on")
{
    const Workshop w;
    for (const std::string approach : {"--converge never", "--converge 1e-3"}) {
        CAPTURE(approach);
        fs::remove_all(w.directory / "c");
        const std::string flow =
            "mesh.obj n.obj --time-step-edges 0.1 --laplacian virtual-refinement --subdomains 6 --threads 1 " +
            approach;
        std::ofstream(w.directory / "n.obj") << "as it was\n";
        const int status = on_ranks_of_which_one_is_killed(w, flow + " --steps 100000 --checkpoint c",
                                                           "ls c 2>&1 | grep -q 'step-[3-9]'");
        CHECK(status > 0);
        CHECK(status != 124);
        CHECK((test::content_of(w.directory / "n.obj") == "as it was\n"));
        int last = 0;
        for (const auto& entry : fs::directory_iterator(w.directory / "c"))
            if (const std::string name = entry.path().filename().string(); name.find("step-") != std::string::npos)
                last = std::max(last, std::stoi(name.substr(name.find("step-") + 5)));
        const std::string steps = " --steps " + std::to_string(last + 2);
        REQUIRE(on_ranks(w, 2, flow + steps + " --checkpoint c") == 0);
        CHECK(w.count_lines("said", "resumed ") == 1);
        const std::string result = test::content_of(w.directory / "n.obj");
        REQUIRE(on_ranks(w, 3, flow + steps) == 0);
        CHECK((test::content_of(w.directory / "n.obj") == result));
    }
}
