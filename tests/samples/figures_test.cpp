#include <algorithm>
#include <cmath>
#include <sstream>

#include <doctest/doctest.h>

#include "partition/errors.h"
#include "partition/io/mesh_io.h"
#include "samples/common/meshes.h"
#include "samples/figures/claims.h"
#include "samples/figures/figures_command.h"
#include "samples/figures/picture.h"
#include "samples/figures/roughness.h"
#include "samples/figures/runner.h"
#include "samples/figures/surfaces.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

namespace {

constexpr Laplacian fujiwara = Laplacian::Fujiwara;
constexpr Laplacian velho = Laplacian::PtackovaVelho;

/// An experiment on a mesh small enough for a test.
Experiment small(std::string_view name, Index vertices = 500)
{
    const auto& all = experiments();
    Experiment experiment =
        *std::find_if(all.begin(), all.end(), [&](const Experiment& one) { return one.name == name; });
    experiment.source.vertices = vertices;
    return experiment;
}

Table run(const Experiment& experiment, const Places& places = {})
{
    std::ostringstream log;
    return run_experiment(experiment, places, log);
}

/// A row of a table that somebody made up.
Row row(Laplacian laplacian, const std::string& conditions, double v_mean)
{
    Row made;
    made.laplacian = laplacian;
    made.conditions = conditions;
    made.step = 5;
    made.v.mean = v_mean;
    return made;
}

Table wavy_table(double schwarz, double robin)
{
    Table table;
    table.figure = "wavy-cylinder";
    table.steps = 5;
    table.rows = {row(fujiwara, "schwarz", schwarz), row(fujiwara, "adapted-robin", robin),
                  row(velho, "schwarz", schwarz), row(velho, "adapted-robin", robin)};
    return table;
}

/// The exit status or exception of a command line.
std::optional<ExitStatus> parse(std::vector<std::string> words, FiguresCommand& command)
{
    words.insert(words.begin(), "figures");
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    return parse_figures_command(static_cast<int>(arguments.size()), arguments.data(), command);
}

/// Lines, and the number of fields in each that has no quotation marks.
std::vector<std::ptrdiff_t> fields_by_line(const std::string& csv)
{
    std::vector<std::ptrdiff_t> fields;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);)
        fields.push_back(std::count(line.begin(), line.end(), ',') + 1);
    return fields;
}

}  // namespace

TEST_CASE("the teaser on a small mesh: decomposed flows near the undecomposed ones")
{
    const Table table = run(small("teaser"));
    CHECK(table.mesh == "generated");
    CHECK_FALSE(table.as_authors);
    REQUIRE(table.rows.size() == 6 * 5);
    CHECK(table.remarks.empty());
    for (const Row& one : table.rows) {
        const bool decomposed = one.conditions == "adapted-robin";
        CHECK(one.subdomains == (decomposed ? 2 : 1));
        CHECK((one.v.mean > 0.0) == decomposed);
        CHECK(one.v.mean < 0.5);
        CHECK(one.h.mean <= one.v.mean);
        CHECK(one.v.max >= one.v.rms);
        CHECK(one.drift > 0.0);
        CHECK(one.roughness < table.roughness);
    }
    CHECK(claims_of(table).size() == 4);
}

TEST_CASE("the table of an experiment as CSV has one row per step and flow")
{
    const test::TemporaryDirectory folder;
    const Table table = run(small("texture"), {.meshes = {}, .pictures = folder.path()});
    write_csv(folder / "texture.csv", {table});
    const std::string csv = test::content_of(folder / "texture.csv");
    CHECK(csv.starts_with("figure,mesh,vertices,laplacian,conditions,subdomains,step,v_mean,v_rms,v_max,h_mean,h_rms,"
                          "h_max,seconds,options,drift_mean,roughness\n"
                          "texture,generated,506,fujiwara,undecomposed,1,1,0,0,0,0,0,0,"));
    CHECK(fields_by_line(csv) == std::vector<std::ptrdiff_t>(7, 17));
    // The input, and what came of it in six flows.
    CHECK(folder.n_files() == 1 + 7);
    CHECK(read_mesh(folder / "texture-alexa-wardetzky-adapted-robin.ply").mesh.n_vertices() == 506);
}

TEST_CASE("fields of CSV are quoted where they have to be")
{
    CHECK(csv_text("plain") == "plain");
    CHECK(csv_text("a, \"b\"") == "\"a, \"\"b\"\"\"");
    CHECK(csv_number(std::nan("")) == "nan");
    CHECK(csv_number(0.25) == "0.25");
}

TEST_CASE("claims are computed from the numbers of a table")
{
    CHECK(claims_of(wavy_table(0.2, 0.01))[0].holds);
    CHECK(claims_of(wavy_table(0.2, 0.01))[1].holds);
    CHECK_FALSE(claims_of(wavy_table(0.09, 0.01))[0].holds);
    CHECK(claims_of(wavy_table(0.09, 0.01))[1].holds);
    CHECK(claims_of(wavy_table(0.2, 0.01))[0].measured == "Schwarz 0.2, Robin 0.01");
}

