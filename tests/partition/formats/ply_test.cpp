#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "partition/formats/palette.h"
#include "partition/io/byte_order.h"
#include "partition/vector_area.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

const std::string ascii = "ply\nformat ascii 1.0\n";
const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string triangle_header =
    "element vertex 3\n" + xyz + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string three_ply_vertices = "0 0 0\n1 0 0\n0 1 0\n";

std::string ply_complaint(const std::string& content)
{
    return complaint_about("a.ply", content);
}

/// Numbers one after another, in a byte order.
class Bytes {
  public:
    explicit Bytes(std::endian order)
        : order_(order)
    {
    }

    template <class Number>
    Bytes& add(std::initializer_list<Number> values)
    {
        for (const Number value : values)
            for (const char byte : to_bytes(value, order_))
                text_ += byte;
        return *this;
    }
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::endian order_;
    std::string text_;
};

std::string header_of(std::endian order)
{
    return std::string("ply\nformat binary_") + (order == std::endian::big ? "big" : "little") + "_endian 1.0\n";
}

std::string binary_triangle()
{
    return header_of(std::endian::little) + triangle_header +
           Bytes(std::endian::little)
               .add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0})
               .add<std::uint8_t>({3})
               .add<std::int32_t>({0, 1, 2})
               .text();
}

}  // namespace

TEST_CASE("PLY: text with properties of any type in any order, other properties and elements passed over")
{
    const auto file = read_text(
        "a.ply",
        "ply\r\n format \tascii 1.0\r\ncomment element vertex 7\nobj_info none\n"
        "element edge 1\nproperty int vertex1\nproperty int vertex2\n"
        "element face 2\nproperty uchar red\nproperty list ushort uint vertex_index\nproperty list int float uv\n"
        "element vertex 3\nproperty double z\nproperty list uchar short extra\nproperty int8 x\nproperty float64 y\n"
        "element material 2\nproperty float shine\nend_header\n"
        "0 1\n255 3 0 1 2 2 0.5 nan\n\n7\t3 2 1 0 0  \n0 2 7 8 0 0\n0 0 1 0\n0 1 9 0 1\n0.5\n0.25");
    CHECK(file.kind == FileKind{FileFormat::Ply, Encoding::Ascii});
    CHECK(file.mesh.vertices == make_triangle().vertices);
    CHECK(file.mesh.face_vertices == std::vector<Index>{0, 1, 2, 2, 1, 0});
}

TEST_CASE("PLY: text is read in double precision even where the header says float")
{
    CHECK(read_text("a.ply", ascii + "element vertex 1\n" + xyz + "end_header\n0.1 -0 1e300\n").mesh.vertices(0, 0) ==
          0.1);
}

TEST_CASE("PLY: binary numbers of all types in both byte orders")
{
    for (const auto order : {std::endian::little, std::endian::big}) {
        const std::string content =
            header_of(order) +
            "element face 1\nproperty list int8 uint16 vertex_indices\nproperty list uint8 float64 weights\n"
            "element tag 2\nproperty list short char name\n"
            "element vertex 3\nproperty short y\nproperty uint x\nproperty ushort flags\nproperty double "
            "z\nend_header\n" +
            Bytes(order)
                .add<std::int8_t>({3})
                .add<std::uint16_t>({2, 0, 1})
                .add<std::uint8_t>({2})
                .add<double>({0.5, 0.25})
                .add<std::int16_t>({2})
                .add<std::int8_t>({'h', 'i'})
                .add<std::int16_t>({0})
                .text() +
            Bytes(order)
                .add<std::int16_t>({-7})
                .add<std::uint32_t>({4000000000})
                .add<std::uint16_t>({1})
                .add<double>({0.1})
                .text() +
            Bytes(order)
                .add<std::int16_t>({1})
                .add<std::uint32_t>({2})
                .add<std::uint16_t>({1})
                .add<double>({-0.0})
                .text() +
            Bytes(order)
                .add<std::int16_t>({3})
                .add<std::uint32_t>({4})
                .add<std::uint16_t>({1})
                .add<double>({1e308})
                .text();
        Points expected(3, 3);
        expected << 4e9, -7, 0.1, 2, 1, -0.0, 4, 3, 1e308;
        CHECK(identical(read_text("a.ply", content).mesh, make_mesh(expected, {{2, 0, 1}})));
    }
}

