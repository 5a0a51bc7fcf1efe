#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "partition/formats/file_fields.h"
#include "partition/formats/mesh_io.h"
#include "partition/formats/obj.h"
#include "partition/formats/off.h"
#include "partition/formats/ply.h"
#include "partition/io/byte_order.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

using FieldNames = std::vector<std::string>;
constexpr double no_data = std::numeric_limits<double>::quiet_NaN();

FileFields fields_in(const std::string& name, std::string_view content, const FieldNames& names)
{
    return read_fields(*read_text(name, content).source, names);
}

/// The message of what `act` throws, without the folder; empty if it throws nothing.
template <class Error>
std::string complaint_of(const TemporaryDirectory& folder, const std::function<void()>& act)
{
    std::string message = message_of<Error>(act);
    const std::string prefix = folder.path().string() + "/";
    if (const auto at = message.find(prefix); at != std::string::npos)
        message.erase(at, prefix.size());
    return message;
}

std::string complaint_about_fields(const std::string& name, std::string_view content, const FieldNames& names)
{
    const TemporaryDirectory folder;
    const MeshFile file = read_mesh(folder.with(name, content));
    return complaint_of<InputError>(folder, [&] { read_fields(*file.source, names); });
}

/// Reads a file of this name and content, and writes it again with these fields.
Rewritten with_fields(const std::string& name, std::string_view content, const FileFields& fields,
                      const std::function<void(Points&)>& change = stay_put)
{
    const TemporaryDirectory folder;
    MeshFile file = read_mesh(folder.with(name, content));
    change(file.mesh.vertices);
    const auto copy = folder / ("copy of " + name);
    Rewritten result;
    result.remarks = write_mesh_like(*file.source, copy, file.mesh, fields);
    result.content = content_of(copy);
    return result;
}

std::string complaint_of_fields(const std::string& name, std::string_view content, const FileFields& fields)
{
    const TemporaryDirectory folder;
    const MeshFile file = read_mesh(folder.with(name, content));
    return complaint_of<OutputError>(folder,
                                     [&] { write_mesh_like(*file.source, folder / ("b" + name), file.mesh, fields); });
}

FileFields one_field(const std::string& name, const std::vector<double>& values)
{
    FileFields fields{{name}, Eigen::MatrixXd(static_cast<Index>(values.size()), 1)};
    fields.values.col(0) = Eigen::VectorXd::Map(values.data(), fields.values.rows());
    return fields;
}

bool are_same(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
    return a.rows() == b.rows() && a.cols() == b.cols() &&
           ((a.array() == b.array()) || (a.array().isNaN() && b.array().isNaN())).all();
}

const FieldNames all_types = {"int8",   "uint8", "int16",  "uint16", "int32",
                              "uint32", "int64", "uint64", "float",  "double"};

/// Three vertices with a number of each type, a list among them, and another element before them.
/// @param values 3 by all_types, which the types can hold.
std::string file_of_all_types(Encoding encoding, const Eigen::MatrixXd& values, const std::string& line_end)
{
    const bool is_text = encoding == Encoding::Ascii;
    const std::endian order = encoding == Encoding::BinaryBigEndian ? std::endian::big : std::endian::little;
    std::string file;
    const auto line = [&](const std::string& text) { file += text + line_end; };
    const auto number = [&](auto value) {
        const auto bytes = to_bytes(value, order);
        file += is_text ? fmt::format("{} ", value) : std::string(bytes.data(), bytes.size());
    };
    const auto end_element = [&] { file += is_text ? line_end : ""; };
    line("ply");
    line(is_text                     ? "format ascii 1.0"
         : order == std::endian::big ? "format binary_big_endian 1.0"
                                     : "format binary_little_endian 1.0");
    line("element camera 2");
    line("property list uchar float view");
    line("element vertex 3");
    for (const char* name : {"int8", "uint8", "int16", "uint16"})
        line(fmt::format("property {} {}", name, name));
    line("property float y");
    line("property list uchar short tags");
    for (const char* name : {"int32", "uint32", "int64", "uint64"})
        line(fmt::format("property {} {}", name, name));
    line("property double x");
    line("comment by hand");
    line("property float float");
    line("property double double");
    line("property float z");
    line("element face 1");
    line("property list uchar int vertex_indices");
    line("end_header");
    number(std::uint8_t{1});
    number(0.5F);
    end_element();
    number(std::uint8_t{0});
    end_element();
    for (Index v = 0; v < 3; ++v) {
        const auto row = values.row(v);
        number(static_cast<std::int8_t>(row[0]));
        number(static_cast<std::uint8_t>(row[1]));
        number(static_cast<std::int16_t>(row[2]));
        number(static_cast<std::uint16_t>(row[3]));
        number(v == 2 ? 1.F : 0.F);
        number(static_cast<std::uint8_t>(v));
        for (Index k = 0; k < v; ++k)
            number(static_cast<std::int16_t>(-7));
        number(static_cast<std::int32_t>(row[4]));
        number(static_cast<std::uint32_t>(row[5]));
        number(static_cast<std::int64_t>(row[6]));
        number(static_cast<std::uint64_t>(row[7]));
        number(v == 1 ? 0.1 : 0.0);
        number(static_cast<float>(row[8]));
        number(row[9]);
        number(0.F);
        end_element();
    }
    number(std::uint8_t{3});
    for (const std::int32_t corner : {0, 1, 2})
        number(corner);
    end_element();
    return file;
}

