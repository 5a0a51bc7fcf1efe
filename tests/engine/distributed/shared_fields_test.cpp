// Fields of files that ranks read and write together, beside the same on one machine.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <doctest/doctest.h>

#include "engine/distributed/files/open_together.h"
#include "engine/distributed/ranks/thread_transport.h"
#include "partition/errors.h"
#include "samples/meshes/meshes.h"
#include "tests/engine/distributed/shared_files.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// A file with normals and fields of several types, some of them without data.
std::string ply_of_many_types(const PolygonMesh& mesh)
{
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.n_vertices()) +
                        "\nproperty uchar red\nproperty double x\nproperty double y\nproperty double z\n"
                        "property float nx\nproperty float ny\nproperty float nz\nproperty float quality\n"
                        "property int id\nelement face " +
                        std::to_string(mesh.n_faces()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        test::append(bytes, static_cast<std::uint8_t>(v * 31));
        for (int c = 0; c < 3; ++c)
            test::append(bytes, mesh.vertices(v, c));
        for (const float of_normal : {0.0F, 0.5F, -0.8F})
            test::append(bytes, of_normal);
        test::append(bytes, v % 50 == 7 ? std::numeric_limits<float>::quiet_NaN() : 0.1F * static_cast<float>(v % 10));
        test::append(bytes, std::int32_t{v});
    }
    for (Index f = 0; f < mesh.n_faces(); ++f) {
        test::append(bytes, std::uint8_t{3});
        for (const Index v : mesh.face(f))
            test::append(bytes, std::int32_t{v});
    }
    return bytes;
}

/// How fields change between reading and writing.
using ChangeOfField = void (*)(const std::vector<std::string>& names, std::int64_t v,
                               Eigen::Ref<Eigen::RowVectorXd> row);

struct PassedFields {
    std::string written;
    std::vector<std::string> remarks;
    std::string fault;
    /// What ranks report as written differs from this.
    bool is_misreported = false;
};

PassedFields pass_fields(const std::filesystem::path& file, const std::filesystem::path& result, int n,
                         const FileSharing& sharing, const std::vector<std::string>& names, ChangeOfField change)
{
    PassedFields passed;
    std::mutex mutex;
    run_on_threads(n, [&](Transport& transport) {
        std::string fault;
        try {
            run_together(transport, [&](Communicator& comm) {
                const auto opened = open_together(comm, file, sharing);
                const RankSlice slice = opened->read(comm);
                const std::int64_t first = gather_bounds(comm, slice).vertices[at(comm.rank())];
                FileFields fields = opened->read_fields(comm, names);
                REQUIRE(fields.values.rows() == slice.vertices.rows());
                for (Index v = 0; v < fields.values.rows(); ++v) {
                    Eigen::RowVectorXd row = fields.values.row(v);
                    change(fields.names, first + v, row);
                    fields.values.row(v) = row;
                }
                auto remarks = opened->write_fields(comm, result, fields);
                comm.at_first_rank([&] { passed.remarks = std::move(remarks); });
                const Eigen::MatrixXd written =
                    read_fields(*read_mesh(result).source, names).values.middleRows(first, fields.values.rows());
                const std::scoped_lock lock(mutex);
                for (Eigen::Index i = 0; i < written.size(); ++i)
                    if (written.reshaped()[i] != fields.values.reshaped()[i])
                        passed.is_misreported = passed.is_misreported || !std::isnan(written.reshaped()[i]);
            });
        } catch (const std::exception& error) {
            fault = error.what();
        }
        const std::scoped_lock lock(mutex);
        passed.fault = fault;
    });
    if (passed.fault.empty())
        passed.written = test::content_of(result);
    return passed;
}