namespace {

/// One triangle on the last of as many vertices as a type without sign can tell apart.
template <class Number>
std::string last_vertices(std::endian order, const std::string& type)
{
    constexpr std::size_t n = std::size_t{std::numeric_limits<Number>::max()} + 1;
    const auto last = [](Number back) { return static_cast<Number>(std::numeric_limits<Number>::max() - back); };
    return header_of(order) + "element vertex " + std::to_string(n) + "\nproperty " + type +
           " x\nproperty uchar y\nproperty uchar z\nelement face 1\nproperty list uchar " + type +
           " vertex_indices\nend_header\n" + std::string((sizeof(Number) + 2) * n, '\xff') +
           Bytes(order).add<std::uint8_t>({3}).add<Number>({last(0), last(1), n / 2}).text();
}

template <class Number>
void check_last_vertices(const std::string& type)
{
    for (const auto order : {std::endian::little, std::endian::big}) {
        CAPTURE(type);
        constexpr Index last = std::numeric_limits<Number>::max();
        const PolygonMesh mesh = read_text("a.ply", last_vertices<Number>(order, type)).mesh;
        CHECK(mesh.face_vertices == std::vector<Index>{last, last - 1, last / 2 + 1});
        CHECK(mesh.vertices.row(last) == Point(last, 255.0, 255.0));
    }
}

}  // namespace

TEST_CASE("PLY: binary numbers without sign reach up to the largest of their type")
{
    for (const char* type : {"uchar", "uint8"})
        check_last_vertices<std::uint8_t>(type);
    for (const char* type : {"ushort", "uint16"})
        check_last_vertices<std::uint16_t>(type);
}

TEST_CASE("PLY: binary data follow the header directly, whatever its line ends and their first bytes")
{
    const std::string content = header_of(std::endian::big) + "element vertex 1\n" + xyz + "end_header\n";
    // The number is 0x0a0d0a0d: bytes that would be line ends.
    const std::string data = Bytes(std::endian::big).add<std::uint32_t>({0x0a0d0a0d, 0x0a0d0a0d, 0}).text();
    std::string carriage_returns = content;
    std::replace(carriage_returns.begin(), carriage_returns.end(), '\n', '\r');
    std::string both;
    for (const char c : content)
        both += c == '\n' ? "\r\n" : std::string(1, c);
    for (const auto& header : {content, carriage_returns, both})
        CHECK(read_text("a.ply", header + data).mesh.vertices(0, 0) == double{std::bit_cast<float>(0x0a0d0a0d)});
}

TEST_CASE("PLY: vertices without faces")
{
    CHECK(read_text("a.ply", ascii + "element vertex 1\n" + xyz + "end_header\n1 2 3").mesh.n_faces() == 0);
    CHECK(read_text("a.ply", ascii + "element vertex 1\n" + xyz + "element face 0\nend_header\n1 2 3").mesh.n_faces() ==
          0);
}

