// What lives on a surface, from the command line: fields that diffuse, and distances.

#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/diffuse.h"
#include "engine/geodesic_distance.h"
#include "partition/formats/mesh_io.h"
#include "samples/meshes/meshes.h"
#include "tests/samples/workshop.h"
#include "tests/support/relative.h"

using namespace seamflow;
using test::content_of;
using test::Json;
using test::relative;
using test::Workshop;

namespace {

/// A flat sheet with a property of each sort.
class FieldWorkshop : public Workshop {
  public:
    FieldWorkshop()
        : mesh_(make_triangles(900))
    {
        std::ostringstream text;
        text << "ply\nformat ascii 1.0\ncomment kept\nelement vertex " << mesh_.n_vertices()
             << "\nproperty double x\nproperty double y\nproperty double z\nproperty double thickness\n"
                "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int id\nelement face "
             << mesh_.n_faces() << "\nproperty list uchar int vertex_indices\nend_header\n";
        for (Index v = 0; v < mesh_.n_vertices(); ++v) {
            text << mesh_.vertices.row(v) << ' ';
            (v == 5 ? text << "nan" : text << (v * 37) % 10) << ' ' << (v * 31) % 256 << " 0 255 " << v << '\n';
        }
        for (Index f = 0; f < mesh_.n_faces(); ++f) {
            const auto face = mesh_.face(f);
            text << "3 " << face[0] << ' ' << face[1] << ' ' << face[2] << '\n';
        }
        (void)directory.with("in.ply", text.str());
        file_ = read_mesh(directory / "in.ply");
    }

    [[nodiscard]] FileFields fields_of(const std::string& name, const std::vector<std::string>& names) const
    {
        const MeshFile file = read_mesh(directory / name);
        return read_fields(*file.source, names);
    }

    [[nodiscard]] const MeshFile& file() const { return file_; }

  private:
    PolygonMesh mesh_;
    MeshFile file_;
};

}  // namespace

TEST_CASE("fields of a file are those that the library makes, and all else stays")
{
    const FieldWorkshop w;
    REQUIRE(w.smooth("in.ply out.ply --fields thickness,colour --fwhm 0.1 --report report.json") == 0);
    CHECK(w.said().find("thickness: 0 to 9") != std::string::npos);
    CHECK(w.said().find("no data    at 1 vertex\n") != std::string::npos);
    const std::vector<std::string> names{"thickness", "red", "green", "blue"};
    Eigen::MatrixXd expected = w.fields_of("in.ply", names).values;
    const FieldReport report = diffuse(w.file().mesh, expected, {.steps = 10}, {.fwhm = 0.1});
    const FileFields after = w.fields_of("out.ply", names);
    for (Index v = 0; v < expected.rows(); ++v) {
        CHECK((after.values(v, 0) == expected(v, 0) || (v == 5 && std::isnan(after.values(v, 0)))));
        CHECK(after.values(v, 1) == std::nearbyint(expected(v, 1)));
        CHECK(after.values(v, 2) == 0.0);
        CHECK(after.values(v, 3) == 255.0);
    }
    CHECK(w.fields_of("out.ply", {"id"}).values == w.fields_of("in.ply", {"id"}).values);
    CHECK(read_mesh(w.directory / "out.ply").mesh.vertices == w.file().mesh.vertices);
    CHECK(content_of(w.directory / "out.ply").find("comment kept") != std::string::npos);
    const Json json = w.json("report.json");
    CHECK(json["fwhm"].get<double>() == relative(*report.fwhm, 1e-12));
    CHECK(json["steps"] == 10);
    CHECK(json["without_data"] == 1);
    CHECK(json["fields"]["red"]["after"]["vertices"] == w.file().mesh.n_vertices());
    CHECK(json["fields"]["thickness"]["after"]["vertices"] == w.file().mesh.n_vertices() - 1);
}

TEST_CASE("what is said of whole numbers and of floats is what was written, unless they are written as others")
{
    const FieldWorkshop w;
    std::string floats = content_of(w.directory / "in.ply");
    floats.replace(floats.find("uchar red"), 5, "float");
    (void)w.directory.with("floats.ply", floats);
    (void)w.directory.with("colours.obj", "v 0 0 0 1 9 0\nv 1 0 0 250 0 0\nv 1 1 0 7 8 0\nv 0 1 0 99 3 0\nf 1 2 3 4\n");
    for (const std::string files :
         {"in.ply out.ply", "colours.obj out.obj", "colours.obj out.ply", "floats.ply out.ply"}) {
        CAPTURE(files);
        REQUIRE(w.smooth(files + " --fields red --radius 20% --report report.json") == 0);
        const Eigen::VectorXd red = w.fields_of(files.substr(files.find(' ') + 1), {"red"}).values;
        CHECK(((red.array() == red.array().round()).all() ==
               (files == "in.ply out.ply" || files == "colours.obj out.obj")));
        const Json after = w.json("report.json")["fields"]["red"]["after"];
        CHECK(after["least"] == red.minCoeff());
        CHECK(after["most"] == red.maxCoeff());
        CHECK(after["mean"].get<double>() == relative(red.mean(), 1e-12));
        if (files == "in.ply out.ply")
            CHECK(w.said().find("-> " + std::to_string(std::lround(red.minCoeff())) + " to " +
                                std::to_string(std::lround(red.maxCoeff())) + ", mean") != std::string::npos);
    }
}