TEST_CASE("a claim does not hold where a number is missing")
{
    Table table;
    for (const Experiment& experiment : experiments()) {
        table.figure = experiment.name;
        table.as_authors = true;
        CHECK_FALSE(claims_of(table).empty());
        for (const Claim& claim : claims_of(table))
            CHECK_FALSE(claim.holds);
    }
    for (const Claim& claim : claims_of_many({}))
        CHECK_FALSE(claim.holds);
}

TEST_CASE("claims are written as CSV")
{
    const test::TemporaryDirectory folder;
    write_claims(folder / "claims.csv", {{"a", "b, c", "1", true}, {"d", "e", "2, 3", false}});
    CHECK(test::content_of(folder / "claims.csv") ==
          "figure,claim,measured,holds\na,\"b, c\",1,yes\nd,e,\"2, 3\",no\n");
}

TEST_CASE("more sub-meshes: 2 to 32, plain and by the defaults")
{
    Experiment many = with_many_sub_meshes(small("teaser", 2000));
    CHECK(many.variants.size() == 3 + 3 * 5 * 2);
    std::erase_if(many.variants, [](const Variant& variant) { return variant.laplacian != fujiwara; });
    many.steps = 1;
    Table table = run(many);
    REQUIRE(table.rows.size() == 1 + 10);
    CHECK(table.rows[1].subdomains == 2);
    CHECK(table.rows[1].settings == "plain");
    CHECK(table.rows[10].subdomains == 32);
    CHECK(table.rows[10].settings == "default");
    CHECK(claims_of_many({table})[0].measured.ends_with(" of 5"));
    // Schwarz has no second column, and the polygons without decomposition no flows at all.
    CHECK(with_many_sub_meshes(small("schwarz")).variants.size() == 1 + 5);
    CHECK(with_many_sub_meshes(small("polygons")).variants.size() == 3);
}

TEST_CASE("meshes are the authors' own where there are any, and cut after half of their faces")
{
    const test::TemporaryDirectory folder;
    const PolygonMesh mesh = make_quads(121);
    write_mesh(folder / "ddm__tri_Shrek_3721.obj", mesh, {});
    const FigureMesh file = load(small("triangles").source, folder.path());
    CHECK(file.name == "ddm__tri_Shrek_3721.obj");
    CHECK(file.labels == halves_by_number(mesh, 50));
    CHECK_FALSE(file.authors);
    CHECK(load(small("hexagons").source, folder.path()).name == "generated");
}

TEST_CASE("the authors' parameters are for their own mesh")
{
    const Experiment teaser = small("teaser");
    FigureMesh mesh = load(teaser.source, {});
    const Variant halves = teaser.variants.back();
    CHECK_FALSE(options_of(teaser, halves, mesh).p);
    CHECK(options_of(teaser, halves, mesh).correction == FlowOptions::plain().correction);
    mesh.authors = teaser.source.authors;
    const FlowOptions options = options_of(teaser, halves, mesh);
    CHECK(options.p == 6.2993055940947205);
    CHECK(options.coloring == Coloring::Label);
    CHECK(options.correction == Correction::None);
    CHECK(options.sweep == Sweep::Fixed);
}

TEST_CASE("generated meshes are cut by rows")
{
    const PolygonMesh cylinder = bulging_two_level_cylinder(1000);
    const std::vector<Index> labels = halves_by_rows(cylinder, 2);
    // The coarse quads and the pentagons come first, the fine quads after them.
    CHECK(std::is_sorted(labels.begin(), labels.end()));
    const auto coarse = std::count(labels.begin(), labels.end(), 0);
    CHECK(cylinder.face(static_cast<Index>(coarse) - 1).size() == 5);
    CHECK(cylinder.face(static_cast<Index>(coarse)).size() == 4);
}

TEST_CASE("every stand-in has about the size of the paper's mesh")
{
    for (const Experiment& experiment : experiments()) {
        const PolygonMesh mesh = experiment.source.generate(experiment.source.vertices);
        CHECK_NOTHROW(require_valid(mesh));
        CHECK(std::abs(mesh.n_vertices() - experiment.source.vertices) < 0.05 * experiment.source.vertices);
    }
}

TEST_CASE("a plane is smooth, a fold is not")
{
    PolygonMesh mesh = make_quads(100, {.amplitude = 0.0});
    const Topology topology = make_topology(mesh);
    CHECK(roughness(mesh, topology, mesh.vertices) == 0.0);
    mesh.vertices.col(2) = mesh.vertices.col(0).cwiseAbs2();
    CHECK(roughness(mesh, topology, mesh.vertices) > 1.0);
}

TEST_CASE("the command line names figures that there are")
{
    const test::TemporaryDirectory folder;
    const std::string out = (folder / "results").string();
    FiguresCommand command;
    CHECK_FALSE(parse({"--out", out, "teaser", "subdomains"}, command));
    CHECK(std::filesystem::is_directory(out));
    CHECK(command.wants("teaser"));
    CHECK_FALSE(command.wants("texture"));
    CHECK(FiguresCommand{}.wants("texture"));
    const auto refused = [](const std::vector<std::string>& words) {
        FiguresCommand ignored;
        parse(words, ignored);
    };
    CHECK_THROWS_AS(refused({"--out", out, "figure-1"}), OptionError);
    CHECK_THROWS_AS(refused({"--out", out, "--meshes", folder / "none"}), InputError);
    CHECK_THROWS_AS(refused({"--out", folder.with("file", "") / "below"}), OutputError);
}