Eigen::MatrixXd values_of_all_types()
{
    Eigen::MatrixXd values(3, 10);
    values << -128, 0, -32768, 0, -2147483648.0, 0, -9223372036854775808.0, 0, -0.25, -1e300,        //
        127, 255, 32767, 65535, 2147483647.0, 4294967295.0, 9007199254740992.0, 9e15, 65536.5, 0.1,  //
        0, 1, 2, 3, 4, 5, 6, 7, no_data, no_data;
    return values;
}

const std::string scalar_ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                               "property float z\nproperty uchar red\nproperty float quality\n"
                               "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                               "0 0 0 007 1.50\n1 0 0 10 0.1\n0 1 0 255 nan\n3 0 1 2\n";
const std::string coloured_obj = "# by hand\nv 0 0 0 0.50 0 1\nv 1 0 0 .25 0.1 1.0 # second\nvn 0 0 1\n"
                                 "v 0 1 0 1 1 0\nf 1//1 2//1 3//1\n";
const std::string coloured_off = "COFF\n3 1 0\n0 0 0 255 0 7 255\n1 0 0 010 20 30 128 # two\n0 1 0 0 0 0 0\n3 0 1 2\n";

}  // namespace

TEST_CASE("fields of PLY files are read and written in all types and encodings")
{
    const Eigen::MatrixXd values = values_of_all_types();
    Eigen::MatrixXd others = values.colwise().reverse();
    others(1, 2) = -5;
    for (const std::string line_end : {"\n", "\r\n"})
        for (const Encoding encoding : {Encoding::Ascii, Encoding::BinaryLittleEndian, Encoding::BinaryBigEndian}) {
            const std::string file = file_of_all_types(encoding, values, line_end);
            FileFields fields = fields_in("a.ply", file, all_types);
            CHECK(fields.names == all_types);
            CHECK(are_same(fields.values, values));
            CHECK((with_fields("a.ply", file, fields).content == file));
            fields.values = values.array().isNaN().select(-no_data, values);
            CHECK((with_fields("a.ply", file, fields).content == file));
            fields.values = others;
            const Rewritten after = with_fields("a.ply", file, fields);
            CHECK((after.content == file_of_all_types(encoding, others, line_end)));
            CHECK(after.remarks.empty());
        }
}

TEST_CASE("fields of PLY files: some of them, each once, in the order of their names")
{
    const std::string file = file_of_all_types(Encoding::BinaryLittleEndian, values_of_all_types(), "\n");
    const FileFields fields = fields_in("a.ply", file, {"double", "uint8", "double"});
    CHECK(fields.names == FieldNames{"double", "uint8"});
    CHECK(fields.column("uint8") == 1);
    CHECK(fields.column("int8") == -1);
    CHECK(are_same(fields.values.col(0), values_of_all_types().col(9)));
    CHECK(are_same(fields.values.col(1), values_of_all_types().col(1)));
    CHECK(fields_in("a.ply", file, {}).values.cols() == 0);
}