TEST_CASE("PLY: complaints about the header name its line")
{
    CHECK(contains(ply_complaint("hello\n"), "a.ply:1: the file begins with 'hello' and not with ply"));
    CHECK(contains(ply_complaint("ply\nformat ascii 1.0\n"), "a.ply:2: the file ends within its header"));
    CHECK(contains(ply_complaint("ply\n" + triangle_header), "has no line 'format'"));
    CHECK(contains(ply_complaint("ply\nformat latin 1.0\n"), "a.ply:2: expected the format ascii"));
    CHECK(contains(ply_complaint(ascii + "nonsense\n"), "a.ply:3: the header line 'nonsense' is unknown"));
    CHECK(contains(ply_complaint(ascii + "property int x\n"), "a.ply:3: a property stands before the first element"));
    CHECK(contains(ply_complaint(ascii + "element vertex -1\n"), "a.ply:3: the number of elements is -1"));
    CHECK(contains(ply_complaint(ascii + "element vertex\n"), "a.ply:3: expected the number of elements"));
    CHECK(contains(ply_complaint(ascii + "element\n"), "a.ply:3: expected the name of the element"));
    CHECK(contains(ply_complaint(ascii + "element vertex 1\nelement vertex 1\n"),
                   "a.ply:4: the element 'vertex' is declared"));
    CHECK(contains(ply_complaint(ascii + "element vertex 1\nproperty float x\nproperty float x\n"),
                   "a.ply:5: the property 'x'"));
    CHECK(contains(ply_complaint(ascii + "element vertex 1\nproperty quad x\n"), "a.ply:4: expected a type"));
    CHECK(contains(ply_complaint(ascii + "element vertex 1\nproperty list float int x\n"),
                   "a.ply:4: the length of a list"));
    CHECK(contains(ply_complaint(ascii + "element vertex 1\nend_header\n1\n"),
                   "a.ply:3: the element 'vertex' has no properties"));
    CHECK(contains(ply_complaint(ascii + "element vertex 1\nproperty float x\nproperty float y\nend_header\n1 2 3\n"),
                   "a.ply:3: the vertices lack x, y or z"));
    CHECK(
        contains(ply_complaint(ascii + "element vertex 1\nproperty float x\nproperty float y\nproperty list int int z\n"
                                       "end_header\n1 2 1 3\n"),
                 "a.ply:6: a coordinate must be one number"));
    CHECK(contains(ply_complaint(ascii + "element face 0\nend_header\n"), "the file has no vertices"));
    CHECK(contains(ply_complaint(ascii + "element vertex 0\n" + xyz + "end_header\n"), "the file has no vertices"));
}

TEST_CASE("PLY: faces that are none")
{
    const std::string header = ascii + "element vertex 3\n" + xyz;
    CHECK(contains(
        ply_complaint(header + "element face 1\nproperty int colour\nend_header\n" + three_ply_vertices + "3\n"),
        "a.ply:7: the faces must have one list named vertex_indices or vertex_index, but have 0"));
    CHECK(contains(ply_complaint(header + "element face 1\nproperty list uchar float vertex_index\nend_header\n" +
                                 three_ply_vertices + "3 0 1 2\n"),
                   "a.ply:8: the corners of a face must be a list of whole numbers"));
    CHECK(contains(
        ply_complaint(header + "element face 1\nproperty int vertex_index\nend_header\n" + three_ply_vertices + "3\n"),
        "a.ply:8: the corners of a face must be a list"));
}

TEST_CASE("PLY: counts that the file is too short for are refused at once")
{
    for (const char* count : {"2147483648", "2147483647", "9223372036854775807", "100"}) {
        const std::string announced = std::string("element vertex ") + count + "\n" + xyz + "end_header\n";
        CHECK(contains(ply_complaint(ascii + announced + three_ply_vertices),
                       std::string("a.ply:3: announces ") + count));
        CHECK(contains(ply_complaint(header_of(std::endian::big) + announced),
                       std::string("a.ply:3: announces ") + count));
    }
    CHECK(contains(ply_complaint(ascii + "element vertex 99999999999999999999\n"),
                   "a.ply:3: expected the number of elements"));
}

