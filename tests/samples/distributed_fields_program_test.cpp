// smooth-distributed --fields on ranks of MPI, beside smooth.

#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "partition/formats/mesh_io.h"
#include "partition/vector_area.h"
#include "samples/meshes/meshes.h"
#include "tests/samples/running_ranks.h"
#include "tests/samples/workshop.h"
#include "tests/support/relative.h"

using namespace seamflow;
using test::content_of;
using test::messages;
using test::on_ranks;
using test::Workshop;

namespace {

template <class Number>
void append_number(std::string& bytes, Number number)
{
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// A sheet with a property of each sort, in binary, with data lacking here and there; and labels of its faces.
void write_field_sheet(const Workshop& w)
{
    const PolygonMesh mesh = make_triangles(9000);
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.n_vertices()) +
                        "\nproperty double x\nproperty double y\nproperty double z\nproperty double nx\n"
                        "property double ny\nproperty double nz\nproperty double quality\nproperty uchar red\n"
                        "property uchar green\nproperty uchar blue\nproperty int id\nelement face " +
                        std::to_string(mesh.n_faces()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        const Point p = mesh.vertices.row(v);
        const bool lacks = v == 5 || std::hypot(p.x() - 0.4, p.y() - 0.5) < 0.1;
        for (const double number : {p.x(), p.y(), p.z(), 0.1 * std::sin(0.3 * v), 0.0, 1.0})
            append_number(bytes, number);
        append_number(bytes, lacks ? std::numeric_limits<double>::quiet_NaN() : (v * 37) % 10 + p.x());
        for (const int number : {v * 31, 0, 255})
            append_number(bytes, static_cast<std::uint8_t>(number));
        append_number(bytes, std::int32_t{v});
    }
    std::string labels;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        append_number(bytes, std::uint8_t{3});
        for (const Index v : mesh.face(f))
            append_number(bytes, std::int32_t{v});
        const Point p = mesh.vertices.row(mesh.face(f)[0]);
        labels += std::to_string(static_cast<int>(2.9 * p.x()) + 3 * static_cast<int>(2.9 * p.y())) + "\n";
    }
    (void)w.directory.with("sheet.ply", bytes);
    (void)w.directory.with("labels", labels);
}

/// A sheet whose vertices at x = ½ are doubled, with columns that all vertices have, that vertices on both sides of
/// that seam lack, and that vertices on one side lack.
void write_seam_with_holes(const Workshop& w)
{
    PolygonMesh mesh = make_triangles(2000);
    const Index n = mesh.n_vertices();
    const auto is_right = [&](Index f) {
        const auto face = mesh.face(f);
        return mesh.vertices(face[0], 0) + mesh.vertices(face[1], 0) + mesh.vertices(face[2], 0) > 1.5;
    };
    std::vector<Index> copy(at(n), -1);
    for (Index f = 0; f < mesh.n_faces(); ++f)
        for (const Index v : mesh.face(f))
            copy[at(v)] = is_right(f) ? copy[at(v)] : v;
    std::vector<Index> originals;
    std::ostringstream faces;
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        faces << '3';
        for (const Index v : mesh.face(f)) {
            // Vertices of faces on the left keep their numbers.
            if (is_right(f) && copy[at(v)] == v) {
                copy[at(v)] = n + static_cast<Index>(originals.size());
                originals.push_back(v);
            }
            faces << ' ' << (is_right(f) && copy[at(v)] >= 0 ? copy[at(v)] : v);
        }
        faces << '\n';
    }
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex " << n + std::ssize(originals)
         << "\nproperty double x\nproperty double y\nproperty double z\nproperty double whole\n"
            "property double both\nproperty double one\nelement face "
         << mesh.n_faces() << "\nproperty list uchar int vertex_indices\nend_header\n";
    text.precision(17);
    for (Index v = 0; v < n + std::ssize(originals); ++v) {
        const Point p = mesh.vertices.row(v < n ? v : originals[at(v - n)]);
        const bool is_near = std::abs(std::remainder(p.y(), 0.25)) < 0.05 && std::abs(p.x() - 0.5) < 0.08;
        const std::string value = std::to_string((v * 37) % 10);
        text << p << ' ' << value << ' ' << (is_near ? "nan" : value) << ' '
             << (is_near && (v >= n || p.x() > 0.51) ? "nan" : value) << '\n';
    }
    (void)w.directory.with("seam.ply", text.str() + faces.str());
}