TEST_CASE("fields replace numbers in text where they differ, and nothing else")
{
    FileFields fields = fields_in("a.ply", scalar_ply, {"quality", "red"});
    CHECK(with_fields("a.ply", scalar_ply, fields).content == scalar_ply);
    fields.values(1, 0) = 1.0 / 3.0;
    fields.values(2, 0) = 2;
    fields.values(0, 0) = -no_data;
    CHECK(with_fields("a.ply", scalar_ply, fields).content ==
          with(with(with(scalar_ply, "1.50", "nan"), "0.1", "0.33333334"), "nan\n3", "2\n3"));
    CHECK(contains(with_fields("a.ply", scalar_ply, fields, move_second).content, "2 0.1 0 10 0.33333334"));
}

TEST_CASE("fields of whole numbers are rounded once and kept within the range of their type")
{
    const auto red = [](const std::vector<double>& values) {
        return with_fields("a.ply", scalar_ply, one_field("red", values));
    };
    CHECK(red({7.4, 9.5, 254.5}).content == with(scalar_ply, "007", "7"));
    CHECK(red({7, 9.49, 255.49}).content == with(scalar_ply, " 10 ", " 9 "));
    CHECK(red({7, 9, 255}).remarks.empty());
    CHECK(red({7.4, 9.49, 255.49}).remarks ==
          std::vector<std::string>{
              "the values of 'red' are rounded to the nearest whole numbers, as which the file holds "
              "them"});
    const Rewritten clamped = red({-3, 0.4999, 1e300});
    CHECK(clamped.content == with(with(scalar_ply, "007", "0"), " 10 ", " 0 "));
    FileFields as_written = one_field("red", {-3, 0.4999, 1e300});
    as_written.whole = {WholeRange{0.0, 255.0}};
    round_as_written(as_written, as_written.values, run_serially);
    CHECK(as_written.values == Eigen::Vector3d(0.0, 0.0, 255.0));
    REQUIRE(clamped.remarks.size() == 2);
    CHECK(clamped.remarks[0] == "some values of 'red' are beyond the range of uchar and are written as its least or "
                                "largest number");
    for (const Encoding encoding : {Encoding::Ascii, Encoding::BinaryBigEndian}) {
        const std::string file = file_of_all_types(encoding, values_of_all_types(), "\n");
        FileFields fields = fields_in("a.ply", file, {"int64", "uint64"});
        fields.values << 1e19, 1e20, -1e19, -1, 2.5, 9e18;
        const FileFields after = fields_in("a.ply", with_fields("a.ply", file, fields).content, fields.names);
        Eigen::MatrixXd expected(3, 2);
        expected << 9223372036854775807.0, 18446744073709551615.0, -9223372036854775808.0, 0, 3, 9e18;
        CHECK(after.values == expected);
    }
}

TEST_CASE("fields are rounded to what was written, as it is read again")
{
    const auto check = [](const std::string& name, const std::string& content, const FieldNames& names, auto&& change) {
        CAPTURE(name);
        FileFields fields = fields_in(name, content, names);
        fields.values = fields.values.unaryExpr(change).eval();
        const Eigen::MatrixXd computed = fields.values;
        const Rewritten after = with_fields(name, content, fields);
        round_as_written(fields, computed, run_serially);
        CHECK(are_same(fields.values, fields_in(name, after.content, names).values));
        return !are_same(fields.values, computed);
    };
    const auto third = [](double value) { return value / 3.0; };
    const FieldNames names{"double", "float", "uint8", "int64"};
    for (const Encoding encoding : {Encoding::Ascii, Encoding::BinaryLittleEndian, Encoding::BinaryBigEndian}) {
        const std::string ply = file_of_all_types(encoding, values_of_all_types(), "\n");
        CHECK(check("a.ply", ply, names, third));
        CHECK(check("a.ply", ply, {"float"}, third));
        CHECK_FALSE(check("a.ply", ply, {"double"}, third));
        // The property becomes one of doubles.
        CHECK_FALSE(check("a.ply", ply, {"float"}, [](double value) { return 1e100 * value / 3.0; }));
    }
    CHECK(check("a.obj", coloured_obj, {"red", "green", "blue"}, third));
    CHECK(check("a.off", coloured_off, {"red", "alpha"}, third));
}

