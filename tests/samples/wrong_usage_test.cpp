// Command lines that mean nothing.

#include <string>
#include <utility>

#include "tests/samples/workshop.h"

using namespace seamflow;
using test::Workshop;

TEST_CASE("wrong usage ends with 2 and writes nothing")
{
    const Workshop w;
    for (const char* arguments : {
             "",
             "mesh.obj",
             "mesh.obj out.obj --plain",
             "mesh.obj out.obj --scheme explicit",
             "mesh.obj out.obj --preset best",
             "mesh.obj out.obj --preset scan --conditions robin",
             "mesh.obj out.obj --preset cad --subdomains 4",
             "mesh.obj out.obj --time-step 0.05x",
             "mesh.obj out.obj --time-step nan",
             "mesh.obj out.obj --time-step 0",
             "mesh.obj out.obj --time-step -1",
             "mesh.obj out.obj --time-step",
             "mesh.obj out.obj --time-step 1 --time-step-edges 1",
             "mesh.obj out.obj --time-step 1 --radius 2%",
             "mesh.obj out.obj --radius 2mm",
             "mesh.obj out.obj --time-step 1 --boundary natural",
             "mesh.obj out.obj --time-step 1 --boundary free --laplacian ptackova-velho",
             "mesh.obj out.obj --time-step 1 --boundary free --subdomains 4 --conditions robin",
             "mesh.obj out.obj --time-step 1 --fix-property locked",
             "mesh.obj out.obj --time-step 1 --fix labels.txt --fix-property locked",
             "mesh.obj out.obj --time-step 1 --region nowhere",
             "mesh.obj out.obj --time-step 1 --region labels.txt --region-property s",
             "mesh.obj out.obj --time-step 1 --region labels.txt --report labels.txt",
             "mesh.obj out.obj --time-step 1 --region labels.txt --converge never",
             "mesh.obj out.obj --time-step 1 --feather 3",
             "mesh.obj out.obj --time-step 1 --direction w",
             "mesh.obj out.obj --time-step 1 --direction 0,0",
             "mesh.obj out.obj --time-step 1 --direction 0,0,0",
             "mesh.obj out.obj --time-step 1 --direction 0,0,1,0",
             "mesh.obj out.obj --time-step 1 --direction z --rescale area --boundary free",
             "mesh.obj out.obj --time-step 1 --report ./out.obj",
             "mesh.obj out.obj --time-step 1 --report a.json --trace ./a.json",
             "mesh.obj out.obj --time-step 1 --report folder --checkpoint ./folder",
             "mesh.obj out.obj --time-step 1 --converge 1e-4 --plain",
             "mesh.obj out.obj --time-step 1 --converge 1e-4 --p 3",
             "mesh.obj out.obj --time-step 1 --converge never --converge-iterations 3",
             "mesh.obj out.obj --time-step 1 --approach fast",
             "mesh.obj out.obj --time-step 1 --approach sweep --converge 1e-4",
             "mesh.obj out.obj --time-step 1 --approach converged --p 3",
             "mesh.obj out.obj --time-step 1 --approach cg --sweep fixed",
             "mesh.obj out.obj --time-step 1 --approach cg --subdomains 4",
             "mesh.obj out.obj --time-step 1 --approach cg --laplacian ptackova-velho",
             "mesh.obj out.obj --time-step 1 --p 3 --p-rule paper",
             "mesh.obj out.obj --radius 1e300",
             "mesh.obj out.obj --time-step 1 --rescale length",
             "mesh.obj out.obj --time-step 1 --fix labels.txt --rescale area",
             "mesh.obj out.obj --time-step 1 --p 0",
             "mesh.obj out.obj --time-step 1 --steps -1",
             "mesh.obj out.obj --time-step 1 --steps 1.5",
             "mesh.obj out.obj --time-step 1 --subdomains 99999999999",
             "mesh.obj out.obj --time-step 1 --subdomains 2 --labels labels.txt",
             "mesh.obj out.obj --time-step 1 --laplacian cotan",
             "mesh.obj out.obj --time-step 1 --laplacian 1",
             "mesh.obj out.obj --time-step 1 --coloring best",
             "mesh.obj out.obj --time-step 1 --conditions none",
             "mesh.obj out.obj --time-step 1 --plain --sweep alternating",
             "mesh.obj out.obj --time-step 1 --threads 1025",
             "mesh.obj out.obj --time-step 1 --threads 65537",
             "mesh.obj out.obj --radius 1% --threads 2147483647",
             "mesh.obj out.obj --time-step 1 --overlap 2",
             "mesh.obj out.obj --time-step 1 --conditions schwarz --overlap 0",
             "mesh.obj out.obj --time-step 1 --conditions schwarz --sweep alternating",
             "mesh.obj out.obj --time-step 1 --conditions schwarz --p 3",
             "mesh.obj out.obj --time-step 1 --conditions ventcell",
             "mesh.obj out.obj --time-step 1 --conditions robin --q 0.1",
             "mesh.obj out.obj --time-step 1 --conditions robin --transmission predicted",
             "mesh.obj out.obj --time-step 1 --keep-gaps",
             "mesh.obj out.obj --time-step 1 --conditions schwarz --keep-gaps",
             "mesh.obj out.obj --time-step 1e-9 --conditions robin --scheme explicit --keep-gaps",
             "mesh.obj out.obj --time-step 1 --keep-edges 0",
             "mesh.obj out.obj --time-step 1 --keep-edges 180",
             "mesh.obj out.obj --time-step 1 --keep-edges sharp",
             "mesh.obj out.obj --time-step 1 --keep-edges 30 --subdomains 4",
             "mesh.obj out.obj --time-step 1 --keep-edges 30 --converge 1e-4",
             "mesh.obj out.obj --time-step 1 --scheme euler",
             "mesh.obj out.obj --time-step 1 --scheme explicit",
             "mesh.obj out.obj --time-step 1 --every-step step.obj",
             "mesh.obj out.obj --time-step 1 --every-step %d%s.obj",
             "mesh.obj out.obj --time-step 1 --parts parts.obj",
             "mesh.obj out.obj --time-step 1 --report out.obj",
             "mesh.obj - --time-step 1 --report -",
             "mesh.obj out.obj --time-step 1 --parts -",
             "mesh.obj out.obj --time-step 1 --fix -",
             "mesh.obj out.obj --time-step 1 --report mesh.obj",
             "mesh.obj out.obj --time-step 1 --trace out.obj",
             "mesh.obj out.obj --time-step 1 --trace mesh.obj",
             "mesh.obj out.obj --time-step 1 --trace a.json --report a.json",
             "mesh.obj out.obj --time-step 1 --html out.obj",
             "mesh.obj out.obj --time-step 1 --html mesh.obj",
             "mesh.obj out.obj --time-step 1 --html a.html --report a.html",
             "mesh.obj out.obj --time-step 1e-7 --scheme explicit --trace trace.json",
             "mesh.obj out.obj --time-step 1 --memory-limit 0",
             "mesh.obj out.obj --time-step 1 --subdomains 4 --memory-limit 1",
             "mesh.obj out.obj --time-step 1 --memory-limit lots",
             "mesh.obj out.xyz --time-step 1",
             "mesh.obj out.obj more.obj --time-step 1",
             "mesh.obj out.obj --time-step 1 --speed 3",
         }) {
        CAPTURE(arguments);
        CHECK(w.smooth(arguments) == 2);
        CHECK_FALSE(w.said().empty());
        CHECK_FALSE(w.has("out.obj"));
    }
    CHECK(w.run(COMPARE " mesh.obj") == 2);
    CHECK(w.run(COMPARE " mesh.obj mesh.obj --report mesh.obj") == 2);
    CHECK(w.run(COMPARE " mesh.obj mesh.obj --direction sideways") == 2);
    CHECK(w.run(COMPARE " mesh.obj mesh.obj --error-map map.obj") == 2);
    CHECK(w.run(COMPARE " mesh.obj mesh.obj --error-map map.ply --show everything") == 2);
    CHECK(w.run(COMPARE " mesh.obj mesh.obj --error-map map.ply --full-scale 0") == 2);
    CHECK(w.run(COMPARE " mesh.obj mesh.obj --error-map map.ply --report map.ply") == 2);
    CHECK(w.run(COMPARE " mesh.obj mesh.obj --show normal") == 2);
    CHECK_FALSE(w.has("map.ply"));
    CHECK(w.run(GENERATE " dodecahedron out.obj") == 2);
    CHECK(w.run(GENERATE " quads out.obj --vertices many") == 2);
    CHECK(w.run(GENERATE " quads out.xyz") == 2);
}

