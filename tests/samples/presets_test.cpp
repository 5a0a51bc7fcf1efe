#include <string>

#include "tests/samples/workshop.h"

using seamflow::test::Workshop;

namespace {

/// The options that a run said it had chosen.
std::string chosen(const Workshop& w)
{
    const std::string said = w.said();
    const std::size_t line = said.find("preset     ");
    REQUIRE(line != std::string::npos);
    const std::size_t begin = said.find(": ", line) + 2;
    return said.substr(begin, said.find('\n', begin) - begin);
}

}  // namespace

TEST_CASE("what a preset chooses is said as options that give the same bytes")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere sphere.obj --vertices 3000") == 0);
    REQUIRE(w.run(GENERATE " box box.obj --vertices 3000 --noise 0.2") == 0);
    for (const std::string name : {"scan", "cad", "terrain", "fair"}) {
        CAPTURE(name);
        const std::string mesh = name == "cad" ? "box.obj" : "sphere.obj";
        REQUIRE(w.smooth(mesh + " by_preset.obj --report report.json --preset " + name) == 0);
        CHECK(w.json("report.json")["preset"] == name);
        CHECK(w.json("report.json").contains("noise") == (name == "scan" || name == "terrain"));
        REQUIRE(w.smooth(mesh + " by_options.obj " + chosen(w)) == 0);
        CHECK(w.run("cmp by_preset.obj by_options.obj") == 0);
    }
}

TEST_CASE("without an amount a mesh loses its noise, and hardly anything else")
{
    const Workshop w;
    for (const char* noise : {"0.1", "0.3"}) {
        const std::string shape = " --vertices 20000 --amplitude 0.05 --noise ";
        REQUIRE(w.run(GENERATE " noisy-sphere noisy.obj" + shape + noise) == 0);
        REQUIRE(w.run(GENERATE " noisy-sphere true.obj" + shape + "0") == 0);
        REQUIRE(w.smooth("noisy.obj out.obj") == 0);
        CHECK(chosen(w).find("--order 3") != std::string::npos);
        const auto distance = [&](const char* mesh) {
            REQUIRE(w.run(std::string(COMPARE " true.obj ") + mesh + " --report distance.json") == 0);
            return w.json("distance.json")["h_rms"].get<double>();
        };
        CHECK(distance("out.obj") < 0.4 * distance("noisy.obj"));
    }
}

TEST_CASE("options that are given go before those of a preset")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere sphere.obj --vertices 3000") == 0);
    REQUIRE(w.smooth("sphere.obj out.obj --laplacian fujiwara --steps 2") == 0);
    CHECK(chosen(w).starts_with("--order 3 --time-step-edges"));
    REQUIRE(w.smooth("mesh.obj out.obj --preset fair --time-step-edges 2") == 0);
    CHECK(chosen(w) == "--laplacian virtual-refinement --flow conformalized --steps 5 ");
    REQUIRE(w.smooth("mesh.obj out.obj --keep-edges 50") == 0);
    CHECK(chosen(w) == "--time-step-edges 32");
    REQUIRE(w.smooth("mesh.obj out.obj --laplacian ptackova-velho") == 0);
    CHECK(chosen(w).find("--filter") == std::string::npos);
    REQUIRE(w.smooth("mesh.obj out.obj --time-step 1e-3") == 0);
    CHECK(w.said().find("preset ") == std::string::npos);
}

TEST_CASE("reports name the flow that was taken")
{
    const Workshop w;
    REQUIRE(w.run(GENERATE " noisy-sphere sphere.obj --vertices 1000") == 0);
    REQUIRE(w.smooth("sphere.obj out.obj --verbose --keep-edges 25 --time-step-edges 8 --report report.json") == 0);
    CHECK(w.said().find("flow       edges sharper than 25 degrees kept, time step") != std::string::npos);
    CHECK(w.json("report.json")["keep_edges"] == 25.0);
    CHECK(!w.json("report.json").contains("approach"));
    CHECK(w.json("report.json")["rescale"] == "none");
    REQUIRE(w.smooth("sphere.obj out.obj --flow conformalized --filter low-pass --laplacian virtual-refinement "
                     "--attach 0.5 --rescale volume --time-step-edges 8 --verbose --report report.json") == 0);
    CHECK(w.said().find(
              "virtual-refinement, conformalized, low-pass of order 2, attached with 4 / length², volume kept, time") !=
          std::string::npos);
    CHECK(w.json("report.json")["rescale"] == "volume");
    CHECK(w.json("report.json")["attachment"] == 4.0);
    CHECK(!w.json("report.json").contains("keep_edges"));
}