TEST_CASE("fields beyond single precision become doubles")
{
    const Rewritten text = with_fields("a.ply", scalar_ply, one_field("quality", {1.5, 1e39, no_data}));
    CHECK(text.content == with(with(scalar_ply, "float quality", "double quality"), "0.1\n", "1e+39\n"));
    REQUIRE(text.remarks.size() == 1);
    CHECK(contains(text.remarks[0], "the type of quality is double instead of float"));
    const std::string file = file_of_all_types(Encoding::BinaryLittleEndian, values_of_all_types(), "\n");
    const Rewritten binary = with_fields("a.ply", file, one_field("float", {0.1, 1e39, no_data}));
    CHECK(are_same(fields_in("a.ply", binary.content, {"float"}).values, one_field("", {0.1, 1e39, no_data}).values));
    CHECK(are_same(fields_in("a.ply", binary.content, {"double"}).values, values_of_all_types().col(9)));
}

TEST_CASE("fields that a PLY file lacks are added behind each vertex")
{
    FileFields fields{{"red", "distance", "other"}, Eigen::MatrixXd(3, 3)};
    fields.values << 7, 0.1, 1, 10, no_data, 2, 255, 1e300, 3;
    const std::string added = "property float quality\nproperty double distance\nproperty double other\n";
    CHECK(with_fields("a.ply", scalar_ply, fields).content ==
          with(with(with(with(scalar_ply, "property float quality\n", added), "1.50", "1.50 0.1 1"), "0.1\n",
                    "0.1 nan 2\n"),
               "nan\n3", "nan 1e+300 3\n3"));
    for (const std::string line_end : {"\n", "\r\n"})
        for (const Encoding encoding : {Encoding::Ascii, Encoding::BinaryLittleEndian, Encoding::BinaryBigEndian}) {
            const std::string file = file_of_all_types(encoding, values_of_all_types(), line_end);
            const std::string after = with_fields("a.ply", file, one_field("distance", {0.1, no_data, 3})).content;
            CHECK(contains(after,
                           "property float z" + line_end + "property double distance" + line_end + "element face"));
            CHECK(are_same(fields_in("a.ply", after, {"distance"}).values, one_field("", {0.1, no_data, 3}).values));
            CHECK(are_same(fields_in("a.ply", after, all_types).values, values_of_all_types()));
            CHECK(identical(read_text("a.ply", after).mesh, read_text("a.ply", file).mesh));
        }
}

TEST_CASE("fields of text PLY files with other line breaks or surplus numbers")
{
    const std::string header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                               "property float z\nproperty uchar red\n";
    const std::string faces = "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string free = "0 0 0 1 1 0 0\n2 0 1\n0 3\n3 0 1 2 3 0 2 1\n";
    const FileFields fields{{"red", "d"}, (Eigen::MatrixXd(3, 2) << 9, 0.5, 2, 0.25, 3, 0).finished()};
    const std::string added = header + "property double d\n" + faces;
    CHECK(are_same(fields_in("a.ply", header + faces + free, {"red"}).values, one_field("", {1, 2, 3}).values));
    CHECK(with_fields("a.ply", header + faces + free, fields).content ==
          added + "0 0 0 9 0.5 1 0 0\n2 0.25 0 1\n0 3 0\n3 0 1 2 3 0 2 1\n");

    const TemporaryDirectory folder;
    FaultLog faults{.of_faces_alone = true};
    const std::string surplus = "0 0 0 1\n1 0 0 2 77 8\n0 1 0 3\n3 0 1 2\n3 0 1 1\n";
    const MeshFile file = read_faulty_mesh(folder.with("a.ply", header + faces + surplus), faults);
    CHECK(faults.faces_left_out == std::vector<Index>{1});
    const FieldNames red = {"red"};
    CHECK(are_same(read_fields(*file.source, red).values, one_field("", {1, 2, 3}).values));
    write_mesh_like(*file.source, folder / "b.ply", file.mesh, fields);
    CHECK(content_of(folder / "b.ply") == added + "0 0 0 9 0.5\n1 0 0 2 0.25 77 8\n0 1 0 3 0\n3 0 1 2\n3 0 1 1\n");
}