TEST_CASE("fields of the largest numbers have a mean, and names that are not UTF-8 are words like others")
{
    const Workshop w;
    const PolygonMesh mesh = make_triangles(200);
    const std::string name = "\xe9paisseur";
    const std::string other = "\xe8paisseur";
    std::ostringstream text;
    text << "ply\nformat ascii 1.0\nelement vertex " << mesh.n_vertices()
         << "\nproperty double x\nproperty double y\nproperty double z\nproperty double " << name << "\nproperty float "
         << other << "\nelement face " << mesh.n_faces() << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        text << mesh.vertices.row(v) << ' ' << v % 10 << "e307 " << v % 7 << '\n';
    for (Index f = 0; f < mesh.n_faces(); ++f)
        text << "3 " << mesh.face(f)[0] << ' ' << mesh.face(f)[1] << ' ' << mesh.face(f)[2] << '\n';
    (void)w.directory.with("large.ply", text.str());
    REQUIRE(w.smooth("large.ply out.ply --fields " + name + "," + other + " --radius 2% --report report.json") == 0);
    CHECK(w.said().find("nan") == std::string::npos);
    CHECK(content_of(w.directory / "out.ply").find("property double " + name + "\n") != std::string::npos);
    const Json fields = w.json("report.json")["fields"];
    REQUIRE(fields.size() == 2);
    CHECK(fields.begin().key() == "\xef\xbf\xbdpaisseur");
    CHECK(fields["\xef\xbf\xbdpaisseur (2)"]["before"]["most"] == 6.0);
    double tenths = 0.0;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        tenths += v % 10;
    CHECK((*fields.begin())["before"]["mean"].get<double>() == relative(1e307 * (tenths / mesh.n_vertices()), 1e-12));
    CHECK(w.smooth("large.ply moved.ply --radius 2%") == 0);
}

TEST_CASE("fields are filled, keep their edges, and stay on a boundary that is fixed")
{
    const FieldWorkshop w;
    for (const char* const fields :
         {"--fields thickness,red", "--fields thickness red", "--fields thickness --fields red"})
        CHECK(w.smooth(std::string("in.ply out.ply --radius 2% ") + fields) == 0);
    REQUIRE(w.smooth("in.ply filled.ply --fields thickness --radius 2% --fill") == 0);
    CHECK(w.said().find("of which 1 were filled") != std::string::npos);
    CHECK(w.fields_of("filled.ply", {"thickness"}).values.allFinite());
    REQUIRE(w.smooth("in.ply kept.ply --fields red --radius 2% --keep-field-edges 10") == 0);
    REQUIRE(w.smooth("in.ply plain.ply --fields red --radius 2%") == 0);
    const Eigen::MatrixXd before = w.fields_of("in.ply", {"red"}).values;
    const double kept = (w.fields_of("kept.ply", {"red"}).values - before).squaredNorm();
    CHECK(kept < 0.1 * (w.fields_of("plain.ply", {"red"}).values - before).squaredNorm());
    CHECK(kept > 0.0);
    REQUIRE(w.smooth("in.ply fixed.ply --fields thickness --radius 2% --boundary fixed") == 0);
    CHECK(w.fields_of("fixed.ply", {"thickness"}).values(0, 0) == 0.0);
    REQUIRE(w.smooth("in.ply free.ply --fields thickness --radius 2% --boundary free") == 0);
    REQUIRE(w.smooth("in.ply as_it_is.ply --fields thickness --radius 2%") == 0);
    CHECK(w.fields_of("free.ply", {"thickness"}).values(0, 0) != 0.0);
    CHECK(w.fields_of("free.ply", {"thickness"}).values(0, 0) ==
          w.fields_of("as_it_is.ply", {"thickness"}).values(0, 0));
    CHECK(w.smooth("in.ply out.ply --fields thickness --radius 2% --boundary smooth") == 2);
    (void)w.directory.with("fix.txt", "401\n");
    REQUIRE(w.smooth("in.ply held.ply --fields thickness --radius 2% --fix fix.txt") == 0);
    const Eigen::MatrixXd held = w.fields_of("held.ply", {"thickness"}).values;
    CHECK(held(401, 0) == (401 * 37) % 10);
    CHECK(held(400, 0) != (400 * 37) % 10);
}