FileFields fields_in(const Workshop& w, const std::string& name, const std::vector<std::string>& names)
{
    return read_fields(*read_mesh(w.directory / name).source, names);
}

}  // namespace

TEST_CASE("fields on ranks are those of smooth, and the same file for any number of ranks, whole or in slices")
{
    const Workshop w;
    write_field_sheet(w);
    const std::string options = " --fields quality,normal,red,green,blue --fwhm 5% --labels labels --threads 1";
    REQUIRE(w.smooth("sheet.ply one.ply --report one.json" + options) == 0);
    REQUIRE(on_ranks(w, 1, "sheet.ply 1.ply" + options) == 0);
    for (const int n : {2, 3})
        for (const std::string sharing : {"", " --whole-up-to 1"}) {
            CAPTURE(n);
            CAPTURE(sharing);
            REQUIRE(on_ranks(w, n, "sheet.ply n.ply --report n.json" + options + sharing) == 0);
            CHECK((content_of(w.directory / "n.ply") == content_of(w.directory / "1.ply")));
            CHECK(w.count_lines("said", "field ") == 7);
            CHECK(w.count_lines("said", "no data ") == 1);
            CHECK(w.said().find("\nwidth ") == std::string::npos);
            const test::Json report = w.json("n.json");
            const test::Json expected = w.json("one.json");
            for (const std::string name : {"vertices", "steps", "time_step", "without_data"})
                CHECK(report[name] == expected[name]);
            CHECK(report["fields"]["quality"]["before"] == expected["fields"]["quality"]["before"]);
            CHECK(report["fields"]["red"]["after"]["most"] == fields_in(w, "n.ply", {"red"}).values.maxCoeff());
            CHECK(report["fields"]["red"]["after"]["mean"].get<double>() ==
                  test::relative(expected["fields"]["red"]["after"]["mean"].get<double>(), 1e-8));
        }
    const std::vector<std::string> names{"quality", "nx", "ny", "nz"};
    const FileFields of_one = fields_in(w, "one.ply", names);
    const FileFields of_ranks = fields_in(w, "1.ply", names);
    const FileFields before = fields_in(w, "sheet.ply", names);
    for (Index v = 0; v < of_one.values.rows(); ++v)
        for (Index c = 0; c < 4; ++c) {
            const bool is_alike = std::abs(of_one.values(v, c) - of_ranks.values(v, c)) < 1e-7;
            CHECK((is_alike || (std::isnan(before.values(v, c)) && std::isnan(of_ranks.values(v, c)))));
        }
    CHECK(of_ranks.values.bottomRows(9) != before.values.bottomRows(9));
    const std::vector<std::string> whole_numbers{"red", "green", "blue", "id"};
    CHECK(fields_in(w, "one.ply", whole_numbers).values == fields_in(w, "1.ply", whole_numbers).values);
}