TEST_CASE("fields: normal and colour stand for three names each, unless the file has such a name")
{
    const std::string file =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float "
        "nx\n"
        "property float ny\nproperty double nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 0 0 1 1 2 3\n1 0 0 0 0 1 4 5 6\n0 1 0 0 0 1.0 7 8 9\n3 0 1 2\n";
    const FileFields fields = fields_in("a.ply", file, {"color", "normal", "red"});
    CHECK(fields.names == FieldNames{"red", "green", "blue", "nx", "ny", "nz"});
    CHECK(fields.values(1, 2) == 6);
    CHECK(fields.values(1, 5) == 1);
    const std::string named = with(file, "uchar red", "uchar colour");
    CHECK(fields_in("a.ply", named, {"colour"}).names == FieldNames{"colour"});
}

TEST_CASE("fields: normals that are given are not updated to the surface, others are")
{
    const std::string file = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
                             "float z\nproperty float nx\n"
                             "property float ny\nproperty double nz\nproperty float q\nelement face 1\nproperty list "
                             "uchar int vertex_indices\n"
                             "end_header\n0 0 0 0 0 1 5\n1 0 0 0 0 1 6\n0 1 0 0 0 1.0 7\n3 0 1 2\n";
    const auto stand_up = [](Points& points) { points.row(2) << 0, 0, 1; };
    FileFields fields = fields_in("a.ply", file, {"normal"});
    CHECK(with_fields("a.ply", file, fields, stand_up).content == with(file, "0 1 0 0 0 1.0", "0 0 1 0 0 1.0"));
    fields.values(1, 0) = 0.1;
    CHECK(with_fields("a.ply", file, fields).content == with(file, "1 0 0 0 0 1", "1 0 0 0.1 0 1"));
    CHECK(contains(with_fields("a.ply", file, one_field("q", {5, 6, 8}), stand_up).content, "0 0 1 0 -1 0 8\n"));
    CHECK(contains(with_fields("a.ply", file, one_field("nx", {0, 0, 0.5}), stand_up).content, "0 0 1 0.5 0 1.0 7\n"));
}

TEST_CASE("fields of PLY files that cannot be read")
{
    CHECK(complaint_about_fields("a.ply", scalar_ply, {"speed"}) ==
          "a.ply:3: the vertices have no number 'speed', but x, y, z, red, quality; name the property to use");
    CHECK(complaint_about_fields("a.ply", scalar_ply, {"y"}) ==
          "a.ply: 'y' is a coordinate of the positions, not a field; name another property");
    const std::string list = with(scalar_ply, "float quality", "list uchar float quality");
    CHECK(complaint_about_fields("a.ply", with(with(with(list, "1.50", "0"), "0.1", "0"), "nan", "0"), {"quality"}) ==
          "a.ply:8: the vertices have no number 'quality', but x, y, z, red, quality; name the property to use");
    CHECK(complaint_about_fields("a.ply", with(scalar_ply, "0.1", "inf"), {"quality"}) ==
          "a.ply:13: expected the number 'quality', but found 'inf'; write a finite number such as 1.5 or -2e-3");
    CHECK(
        complaint_about_fields("a.ply", with(scalar_ply, "0.1", "nano"), {"quality"}) ==
        "a.ply:13: expected the number 'quality', but found 'nano'; write a finite number, or nan where there is none");
    CHECK(are_same(fields_in("a.ply", with(scalar_ply, "0.1", "-NaN"), {"quality"}).values,
                   one_field("", {1.5, no_data, no_data}).values));
    Eigen::MatrixXd values = values_of_all_types();
    values(1, 8) = std::numeric_limits<double>::infinity();
    const std::string file = file_of_all_types(Encoding::BinaryBigEndian, values, "\n");
    CHECK(contains(complaint_about_fields("a.ply", file, {"float"}), "a.ply: vertex 1 (numbered from 0), byte "));
    CHECK(contains(complaint_about_fields("a.ply", file, {"float"}),
                   ": the number 'float' is infinite; write a finite number, or NaN where there is none"));
    CHECK(complaint_about_fields("a.ply", file, {"double"}).empty());
}