TEST_CASE("labels and other whole numbers are averaged and rounded with a remark, and faces have no fields")
{
    const Workshop w;
    const PolygonMesh mesh = make_triangles(400);
    std::string text = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
                                   "property float z\nproperty int label\nproperty int half\nproperty uchar red\n"
                                   "element face {}\nproperty list uchar int vertex_indices\nproperty float quality\n"
                                   "end_header\n",
                                   mesh.n_vertices(), mesh.n_faces());
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        text += fmt::format("{} {} 0 {} {} {}\n", mesh.vertices(v, 0), mesh.vertices(v, 1), v % 3 == 0 ? 1 : v % 2 + 4,
                            v % 2, 80 * (v % 3));
    for (Index f = 0; f < mesh.n_faces(); ++f)
        text += fmt::format("3 {} 0.5\n", fmt::join(mesh.face(f), " "));
    (void)w.directory.with("in.ply", text);
    REQUIRE(w.smooth("in.ply out.ply --fields label,half,red --radius 5% --report report.json") == 0);
    const auto texts = [&] {
        std::vector<std::string> list;
        const test::Json report = w.json("report.json");
        for (const auto& remark : report["remarks"])
            list.push_back(remark["text"]);
        return list;
    };
    const std::vector<std::string> remarks = texts();
    REQUIRE(remarks.size() == 2);
    CHECK(remarks[0].starts_with("'label' has 3 different whole numbers: if they are labels, they are averaged like"));
    CHECK(remarks[1] ==
          "the values of 'label', 'half', 'red' are rounded to the nearest whole numbers, as which the file "
          "holds them");
    // They may be labels in a property of fractions, too; 0 and 1 may be shares.
    for (const auto& [from, to] : {std::pair("int label", "float label"), std::pair("int half", "float half")})
        text.replace(text.find(from), std::string(from).size(), to);
    (void)w.directory.with("float.ply", text);
    REQUIRE(w.smooth("float.ply out.ply --fields label,half --radius 5% --report report.json") == 0);
    CHECK(texts() == std::vector<std::string>{remarks[0]});
    CHECK(w.smooth("in.ply out.ply --fields quality --fwhm 2") == 3);
    CHECK(w.said().find("'quality' is a property of the faces, but fields are of the vertices") != std::string::npos);
}

