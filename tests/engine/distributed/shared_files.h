#pragma once

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/distributed/files/open_together.h"
#include "engine/distributed/files/shared_mesh_file.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "engine/distributed/ranks/thread_transport.h"
#include "partition/formats/off.h"
#include "partition/formats/off_header.h"
#include "partition/formats/ply_source.h"
#include "partition/io/slices.h"
#include "partition/vector_area.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_directory.h"

/// Files that ranks read and write together, beside the same on one machine.
namespace seamflow::test {

inline constexpr FileSharing sliced{.whole_up_to = 0, .block = 64};

/// What ranks have read and written.
struct Shared {
    PolygonMesh mesh;
    /// Of one rank.
    Index least_faces = 0;
    FaultLog faults;
    std::string written;
    /// A file with labels.
    std::string labelled;
    std::vector<std::string> remarks;
    /// Of all of them; empty: there was none.
    std::string fault;
};

/// Moves all three coordinates of every vertex; however large they are, they stay finite.
inline void lift(Points& points)
{
    for (Index v = 0; v < points.rows(); ++v) {
        const Point p = points.row(v);
        points.row(v) += Point(0.07 * std::sin(p.y() + 1.0), 0.05 * std::sin(p.z() + 2.0), 0.1 * std::sin(p.x() + 3.0));
    }
}

/// Reads a file, moves the vertices and writes it as `result`, and beside it as labelled.ply.
inline Shared pass_through(const std::filesystem::path& file, const std::filesystem::path& result, int n,
                           const FileSharing& sharing)
{
    Shared shared;
    std::mutex mutex;
    std::vector<std::string> faults;
    const auto pass = [&](Communicator& comm) {
        const auto opened = open_together(comm, file, sharing);
        RankSlice slice = opened->read(comm);
        PolygonMesh mesh = gather_mesh(comm, slice);
        lift(slice.vertices);
        auto remarks = opened->write(comm, result, slice.vertices);
        std::vector<Index> labels(at(slice.n_faces()));
        for (Index f = 0; f < slice.n_faces(); ++f)
            labels[f] = static_cast<Index>(slice.corners[slice.face_offsets[f]] % 7);
        opened->write_labelled(comm, result.parent_path() / "labelled.ply", slice.vertices, labels);
        const auto n_faces = comm.gather_all(std::vector<Index>{slice.n_faces()});
        comm.at_first_rank([&] {
            shared.mesh = std::move(mesh);
            shared.least_faces = std::ranges::min(n_faces);
            shared.faults = opened->faults();
            shared.remarks = std::move(remarks);
        });
    };
    run_on_threads(n, [&](Transport& transport) {
        std::string fault;
        try {
            run_together(transport, pass);
        } catch (const std::exception& error) {
            fault = error.what();
        }
        const std::scoped_lock lock(mutex);
        faults.push_back(fault);
    });
    for (const std::string& fault : faults)
        CHECK(fault == faults.front());
    shared.fault = faults.front();
    if (shared.fault.empty()) {
        shared.written = content_of(result);
        shared.labelled = content_of(result.parent_path() / "labelled.ply");
    }
    return shared;
}

/// The same on one machine.
inline Shared pass_through_alone(const std::filesystem::path& file, const std::filesystem::path& result)
{
    Shared alone;
    alone.faults.of_faces_alone = true;
    try {
        MeshFile read = read_faulty_mesh(file, alone.faults);
        alone.mesh = read.mesh;
        lift(read.mesh.vertices);
        const FileKind kind = kind_for_writing(result, read.kind);
        if (kind.format == read.kind.format)
            alone.remarks = write_mesh_like(*read.source, result, read.mesh);
        else
            write_mesh(result, read.mesh, kind);
        std::vector<Index> labels;
        for (Index f = 0; f < read.mesh.n_faces(); ++f)
            labels.push_back(read.mesh.face(f).front() % 7);
        write_labelled_ply(result.parent_path() / "labelled.ply", read.mesh, labels);
        alone.written = content_of(result);
        alone.labelled = content_of(result.parent_path() / "labelled.ply");
    } catch (const std::exception& error) {
        alone.fault = error.what();
    }
    return alone;
}

inline void check_as_on_one_machine(const std::filesystem::path& file, const std::filesystem::path& result,
                                    const FileSharing& sharing, Index least_faces)
{
    const Shared alone = pass_through_alone(file, result);
    REQUIRE(alone.fault.empty());
    for (const int n : {1, 2, 3, 5}) {
        CAPTURE(n);
        const Shared shared = pass_through(file, result, n, sharing);
        REQUIRE(shared.fault == "");
        CHECK(identical(shared.mesh, alone.mesh));
        CHECK((shared.written == alone.written));
        CHECK((shared.labelled == alone.labelled));
        CHECK(shared.remarks == alone.remarks);
        CHECK(shared.least_faces >= least_faces);
        CHECK(shared.faults.count == alone.faults.count);
        CHECK(shared.faults.n_harmless == alone.faults.n_harmless);
        CHECK(shared.faults.messages == alone.faults.messages);
        CHECK(shared.faults.faces_left_out == alone.faults.faces_left_out);
    }
}

inline void write_file(const std::filesystem::path& path, const std::string& content)
{
    std::ofstream(path, std::ios::binary) << content;
}

/// Little-endian.
template <class Value>
void append(std::string& bytes, Value value)
{
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Checks that ranks say of a file in slices, all alike, what is said of it on one machine, and write nothing.
inline void check_fault_as_on_one_machine(const std::filesystem::path& file, const std::string& content)
{
    write_file(file, content);
    const auto result = file.parent_path() / ("out" + file.extension().string());
    const Shared alone = pass_through_alone(file, result);
    CAPTURE(content.size());
    CAPTURE(alone.fault);
    REQUIRE(!alone.fault.empty());
    for (const int n : {1, 2, 3, 5}) {
        CAPTURE(n);
        CHECK(pass_through(file, result, n, sliced).fault == alone.fault);
    }
    CHECK(!std::filesystem::exists(result));
}

/// Whether one machine reads a text file whose lines are no more than blanks, which slices cannot be.
inline bool crosses_lines(const std::filesystem::path& file)
{
    const std::string content = content_of(file);
    try {
        if (file.extension() == ".ply") {
            TextScanner scanner(file, content, ply_syntax);
            const PlyHeader header = read_ply_header(scanner);
            return header.encoding == Encoding::Ascii && breaks_lines_freely(scanner, header);
        }
        if (file.extension() != ".off" || start_of_binary_off(content))
            return false;
        TextScanner scanner(file, content);
        const OffHeader header = read_off_header(scanner);
        const std::string_view rest = scanner.rest();
        return count_lines(scanner, {&rest, 1}, run_serially).back() != header.n_lines();
    } catch (const InputError&) {
        return true;
    }
}

/// Checks that ranks do with a file in slices what one machine does, whether it has a fault or none.
/// @returns whether it has.
inline bool check_content_as_on_one_machine(const std::filesystem::path& file, const std::string& content)
{
    const auto result = file.parent_path() / ("out" + file.extension().string());
    std::filesystem::remove(result);
    write_file(file, content);
    const bool is_faulty = !pass_through_alone(file, result).fault.empty();
    if (is_faulty)
        check_fault_as_on_one_machine(file, content);
    else if (crosses_lines(file))
        CHECK(!pass_through(file, result, 3, sliced).fault.empty());
    else
        check_as_on_one_machine(file, result, sliced, 0);
    std::filesystem::remove(result);
    return is_faulty;
}

/// The same of several contents, of which a few may have no fault.
inline void check_faults_as_on_one_machine(const std::filesystem::path& file, const std::vector<std::string>& contents)
{
    const auto n_faulty = std::ranges::count_if(
        contents, [&](const std::string& content) { return check_content_as_on_one_machine(file, content); });
    CHECK(4 * n_faulty > 3 * std::ssize(contents));
}

}  // namespace seamflow::test