TEST_CASE("fields that cannot be written")
{
    const auto complaint = [](const FileFields& fields) { return complaint_of_fields("a.ply", scalar_ply, fields); };
    CHECK(complaint(one_field("x", {0, 0, 0})) ==
          "ba.ply: cannot be written: the field 'x' is a coordinate; change the "
          "positions of the mesh, or give the field another name");
    CHECK(complaint(one_field("a b", {0, 0, 0})) ==
          "ba.ply: cannot be written: the field 'a b' must have a name of one "
          "word; name it with letters, digits and underscores");
    CHECK(complaint({{"q", "q"}, Eigen::MatrixXd::Zero(3, 2)}) ==
          "ba.ply: cannot be written: the field 'q' is there twice; leave one out");
    CHECK(complaint(one_field("q", {0, 0})) ==
          "ba.ply: cannot be written: there are 2 by 1 values for 3 vertices and 1 fields; give a row for each vertex "
          "and a column for each name");
    CHECK(
        complaint(one_field("q", {0, 0, -HUGE_VAL})) ==
        "ba.ply: cannot be written: the field 'q' of vertex 2 (numbered from 0) is infinite; give a finite number, or "
        "NaN where there is none");
    CHECK(complaint(one_field("red", {0, no_data, 0})) ==
          "ba.ply: cannot be written: the property 'red' is a whole number in the file that was read, but some values "
          "are not; give each vertex a number");
    const std::string file = file_of_all_types(Encoding::Ascii, values_of_all_types(), "\n");
    CHECK(complaint_of_fields("a.ply", file, one_field("tags", {0, 0, 0})) ==
          "ba.ply: cannot be written: the property 'tags' is a list in the file that was read, not a number; give the "
          "values another name");
}

TEST_CASE("fields of large PLY files are read in slices, and faults name their lines")
{
    constexpr Index n = 30000;
    std::string file =
        fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty "
                    "float z\nproperty double q\nend_header\n",
                    n);
    const std::size_t header = file.size();
    for (Index v = 0; v < n; ++v)
        file += fmt::format("{} 0.25 1 {}\n", v, v + 0.5);
    CHECK(file.size() - header > std::size_t{1} << 18);
    FileFields fields = fields_in("a.ply", file, {"q"});
    CHECK(are_same(fields.values, Eigen::VectorXd::LinSpaced(n, 0.5, n - 0.5)));
    fields.values(n - 1, 0) = 7;
    fields.names.emplace_back("d");
    fields.values.conservativeResize(n, 2);
    fields.values.col(1) = -fields.values.col(0);
    const FileFields after = fields_in("a.ply", with_fields("a.ply", file, fields).content, {"q", "d"});
    CHECK(are_same(after.values, fields.values));
    CHECK(complaint_about_fields("a.ply", with(file, "29000.5", "x"), {"q"}) ==
          "a.ply:29009: expected the number 'q', but found 'x'; write a finite number such as 1.5 or -2e-3");
}

TEST_CASE("colours of OBJ files are fields")
{
    FileFields fields = fields_in("a.obj", coloured_obj, {"blue", "red"});
    CHECK(fields.names == FieldNames{"blue", "red"});
    CHECK(are_same(fields.values, (Eigen::MatrixXd(3, 2) << 1, 0.5, 1, 0.25, 0, 1).finished()));
    CHECK(with_fields("a.obj", coloured_obj, fields).content == coloured_obj);
    fields.values.row(1) << 0.5, 0.1 + 0.2;
    CHECK(with_fields("a.obj", coloured_obj, fields).content == with(coloured_obj, ".25 0.1 1.0 #", "0.3 0.1 0.5 #"));
    CHECK(contains(with_fields("a.obj", coloured_obj, fields, move_second).content, "v 2 0.1 0 0.3 0.1 0.5 # second"));
    const std::string alpha = "v 0 0 0 0 0 0 1\nv 1 0 0 0 0 0 \\\n0.5\nv 0 1 0 0 0 0 0\nf 1 2 3\n";
    CHECK(are_same(fields_in("a.obj", alpha, {"alpha"}).values, one_field("", {1, 0.5, 0}).values));
    CHECK(fields_in("a.obj", alpha, {"colour"}).names == FieldNames{"red", "green", "blue"});
    CHECK(with_fields("a.obj", alpha, one_field("alpha", {1, 0.75, 0})).content == with(alpha, "0.5", "0.75"));
}