TEST_CASE("PLY: complaints about text name the line")
{
    const std::string header = ascii + triangle_header;
    CHECK(contains(ply_complaint(header + "0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
                   "a.ply:10: expected a coordinate, but the line ends"));
    CHECK(contains(ply_complaint(header + "0 0 inf\n1 0 0\n0 1 0\n3 0 1 2\n"), "a.ply:10: expected a coordinate"));
    CHECK(
        contains(ply_complaint(header + "0 0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), "a.ply:10: the line continues with '0'"));
    CHECK(contains(ply_complaint(header + three_ply_vertices), "a.ply:12: the file ends after 0 of 1 elements 'face'"));
    CHECK(contains(ply_complaint(header + three_ply_vertices + "3 0 1\n"),
                   "a.ply:13: expected a whole number, but the line ends"));
    CHECK(
        contains(ply_complaint(header + three_ply_vertices + "3 0 1 2 0\n"), "a.ply:13: the line continues with '0'"));
    CHECK(contains(ply_complaint(header + three_ply_vertices + "3 0 1 3\n"), "a.ply:13: names vertex 3"));
    CHECK(
        contains(ply_complaint(header + three_ply_vertices + "3 0 1 1\n"), "a.ply:13: the face names vertex 1 twice"));
    CHECK(contains(ply_complaint(header + three_ply_vertices + "2 0 1\n"), "a.ply:13: the face has 2 corners"));
    CHECK(contains(ply_complaint(header + three_ply_vertices + "-3 0 1\n"),
                   "a.ply:13: the length of the list 'vertex_indices' is -3"));
    CHECK(contains(ply_complaint(header + three_ply_vertices + "3 0 1 2\n3 0 1 2\n"), "a.ply:14: the file continues"));
    CHECK(contains(ply_complaint(ascii + "element vertex 1\n" + xyz + "property float w\nend_header\n00000 00000 0\n"),
                   "a.ply:9: the line has fewer numbers"));
    CHECK(contains(
        ply_complaint(ascii + "element vertex 1\n" + xyz + "property list int int w\nend_header\n0 0 0 2000000000 1\n"),
        "a.ply:9: the line has fewer numbers"));
}

TEST_CASE("PLY: complaints about binary data name element and byte")
{
    const std::string whole = binary_triangle();
    REQUIRE(identical(read_text("a.ply", whole).mesh, make_triangle()));
    CHECK(identical(read_text("a.ply", whole + std::string(3, '\0') + "\n").mesh, make_triangle()));
    const auto data = whole.size() - 49;
    CHECK(ply_complaint(whole + "x") == std::string("a.ply: byte ") + std::to_string(whole.size()) +
                                            ": the file continues where its header says it should end; correct the "
                                            "counts in the header or export the mesh again");
    for (std::size_t n = 1; n < whole.size(); ++n)
        CHECK(!ply_complaint(whole.substr(0, n)).empty());
    CHECK(contains(ply_complaint(whole.substr(0, whole.size() - 1)),
                   std::string("a.ply: face 0 (numbered from 0), byte ") + std::to_string(data + 36) +
                       ": a list of 3 numbers goes past"));
    auto broken = whole;
    broken.replace(data + 16, 4,
                   Bytes(std::endian::little).add<float>({std::numeric_limits<float>::quiet_NaN()}).text());
    CHECK(contains(ply_complaint(broken), std::string("a.ply: vertex 1 (numbered from 0), byte ") +
                                              std::to_string(data + 16) + ": a coordinate is not a finite number"));
    broken = whole;
    broken[data + 37] = '\x7f';
    CHECK(contains(ply_complaint(broken), "names vertex 127, but the file has only the vertices 0 to 2"));
}

TEST_CASE("PLY: what is written as text")
{
    const TemporaryDirectory folder;
    write_mesh(folder.path() / "a.ply", make_triangle(), {FileFormat::Ply, Encoding::Ascii});
    CHECK(content_of(folder.path() / "a.ply") ==
          ascii +
              "element vertex 3\nproperty double x\nproperty double y\nproperty double z\nelement face 1\n"
              "property list uchar int vertex_indices\nend_header\n" +
              three_ply_vertices + "3 0 1 2\n");
}

TEST_CASE("PLY: labels and their colours")
{
    const TemporaryDirectory folder;
    const auto path = folder.path() / "a.ply";
    auto mesh = make_triangle();
    mesh.add_face(std::vector<Index>{2, 1, 0});
    write_labelled_ply(path, mesh, std::vector<Index>{-1, 70000});
    CHECK(identical(read_mesh(path).mesh, mesh));
    const std::string content = content_of(path);
    CHECK(contains(content, "format binary_little_endian 1.0\n"));
    CHECK(contains(content, "property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n"
                            "property uchar blue\nproperty int label\nend_header\n"));
    const auto colour = colour_of(70000);
    const std::string last = Bytes(std::endian::little)
                                 .add<std::uint8_t>({colour[0], colour[1], colour[2]})
                                 .add<std::int32_t>({70000})
                                 .text();
    CHECK(content.ends_with(last));
    CHECK_THROWS_AS(write_labelled_ply(folder.path() / "b.ply", mesh, std::vector<Index>{1}), OutputError);
    CHECK(folder.n_files() == 1);
}

TEST_CASE("PLY: colours of labels close in number differ clearly")
{
    for (Index label = 0; label < 1000; ++label)
        for (Index other = label + 1; other < label + 5; ++other) {
            int distance = 0;
            for (std::size_t k = 0; k < 3; ++k)
                distance += std::abs(int{colour_of(label)[k]} - int{colour_of(other)[k]});
            CHECK(distance > 60);
        }
}

TEST_CASE("PLY: a mesh with colours and values at its vertices")
{
    const TemporaryDirectory folder;
    const auto path = folder.path() / "a.ply";
    const auto mesh = make_triangle();
    const std::vector<Colour> colours{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<VertexValues> values{{"distance", {0.5, 1e-300, nan}}, {"normal", {-1.0, 0.0, 1.0}}};
    write_valued_ply(path, mesh, colours, values);
    CHECK(identical(read_mesh(path).mesh, mesh));
    const std::string content = content_of(path);
    CHECK(contains(content, "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                            "property double distance\nproperty double normal\nelement face 1\n"));
    const std::string second = Bytes(std::endian::little)
                                   .add<double>({mesh.vertices(1, 0), mesh.vertices(1, 1), mesh.vertices(1, 2)})
                                   .add<std::uint8_t>({4, 5, 6})
                                   .add<double>({1e-300, 0.0})
                                   .text();
    CHECK(contains(content, second));
    CHECK_THROWS_AS(write_valued_ply(folder / "b.ply", mesh, std::vector<Colour>(2), values), OutputError);
    CHECK_THROWS_AS(write_valued_ply(folder / "b.ply", mesh, colours, std::vector<VertexValues>{{"few", {1.0}}}),
                    OutputError);
    CHECK(folder.n_files() == 1);
}

TEST_CASE("PLY: colours of values")
{
    CHECK(rainbow_colour(0.0) == Colour{0, 0, 255});
    CHECK(rainbow_colour(0.125) == Colour{0, 128, 255});
    CHECK(rainbow_colour(0.5) == Colour{0, 255, 0});
    CHECK(rainbow_colour(1.0) == Colour{255, 0, 0});
    CHECK(rainbow_colour(7.0) == Colour{255, 0, 0});
    CHECK(rainbow_colour(-1.0) == Colour{0, 0, 255});
    CHECK(rainbow_colour(std::numeric_limits<double>::quiet_NaN()) == Colour{128, 128, 128});
    CHECK(signed_colour(-1.0) == Colour{0, 0, 255});
    CHECK(signed_colour(0.0) == Colour{255, 255, 255});
    CHECK(signed_colour(0.5) == Colour{255, 128, 128});
    CHECK(signed_colour(9.0) == Colour{255, 0, 0});
}

namespace {

std::string text_ply(const std::string& elements, const std::string& data, const std::string& coordinate = "double")
{
    return "ply\nformat ascii 1.0\nelement vertex 5\nproperty " + coordinate + " x\nproperty " + coordinate +
           " y\nproperty " + coordinate + " z\n" + elements + "end_header\n" + data;
}

const std::string five_vertices = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n";

}  // namespace

TEST_CASE("PLY: triangle strips are faces, every other one turned, and stay in the file")
{
    const std::string strips = "element tristrips 2\nproperty list int int vertex_indices\n";
    // The second list has two strips, and one that goes over a vertex twice.
    const std::string content = text_ply(strips, five_vertices + "5 0 1 2 3 4\n8 1 3 2 -1 2 3 3 4\n");
    const PolygonMesh mesh = read_text("a.ply", content).mesh;
    CHECK(mesh.face_vertices == std::vector<Index>{0, 1, 2, 2, 1, 3, 2, 3, 4, 1, 3, 2});
    CHECK(rewritten("a.ply", content, move_second).content == with(content, "1 0 0\n", "2 0.1 0\n"));
    CHECK(contains(ply_complaint(text_ply(strips, five_vertices + "3 0 1 5\n3 0 1 2\n")), "names vertex 5"));
    CHECK(contains(ply_complaint(text_ply(strips, five_vertices + "3 0 1 -2\n3 0 1 2\n")), "names vertex -2"));
}

TEST_CASE("PLY: whole numbers of 64 bits")
{
    const std::string lists = "property int64 id\nelement face 2\nproperty list uint64 int64 vertex_indices\n";
    const std::string rows = "0 0 0 -9000000000\n1 0 0 1\n0 1 0 2\n1 1 0 3\n0 2 0 4\n";
    const std::string content = text_ply(lists, rows + "3 0 1 2\n4 2 1 3 4\n");
    const PolygonMesh expected = read_text("a.ply", content).mesh;
    CHECK(expected.n_faces() == 2);
    CHECK(rewritten("a.ply", content, move_second).content == with(content, "1 0 0 1", "2 0.1 0 1"));
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        std::string binary =
            with(content.substr(0, content.find("0 0 0 -9")), "format ascii",
                 order == std::endian::little ? "format binary_little_endian" : "format binary_big_endian");
        const auto append = [&](auto value) {
            const auto bytes = to_bytes(value, order);
            binary.append(bytes.begin(), bytes.end());
        };
        for (Index v = 0; v < 5; ++v) {
            for (Index k = 0; k < 3; ++k)
                append(expected.vertices(v, k));
            append(std::int64_t{v} - 9'000'000'000);
        }
        for (Index f = 0; f < 2; ++f) {
            append(static_cast<std::uint64_t>(expected.face(f).size()));
            for (const Index corner : expected.face(f))
                append(std::int64_t{corner});
        }
        CHECK(identical(read_text("a.ply", binary).mesh, expected));
        const std::string again = rewritten("a.ply", binary, [](Points& points) { points(0, 0) = 0.5; }).content;
        CHECK(again.size() == binary.size());
        CHECK(read_text("a.ply", again).mesh.vertices(0, 0) == 0.5);
        CHECK(contains(complaint_about("a.ply", binary.substr(0, binary.size() - 1)), "cut off"));
    }
    // No number of a vertex, and not taken for a small one.
    CHECK(contains(ply_complaint(text_ply(lists, rows + "3 0 1 4294967296\n3 0 1 2\n")), "names vertex 4294967296"));
}

TEST_CASE("PLY and OFF: lines may break anywhere, and stay as they are")
{
    const std::string faces = "element face 2\nproperty list uchar int vertex_indices\n";
    const PolygonMesh expected = read_text("a.ply", text_ply(faces, five_vertices + "3 0 1 2\n4 2 1 3 4\n")).mesh;
    const std::string data = "0 0 0 1 0\n0 0 1 0\n\n1 1 0 0 2 0 3 0 1 2 4\n2 1\n3\n4\n";
    for (const auto& example :
         {std::pair{"a.ply", text_ply(faces, data)},
          {"a.off", "OFF\n5\n2 0\n" + data},
          {"b.off", "NOFF 5 2 0 0 0 0 9 9 9 1 0 0 9 9 9 0 1 0 9 9\n9 1 1 0 9 9 9 0 2 0 9 9 9 3 0 1 2 4 2 1 3 4"},
          {"c.off", "STOFF 5 2 0 0 0 0 9 9 1 0 0 9 9 0 1 0 9 9\n1 1 0 9 9 0 2 0 9 9 3 0 1 2 4 2 1 3 4"}}) {
        const auto& name = example.first;
        const auto& content = example.second;
        CAPTURE(name);
        CHECK(identical(read_text(name, content).mesh, expected));
        CHECK(rewritten(name, content, stay_put).content == content);
        const std::string moved = rewritten(name, content, [](Points& points) { points.row(4) << 0, 3.5, 7; }).content;
        PolygonMesh of_moved = expected;
        of_moved.vertices.row(4) << 0, 3.5, 7;
        CHECK(identical(read_text(name, moved).mesh, of_moved));
    }
    // What is missing is told of by its line.
    CHECK(contains(ply_complaint(text_ply(faces, data.substr(0, data.size() - 2))), "a.ply:"));
    CHECK(!complaint_about("a.off", "OFF\n5 2 0\n" + data.substr(0, data.size() - 2)).empty());
    // With colours, or with what follows the corners, nobody knows what is what.
    CHECK(!complaint_about("a.off", "COFF\n5 2 0\n" + data).empty());
    CHECK(!complaint_about("a.off", "OFF\n5 2 0\n" + data + "255 0 0\n").empty());
}