TEST_CASE("--fwhm is a length or a part of the diagonal, over any number of steps")
{
    const FieldWorkshop w;
    const Points& vertices = w.file().mesh.vertices;
    const double diagonal = (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
    Eigen::MatrixXd expected = w.fields_of("in.ply", {"thickness"}).values;
    diffuse(w.file().mesh, expected, {.steps = 3}, {.fwhm = 0.08 * diagonal});
    REQUIRE(w.smooth("in.ply out.ply --fields thickness --fwhm 8% --steps 3 --report report.json") == 0);
    CHECK(w.json("report.json")["steps"] == 3);
    const Eigen::MatrixXd after = w.fields_of("out.ply", {"thickness"}).values;
    for (Index v = 0; v < vertices.rows(); ++v)
        if (v != 5)
            CHECK(after(v, 0) == relative(expected(v, 0), 1e-9));
    // The same time in other steps, of which the width is told: its square is as the part (m - 1) / m of the time.
    const double time = 3.0 * w.json("report.json")["time_step"].get<double>();
    for (const auto& [steps, part] : {std::pair(2, 1.0 / 2.0), std::pair(3, 2.0 / 3.0), std::pair(4, 3.0 / 4.0)}) {
        const std::string width = fmt::format(": white noise becomes {:.6g} wide at half its height",
                                              0.08 * diagonal * std::sqrt(part / (2.0 / 3.0)));
        REQUIRE(w.smooth(fmt::format("in.ply out.ply --fields thickness --time-step {:.17g} --steps {}", time / steps,
                                     steps)) == 0);
        CHECK(w.said().find(width) != std::string::npos);
    }
}

TEST_CASE("normals that diffuse keep the lengths that they had")
{
    const Workshop w;
    const PolygonMesh mesh = make_triangles(400);
    FileFields normals{.names = {"nx", "ny", "nz"}, .values = Eigen::MatrixXd(mesh.n_vertices(), 3)};
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        normals.values.row(v) = (1.0 + v % 3) * Point(0.3 * std::sin(v), 0.3 * std::cos(3.0 * v), 1.0);
    write_mesh(w.directory / "in.ply", mesh, {FileFormat::Ply, Encoding::BinaryLittleEndian}, normals);
    REQUIRE(w.smooth("in.ply out.ply --fields normal --radius 2%") == 0);
    const Eigen::MatrixXd after = read_fields(*read_mesh(w.directory / "out.ply").source, normals.names).values;
    CHECK((after.rowwise().norm() - normals.values.rowwise().norm()).cwiseAbs().maxCoeff() < 1e-12);
    CHECK((after - normals.values).cwiseAbs().maxCoeff() > 0.1);
}

TEST_CASE("steps of fields that miss their tolerance, of any columns, end with status 4")
{
    const FieldWorkshop w;
    CHECK(w.smooth("in.ply out.ply --fields thickness,red --fwhm 0.3 --approach cg --converge 1e-17") == 4);
    CHECK(w.said().find("the tolerance 1e-17 was missed in ") != std::string::npos);
    CHECK(w.has("out.ply"));
    CHECK(w.smooth("in.ply out.ply --fields thickness,red,green,blue --fwhm 0.3 --converge 1e-40 --subdomains 4 "
                   "--report r.json") == 4);
    CHECK(w.said().find("the tolerance 1e-40 was missed in 10 steps") != std::string::npos);
    CHECK(w.json("r.json")["steps_short_of_tolerance"] == 10);
    CHECK(w.smooth("in.ply out.ply --fields thickness,red --fwhm 0.3 --approach cg") == 0);
}

TEST_CASE("distances from vertices of a file are those that the library makes")
{
    const FieldWorkshop w;
    (void)w.directory.with("from.txt", "17\n400\n");
    REQUIRE(w.smooth("in.ply out.ply --from from.txt") == 0);
    const Eigen::MatrixXd expected = geodesic_distance(w.file().mesh, std::array<Index, 2>{17, 400});
    CHECK(w.fields_of("out.ply", {"distance"}).values == expected);
    CHECK(w.fields_of("out.ply", {"id"}).values == w.fields_of("in.ply", {"id"}).values);
    // In place of floats.
    std::string floats = content_of(w.directory / "out.ply");
    floats.replace(floats.find("double distance"), 6, "float");
    (void)w.directory.with("floats.ply", floats);
    (void)w.directory.with("first.txt", "17\n");
    REQUIRE(w.smooth("floats.ply again.ply --from first.txt --report r.json") == 0);
    const Eigen::VectorXd rounded = w.fields_of("again.ply", {"distance"}).values;
    CHECK(w.json("r.json")["fields"]["distance"]["after"]["most"] == rounded.maxCoeff());
    REQUIRE(w.smooth("mesh.obj from_obj.ply --from from.txt") == 0);
    CHECK(w.fields_of("from_obj.ply", {"distance"}).values(17, 0) == 0.0);
    // What the surface does not lead to is counted.
    (void)w.directory.with("two.obj",
                           "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 6 1 0\nv 5 1 0\nf 1 2 3\nf 4 5 6 7\n");
    (void)w.directory.with("first.txt", "1\n");
    REQUIRE(w.smooth("two.obj two.ply --from first.txt --report report.json") == 0);
    CHECK(w.json("report.json")["without_data"] == 4);
    CHECK(w.said().find("no data    at 4 vertices\n") != std::string::npos);
    CHECK(w.fields_of("two.ply", {"distance"}).values.bottomRows(4).array().isNaN().all());
    CHECK(w.smooth("mesh.obj out.obj --from from.txt") == 5);
    CHECK(w.said().find("only .ply files hold such fields") != std::string::npos);
    CHECK_FALSE(w.has("out.obj"));
}

TEST_CASE("what fields do not have is refused by name, and nothing is written")
{
    const FieldWorkshop w;
    for (const auto& [arguments, message] :
         {std::pair("--fields thickness", "--fields needs an amount: give --fwhm"),
          {"--fields thickness --fwhm 1 --radius 1", "all say how much to smooth"},
          {"--fields thickness --fwhm 1 --preset scan", "--fields cannot be combined with --preset: the surface stays"},
          {"--fields thickness --fwhm 1 --every-step a%d.ply", "--fields cannot be combined with --every-step"},
          {"--fields thickness --fwhm 1 --approach sweep", "not by sweeps over sub-meshes"},
          {"--fields thickness --fwhm 1 --region nosuch.txt", "--fields cannot be combined with --region"},
          {"--fields thickness --fwhm 1 --direction z", "--fields cannot be combined with --direction"},
          {"--from in.ply --weld never", "--from cannot be combined with --weld"},
          {"--fields x --fwhm 1", "x"},
          {"--fwhm 1", "--fwhm requires --fields"},
          {"--fields thickness --fwhm 1 --from in.ply", "excludes"},
          {"--from in.ply --radius 1", "--from cannot be combined with --radius"},
          {"--fields width --fwhm 1", "the vertices have no number 'width', but x, y, z, thickness"}}) {
        const std::string tried = arguments;
        CAPTURE(tried);
        CHECK(w.smooth("in.ply out.ply " + tried) != 0);
        CAPTURE(w.said());
        CHECK(w.said().find(message) != std::string::npos);
        CHECK_FALSE(w.has("out.ply"));
    }
}