TEST_CASE("colours of OBJ files: whole numbers stay whole if they are not fractions of 1")
{
    const std::string bytes = "v 0 0 0 255 0 0\r\nv 1 0 0 0 010 0\r\nv 0 1 0 0 7 2\r\nf 1 2 3\r\n";
    FileFields fields = fields_in("a.obj", bytes, {"green"});
    CHECK(with_fields("a.obj", bytes, fields).content == bytes);
    fields.values << -0.4, 9.5, 300;
    const Rewritten clamped = with_fields("a.obj", bytes, fields);
    CHECK(clamped.content == with(with(bytes, "010 0", "10 0"), "7 2", "255 2"));
    REQUIRE(clamped.remarks.size() == 1);
    CHECK(clamped.remarks[0] == "some values of 'green' are beyond the range 0 to 255 and are written as its least or "
                                "largest number");
    const std::string wide = with(bytes, "255", "65535");
    fields.values << 0, 10, 65535.4;
    CHECK(with_fields("a.obj", wide, fields).content == with(wide, "7 2", "65535 2"));
    CHECK(with_fields("a.obj", wide, fields).remarks.empty());
    const std::string fractions = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n";
    fields.values << 0.25, 0.5, 0;
    CHECK(with_fields("a.obj", fractions, fields).content ==
          with(with(fractions, "1 0 0\nv 1", "1 0.25 0\nv 1"), "0 1 0\nv", "0 0.5 0\nv"));
}

TEST_CASE("colours of OBJ files that cannot be read or written")
{
    CHECK(
        complaint_about_fields("a.obj", coloured_obj, {"quality"}) ==
        "a.obj: the vertices have no number 'quality', but at most the colours red, green, blue and alpha; name one of "
        "these, or convert the mesh and its data to PLY");
    CHECK(
        complaint_about_fields("a.obj", coloured_obj, {"red", "alpha"}) ==
        "a.obj:2: vertex 0 (numbered from 0) has 3 numbers where the 4 numbers of a colour should be; give each vertex "
        "a colour, or name no colours");
    CHECK(
        complaint_about_fields("a.obj", with(coloured_obj, " 1 1 0\n", "\n"), {"red"}) ==
        "a.obj:5: vertex 2 (numbered from 0) has 0 numbers where the 3 numbers of a colour should be; give each vertex "
        "a colour, or name no colours");
    CHECK(complaint_about_fields("a.obj", with(coloured_obj, ".25", "nan"), {"red"}) ==
          "a.obj:3: expected a colour, but found 'nan'; write a finite number such as 0.5 or 128");
    CHECK(complaint_of_fields("a.obj", coloured_obj, one_field("distance", {0, 1, 2})) ==
          "ba.obj: cannot be written: the format has no place for the field 'distance'; write a .ply file, which holds "
          "any");
    CHECK(complaint_of_fields("a.obj", coloured_obj, one_field("red", {0, no_data, 2})) ==
          "ba.obj: cannot be written: a colour is not a number; give each vertex a colour");
}

TEST_CASE("colours of OFF files are fields")
{
    FileFields fields = fields_in("a.off", coloured_off, {"red", "alpha"});
    CHECK(are_same(fields.values, (Eigen::MatrixXd(3, 2) << 255, 255, 10, 128, 0, 0).finished()));
    CHECK(with_fields("a.off", coloured_off, fields).content == coloured_off);
    fields.values.row(1) << 11.2, -1;
    CHECK(with_fields("a.off", coloured_off, fields).content == with(coloured_off, "010 20 30 128", "11 20 30 0"));
    const std::string all =
        "STCNOFF\n3 1 0\n0 0 0 0 0 1 0.5 0 0 7 8\n1 0 0 0 0 1 0 1 0 7 8\n0 1 0 0 0 1 0 0 1 7 8\n3 0 1 2\n";
    CHECK(are_same(fields_in("a.off", all, {"red"}).values, one_field("", {0.5, 0, 0}).values));
    CHECK(with_fields("a.off", all, one_field("red", {0.5, 0.125, 0})).content ==
          with(all, "0 0 1 0 1 0 7", "0 0 1 0.125 1 0 7"));
    const Rewritten moved =
        with_fields("a.off", all, one_field("red", {0.5, 0.125, 0}), [](Points& points) { points.row(2) << 0, 0, 1; });
    CHECK(contains(moved.content, "1 0 0 0 -1 0 0.125 1 0 7 8\n"));
    CHECK(complaint_about_fields("a.off", "OFF" + coloured_off.substr(4), {"red"}) ==
          "a.off:2: the keyword 'OFF' announces no colours of vertices; write them behind the coordinates, and the "
          "keyword COFF");
}