PassedFields pass_fields_alone(const std::filesystem::path& file, const std::filesystem::path& result,
                               const std::vector<std::string>& names, ChangeOfField change)
{
    PassedFields passed;
    try {
        const MeshFile read = read_mesh(file);
        FileFields fields = read_fields(*read.source, names);
        for (Index v = 0; v < fields.values.rows(); ++v) {
            Eigen::RowVectorXd row = fields.values.row(v);
            change(fields.names, v, row);
            fields.values.row(v) = row;
        }
        passed.remarks = write_mesh_like(*read.source, result, read.mesh, fields);
        passed.written = test::content_of(result);
    } catch (const std::exception& error) {
        passed.fault = error.what();
    }
    return passed;
}

void check_fields_of_file(const std::vector<std::string>& names, ChangeOfField change, std::size_t n_remarks)
{
    const test::TemporaryDirectory directory;
    const auto file = directory.with("in.ply", ply_of_many_types(make_triangles(700)));
    const auto result = directory / "out.ply";
    const PassedFields expected = pass_fields_alone(file, result, names, change);
    CHECK(expected.remarks.size() == n_remarks);
    for (const int n : {1, 2, 3, 5})
        for (const FileSharing& sharing : {FileSharing{.block = 64}, test::sliced}) {
            CAPTURE(n);
            CAPTURE(sharing.whole_up_to);
            const PassedFields passed = pass_fields(file, result, n, sharing, names, change);
            CHECK((passed.written == expected.written));
            CHECK(passed.remarks == expected.remarks);
            CHECK(passed.fault == expected.fault);
            CHECK_FALSE(passed.is_misreported);
        }
}

}  // namespace

TEST_CASE("ranks write fields in the types of the file, which all decide together")
{
    const auto nothing = [](const std::vector<std::string>&, std::int64_t, Eigen::Ref<Eigen::RowVectorXd>) {};
    check_fields_of_file({"quality", "red", "normal"}, nothing, 0);
    // Rounded once; the ends of a range; what single precision cannot hold.
    check_fields_of_file(
        {"id", "quality", "red"},
        [](const std::vector<std::string>&, std::int64_t v, Eigen::Ref<Eigen::RowVectorXd> row) {
            row *= 1.01;
            if (v == 690)
                row << -7.5, 1e300, 300.0;
        },
        2);
    // A vertex without data, of floats and of whole numbers.
    check_fields_of_file(
        {"quality"},
        [](const std::vector<std::string>&, std::int64_t v, Eigen::Ref<Eigen::RowVectorXd> row) {
            if (v % 3 == 0)
                row[0] = no_number;
        },
        0);
    check_fields_of_file(
        {"quality"},
        [](const std::vector<std::string>&, std::int64_t, Eigen::Ref<Eigen::RowVectorXd> row) { row[0] = no_number; },
        0);
}

TEST_CASE("fields that ranks cannot read or write are refused as by one machine")
{
    const auto nothing = [](const std::vector<std::string>&, std::int64_t, Eigen::Ref<Eigen::RowVectorXd>) {};
    const auto lose_a_number = [](const std::vector<std::string>&, std::int64_t v, Eigen::Ref<Eigen::RowVectorXd> row) {
        row[0] = v == 5 ? no_number : row[0];
    };
    for (const std::vector<std::string>& names : std::vector<std::vector<std::string>>{{"heat"}, {"red", "x"}})
        check_fields_of_file(names, nothing, 0);
    check_fields_of_file({"id"}, lose_a_number, 0);
    const test::TemporaryDirectory directory;
    const auto file = directory.with("in.ply", ply_of_many_types(make_triangles(300)));
    for (const std::string name : {"in.obj", "in.stl", "in.off"}) {
        write_mesh(directory / name, read_mesh(file).mesh, {*format_of(name)});
        const PassedFields passed =
            pass_fields(directory / name, directory / "out.ply", 2, test::sliced, {"red"}, nothing);
        CHECK(passed.fault.find(name + ": ranks read and write slices of fields only in binary PLY files") !=
              std::string::npos);
    }
}