TEST_CASE("smooth is refused as one of several processes of a launcher, which one of them says")
{
    const Workshop w;
    const std::string command = SMOOTH " mesh.obj out.obj --time-step 0.01";
    for (const std::string launcher : {"OMPI_COMM_WORLD", "PMI", "MV2_COMM_WORLD"}) {
        CAPTURE(launcher);
        const auto as_process = [&](const std::string& rank, const std::string& size) {
            return launcher + "_SIZE=" + size + " " + launcher + "_RANK=" + rank + " " + command;
        };
        CHECK(w.run(as_process("0", "4")) == 2);
        CHECK(w.said().find("4 processes were started") != std::string::npos);
        CHECK(w.said().find("without mpirun") != std::string::npos);
        CHECK(w.run(as_process("3", "4")) == 2);
        CHECK(w.said().empty());
        CHECK_FALSE(w.has("out.obj"));
        CHECK(w.run(as_process("0", "1")) == 0);
        CHECK(w.run("rm out.obj") == 0);
    }
}

TEST_CASE("usage errors begin with the name of the program, and an option mistyped is answered with the nearest one")
{
    const Workshop w;
    for (const auto& example :
         {std::pair{"mesh.obj out.obj --radus 1%", "smooth: there is no option --radus; did you mean --radius?"},
          {"mesh.obj out.obj --approch=cg --radius 1%",
           "smooth: there is no option --approch; did you mean --approach?"},
          {"mesh.obj out.obj --keep-edge 3", "smooth: there is no option --keep-edge; did you mean --keep-edges?"},
          {"mesh.obj out.obj --qwertyuiop", "smooth: there is no option --qwertyuiop (--help"},
          {"mesh.obj out.obj more.obj --radius 1%", "smooth: 'more.obj' is one argument too many"},
          {"mesh.obj --radius 1%", "smooth: OUTPUT is required"},
          {"missing.obj out.obj --radius 1% --conditions adapted-ventcell",
           "smooth: --conditions adapted-ventcell needs --q, the Ventcell parameter"},
          {"mesh.obj out.obj --steps 1.5 --radius 1%", "smooth: --steps: "}}) {
        const auto& arguments = example.first;
        const auto& sentence = example.second;
        CAPTURE(arguments);
        CHECK(w.smooth(arguments) == 2);
        CHECK(w.said().starts_with(sentence));
        CHECK(!w.has("out.obj"));
    }
}