TEST_CASE("fields are the same in whatever slices they are read and written")
{
    const TemporaryDirectory folder;
    const auto in_slices = [&](const std::string& name, const std::string& content, const auto& read,
                               const auto& rewrite, const FieldNames& names) {
        const PolygonMesh mesh = read_text(name, content).mesh;
        FileFields fields = fields_in(name, content, names);
        const Eigen::MatrixXd values = fields.values;
        fields.values.array() += 1;
        const std::string whole = with_fields(name, content, fields).content;
        for (const std::size_t bytes : {1, 20, 50, 1000}) {
            const Slicing slicing{run_serially, bytes};
            CHECK(are_same(read(name, content, names, slicing).values, values));
            OutputFile file(folder / name);
            rewrite(file, name, content, mesh, slicing, fields, 0.0);
            file.commit();
            CHECK((content_of(folder / name) == whole));
        }
    };
    const FieldNames some = {"int8", "float", "double"};
    for (const Encoding encoding : {Encoding::Ascii, Encoding::BinaryLittleEndian, Encoding::BinaryBigEndian})
        in_slices("a.ply", file_of_all_types(encoding, values_of_all_types(), "\r\n"), read_ply_fields, rewrite_ply,
                  some);
    in_slices("a.obj", coloured_obj, read_obj_fields, rewrite_obj, {"colour"});
    in_slices("a.off", coloured_off, read_off_fields, rewrite_off, {"red", "alpha"});
}

TEST_CASE("fields: compressed files, STL files, and other formats")
{
    const TemporaryDirectory folder;
    const MeshFile file = read_mesh(folder.with("a.ply", scalar_ply));
    const FieldNames quality = {"quality"};
    FileFields fields = read_fields(*file.source, quality);
    write_mesh_like(*file.source, folder / "b.ply.gz", file.mesh, fields);
    const MeshFile packed = read_mesh(folder / "b.ply.gz");
    CHECK(are_same(read_fields(*packed.source, quality).values, fields.values));
    fields.values(0, 0) = 9;
    write_mesh_like(*packed.source, folder / "c.ply", packed.mesh, fields);
    CHECK(content_of(folder / "c.ply") == with(scalar_ply, "1.50", "9"));

    fields.values(0, 0) = 0.1;
    write_mesh(folder / "d.ply", file.mesh, {FileFormat::Ply, Encoding::BinaryBigEndian}, fields);
    const MeshFile written = read_mesh(folder / "d.ply");
    CHECK(identical(written.mesh, file.mesh));
    CHECK(are_same(read_fields(*written.source, quality).values, fields.values));
    CHECK(
        complaint_of<OutputError>(folder, [&] { write_mesh(folder / "d.obj", file.mesh, {}, fields); }) ==
        "d.obj: cannot be written: OBJ files made here hold no fields of vertices; write a .ply file, which holds any");
    write_mesh(folder / "d.obj", file.mesh, {}, FileFields{});
    CHECK(identical(read_mesh(folder / "d.obj").mesh, file.mesh));

    write_mesh(folder / "a.stl", file.mesh, {FileFormat::Stl, Encoding::Ascii});
    const MeshFile stl = read_mesh(folder / "a.stl");
    CHECK(complaint_of<InputError>(folder, [&] { read_fields(*stl.source, quality); }) ==
          "a.stl: no numbers of vertices besides positions are read from STL files; convert the mesh and its data to "
          "PLY");
    CHECK(
        complaint_of<OutputError>(folder, [&] { write_mesh_like(*stl.source, folder / "b.stl", stl.mesh, fields); }) ==
        "b.stl: cannot be written: STL files made here hold no fields of vertices; write a .ply file, which holds any");
}