TEST_CASE("fields on ranks: seams are joined, vertices are held, colours of OBJ files are written")
{
    const Workshop w;
    write_field_sheet(w);
    (void)w.directory.with("stay", "17\n18\n4000\n");
    const std::string options = " --fields colour --radius 2% --steps 2 --fix stay --threads 1";
    REQUIRE(w.smooth("sheet.ply one.ply" + options) == 0);
    REQUIRE(on_ranks(w, 3, "sheet.ply n.ply" + options) == 0);
    CHECK((content_of(w.directory / "n.ply") == content_of(w.directory / "one.ply")));
    // Two triangles and two more, whose common side is doubled.
    (void)w.directory.with("seam.obj", "v 0 0 0 0.5 0 0\nv 1 0 0 1 0 0\nv 1 1 0 0 0 1\nv 0 1 0 0 1 0\n"
                                       "v 1 0 0 0 0 0\nv 2 0 0 0 1 1\nv 2 1 0 1 1 1\nv 1 1 0 0 0 1\n"
                                       "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n");
    // A copy that is held holds the vertex that it is joined with.
    (void)w.directory.with("copy", "7\n");
    const std::string joined = " --fields colour --time-step 0.1 --steps 2 --threads 1 --approach converged";
    for (const std::string more : {"", " --laplacian uniform", " --fix copy"}) {
        CAPTURE(more);
        REQUIRE(w.smooth("seam.obj one.obj" + joined + more) == 0);
        REQUIRE(on_ranks(w, 2, "seam.obj n.obj" + joined + more) == 0);
        const FileFields of_one = fields_in(w, "one.obj", {"colour"});
        const FileFields of_ranks = fields_in(w, "n.obj", {"colour"});
        CHECK((of_one.values - of_ranks.values).cwiseAbs().maxCoeff() < 1e-6);
        CHECK(of_ranks.values.row(1) == of_ranks.values.row(4));
        CHECK(of_ranks.values.row(2) == of_ranks.values.row(7));
        const bool is_still = of_ranks.values.row(2) == fields_in(w, "seam.obj", {"colour"}).values.row(2);
        CHECK(is_still == (more == " --fix copy"));
    }
}

TEST_CASE("fields on ranks: seams beside vertices without data are those of smooth, and remarks name their columns")
{
    const Workshop w;
    write_seam_with_holes(w);
    const std::string options = " --fields whole,both,one --radius 5% --steps 2 --converge 1e-12 --threads 1";
    REQUIRE(w.smooth("seam.ply one.ply" + options) == 0);
    const std::vector<std::string> names{"whole", "both", "one"};
    const FileFields of_one = fields_in(w, "one.ply", names);
    for (const int n : {1, 2})
        for (const std::string more : {"", " --subdomains 5"}) {
            CAPTURE(n);
            CAPTURE(more);
            REQUIRE(on_ranks(w, n, "seam.ply n.ply" + options + more) == 0);
            const FileFields of_ranks = fields_in(w, "n.ply", names);
            CHECK((of_one.values.array().isNaN() == of_ranks.values.array().isNaN()).all());
            CHECK((of_one.values - of_ranks.values)
                      .array()
                      .isNaN()
                      .select(0.0, (of_one.values - of_ranks.values))
                      .cwiseAbs()
                      .maxCoeff() < 1e-7);
            CHECK(w.said().find("remark     For 'whole': ") != std::string::npos);
        }
}

TEST_CASE("fields that ranks do not take are refused, with one sentence")
{
    const Workshop w;
    write_field_sheet(w);
    (void)w.directory.with("from", "1\n");
    const auto refuses = [&](const std::string& options, int status, const std::string& what) {
        CAPTURE(options);
        CHECK(on_ranks(w, 2, "sheet.ply n.ply " + options) == status);
        const std::vector<std::string> said = messages(w, "smooth-distributed");
        REQUIRE(said.size() == 1);
        CHECK(said.front().find(what) != std::string::npos);
    };
    refuses("--fields red --fwhm 1% --fill", 2, "has no --fill");
    refuses("--fields red --fwhm 1% --keep-field-edges 3", 2, "has no --keep-field-edges");
    refuses("--from from", 2, "has no --from");
    refuses("--fields red", 2, "--fields needs an amount");
    refuses("--fields red --fwhm 1% --approach cg", 2, "in converged steps");
    for (const std::string sharing : {"", " --whole-up-to 1"})
        refuses("--fields heat --fwhm 1%" + sharing, 3, "sheet.ply:3: the vertices have no number 'heat'");
}