TEST_CASE("what takes the whole mesh without equations rules out what is about them, by name")
{
    const Workshop w;
    const std::string whole = " is given, which takes the whole mesh without equations and rules out ";
    for (const auto& example : {
             std::pair{std::string("--time-step 1 --keep-edges 30 --scheme explicit"),
                       "--keep-edges" + whole + "--scheme: leave one of them out"},
             {"--time-step 1 --keep-edges 30 --subdomains 2", "--keep-edges" + whole + "sub-meshes: leave one"},
             {"--time-step 1 --keep-edges 30 --coloring label", "--keep-edges" + whole + "--coloring: leave one"},
             {"--time-step 1 --keep-edges 30 --approach cg", "--keep-edges" + whole + "--approach: leave one"},
             {"--time-step 1 --keep-edges 30 --converge 1e-3", "--keep-edges" + whole + "--converge: leave one"},
             {"--time-step 1 --keep-edges 30 --reference", "--keep-edges" + whole + "--reference: leave one"},
             {"--time-step 1 --keep-edges 30 --laplacian uniform", "--keep-edges" + whole + "--laplacian: leave one"},
             {"--time-step 1 --keep-edges 30 --filter low-pass", "--keep-edges" + whole + "another flow, a filter"},
             {"--preset cad --reference", "--preset cad" + whole + "--reference: leave one"},
             {"--radius 1% --boundary smooth --subdomains 3", "--boundary smooth" + whole + "sub-meshes"},
             {"--radius 1% --boundary smooth --keep-edges 30", "--boundary is smooth, so that it alone moves"},
             {"--time-step 1 --edges labels.txt", "--edges names edges to keep: give --preset cad, or --keep-edges"},
             {"--within 1,1",
              "--within: \"1,1\" is neither a positive length (0.5), nor a part of the bounding box's diagonal (2%), "
              "nor three of these, along x, y and z (1,1,0.2)"},
             {"--within 1,2%,0", "--within: \"1,2%,0\" is neither a positive length"},
             {"--within -1", "--within: \"-1\" is neither a positive length"},
             {"--time-step 1 --keep-edges 30 --edges labels.txt --within 1",
              "--rescale and --within move vertices off --edges"},
         }) {
        const std::string& arguments = example.first;
        const std::string& sentence = example.second;
        CAPTURE(arguments);
        CHECK(w.smooth("mesh.obj out.obj " + arguments) == 2);
        CHECK_MESSAGE(w.said().starts_with("smooth: " + sentence), w.said());
        CHECK(!w.has("out.obj"));
    }
}

TEST_CASE("a refused command line removes the report of an earlier run, and no other file")
{
    const Workshop w;
    for (const std::string refused : {"mesh.obj out.obj --radius 1% --steps -1 ", "mesh.obj out.obj --radus 1% ",
                                      "mesh.obj missing/out.obj --radius 1% "})
        for (const std::string report : {"--report report.json", "--report=report.json"}) {
            CAPTURE(refused);
            REQUIRE(w.smooth("mesh.obj out.obj --time-step-edges 1 " + report) == 0);
            REQUIRE(w.has("report.json"));
            CHECK(w.smooth(refused + report) != 0);
            CHECK_FALSE(w.has("report.json"));
            static_cast<void>(w.directory.with("report.json", "{\n  \"mine\": 1}"));
            CHECK(w.smooth(refused + report) != 0);
            CHECK(w.has("report.json"));
        }
}
