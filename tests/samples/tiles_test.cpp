// Several files whose borders coincide, smoothed as one surface.

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "partition/formats/mesh_io.h"
#include "partition/index_lists.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/vector_area.h"
#include "tests/samples/running_program.h"
#include "tests/samples/workshop.h"

using namespace seamflow;
using test::RunningProgram;
using test::Workshop;

namespace {

/// The faces of one label as a mesh of their own, and the number of each of its vertices in the whole mesh.
struct CutTile {
    PolygonMesh mesh;
    std::vector<Index> vertices;
};

CutTile tile_of(const PolygonMesh& whole, const std::vector<Index>& labels, Index label)
{
    CutTile tile;
    for (Index f = 0; f < whole.n_faces(); ++f)
        if (labels[f] == label)
            tile.vertices.insert(tile.vertices.end(), whole.face(f).begin(), whole.face(f).end());
    sort_unique(tile.vertices);
    tile.mesh.vertices.resize(std::ssize(tile.vertices), 3);
    for (std::size_t i = 0; i < tile.vertices.size(); ++i)
        tile.mesh.vertices.row(static_cast<Eigen::Index>(i)) = whole.vertices.row(tile.vertices[i]);
    for (Index f = 0; f < whole.n_faces(); ++f) {
        std::vector<Index> corners;
        for (const Index v : whole.face(f))
            corners.push_back(find_in(tile.vertices, v));
        if (labels[f] == label)
            tile.mesh.add_face(corners);
    }
    return tile;
}

/// A mesh that a program has made, cut into files.
class TiledWorkshop : public Workshop {
  public:
    /// @param label_of the label of a face with this centroid in the unit cube around the mesh.
    template <class LabelOf>
    TiledWorkshop(const std::string& kind, int n_vertices, LabelOf&& label_of, FileKind as = binary_ply)
    {
        REQUIRE(run(GENERATE " " + kind + " whole.ply --vertices " + std::to_string(n_vertices)) == 0);
        whole_ = read_mesh(directory / "whole.ply").mesh;
        const Point low = whole_.vertices.colwise().minCoeff();
        const Point size = whole_.vertices.colwise().maxCoeff() - low;
        std::vector<Index> labels;
        Index n_labels = 0;
        for (Index f = 0; f < whole_.n_faces(); ++f) {
            Point centroid = Point::Zero();
            for (const Index v : whole_.face(f))
                centroid += whole_.vertices.row(v);
            centroid = (centroid / static_cast<double>(whole_.face(f).size()) - low).array() / size.array();
            labels.push_back(label_of(centroid));
            n_labels = std::max(n_labels, labels.back() + 1);
        }
        for (Index label = 0; label < n_labels; ++label) {
            tiles_.push_back(tile_of(whole_, labels, label));
            names_.push_back("tile" + std::to_string(label) + extension_of(as.format));
            write_mesh(directory / names_.back(), tiles_.back().mesh, as);
            inputs_ += names_.back() + " ";
        }
    }

    static constexpr FileKind binary_ply{FileFormat::Ply, Encoding::BinaryLittleEndian};

    [[nodiscard]] const std::string& inputs() const { return inputs_; }
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    [[nodiscard]] const std::vector<CutTile>& tiles() const { return tiles_; }

    [[nodiscard]] std::string content(const std::string& folder, std::size_t i) const
    {
        return test::content_of(directory / (folder + "/" + names_[i]));
    }

    /// Whether all results in two folders have the same bytes.
    [[nodiscard]] bool are_same(const std::string& folder, const std::string& other) const
    {
        for (std::size_t i = 0; i < names_.size(); ++i)
            if (content(folder, i) != content(other, i))
                return false;
        return true;
    }

    /// The largest distance of the vertices in a folder from those of a whole mesh, in mean edge lengths. Checks that
    /// vertices of several files are equal bit for bit.
    [[nodiscard]] double distance(const std::string& folder, const std::string& whole) const
    {
        const Points expected = read_mesh(directory / whole).mesh.vertices;
        double most = 0.0;
        int n_unequal = 0;
        std::map<Index, std::array<std::uint64_t, 3>> bits;
        for (std::size_t i = 0; i < tiles_.size(); ++i) {
            const Points result = read_mesh(directory / (folder + "/" + names_[i])).mesh.vertices;
            REQUIRE(result.rows() == std::ssize(tiles_[i].vertices));
            for (Eigen::Index v = 0; v < result.rows(); ++v) {
                const Index in_whole = tiles_[i].vertices[static_cast<std::size_t>(v)];
                most = std::max(most, (result.row(v) - expected.row(in_whole)).norm());
                std::array<std::uint64_t, 3> now{};
                for (int c = 0; c < 3; ++c)
                    now[static_cast<std::size_t>(c)] = std::bit_cast<std::uint64_t>(result(v, c));
                n_unequal += bits.try_emplace(in_whole, now).first->second == now ? 0 : 1;
            }
        }
        CHECK(n_unequal == 0);
        return most / mean_edge_length(whole_);
    }

  private:
    PolygonMesh whole_;
    std::vector<CutTile> tiles_;
    std::vector<std::string> names_;
    std::string inputs_;
};

Index part_of_unit(double x, int n)
{
    return std::clamp(static_cast<Index>(x * n), 0, n - 1);
}

Index quarter(const Point& p)
{
    return 2 * part_of_unit(p[0], 2) + part_of_unit(p[1], 2);
}

Index strip(const Point& p)
{
    return part_of_unit(p[0], 3);
}

/// A strip that is narrower than the bands.
Index narrow_strip(const Point& p)
{
    return p[0] < 0.5 ? 0 : p[0] < 0.52 ? 1 : 2;
}

/// Blocks of four labels in disorder: labels in many pieces, which also touch themselves in single vertices.
Index block(const Point& p)
{
    const auto number = [](double x) { return static_cast<std::uint32_t>(part_of_unit(x, 12)); };
    std::uint32_t hash = number(p[0]) * 73856093U ^ number(p[1]) * 19349663U ^ number(p[2]) * 83492791U;
    hash = (hash ^ hash >> 13U) * 2654435761U;
    return static_cast<Index>(hash >> 30U);
}

/// Three sheets around a line, like a Y, rough and one mesh; the file of each face by its sheet and its half of the
/// line.
PolygonMesh sheets_around_line(int n, const std::function<Index(int, bool)>& file_of, std::vector<Index>& files)
{
    PolygonMesh mesh;
    mesh.vertices.resize(3 * n * (n + 1) + n + 1, 3);
    const auto number = [&](int sheet, int i, int j) { return i == 0 ? j : n + 1 + (sheet * n + i - 1) * (n + 1) + j; };
    for (int sheet = 0; sheet < 3; ++sheet)
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= n; ++j) {
                const Index v = number(sheet, i, j);
                const double angle = 2.1 * sheet;
                mesh.vertices.row(v) << i * std::cos(angle) + 0.2 * std::sin(37.0 * v),
                    i * std::sin(angle) + 0.2 * std::sin(59.0 * v), j + 0.2 * std::sin(83.0 * v);
            }
    for (int sheet = 0; sheet < 3; ++sheet)
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                mesh.add_face(std::vector<Index>{number(sheet, i, j), number(sheet, i + 1, j),
                                                 number(sheet, i + 1, j + 1), number(sheet, i, j + 1)});
                files.push_back(file_of(sheet, 2 * j >= n));
            }
    return mesh;
}

constexpr double most_edges = 1e-5;
const std::string exact = " --approach undecomposed";

}  // namespace

TEST_CASE("files whose borders coincide become what the whole mesh becomes, with equal borders")
{
    struct Case {
        const char* kind;
        Index (*label_of)(const Point&);
    };
    for (const Case& one : {Case{"triangles", quarter}, Case{"mixed", strip}, Case{"quads", narrow_strip},
                            Case{"noisy-sphere", block}, Case{"triangles", block}})
        for (const std::string flow :
             {" --time-step-edges 3 --steps 3", " --time-step-edges 0.3 --steps 2 --laplacian virtual-refinement",
              " --time-step-edges 2 --laplacian uniform --order 2 --steps 2",
              " --radius 1% --boundary free --steps 2"}) {
            CAPTURE(one.kind);
            CAPTURE(flow);
            const TiledWorkshop w(one.kind, 4000, one.label_of);
            REQUIRE(w.smooth("whole.ply expected.ply" + flow + exact) == 0);
            REQUIRE(w.smooth(w.inputs() + "--out-dir out" + flow + exact) == 0);
            CHECK(w.distance("out", "expected.ply") < most_edges);
            CHECK_FALSE(w.has("out/.seamflow-tiles"));
        }
}

TEST_CASE("neither the order of the files nor the number of threads matters, nor does one file differ from a mesh")
{
    const TiledWorkshop w("triangles", 6000, quarter);
    const std::string flow = " --time-step-edges 4 --steps 2";
    REQUIRE(w.smooth(w.inputs() + "--out-dir out --threads 2" + flow) == 0);
    REQUIRE(w.smooth("--out-dir=other --threads 1" + flow + " ./tile3.ply tile0.ply tile2.ply tile1.ply") == 0);
    CHECK(w.are_same("out", "other"));
    REQUIRE(w.smooth("tile0.ply --out-dir one" + flow + exact) == 0);
    REQUIRE(w.smooth("tile0.ply alone.ply" + flow + exact) == 0);
    // Further steps are flows of their own, which begin with another rounding.
    const Points one = read_mesh(w.directory / "one/tile0.ply").mesh.vertices;
    const Points alone = read_mesh(w.directory / "alone.ply").mesh.vertices;
    CHECK((one - alone).cwiseAbs().maxCoeff() < 1e-12);
    CHECK((one - w.tiles()[0].mesh.vertices).cwiseAbs().maxCoeff() > 1e-4);
}

TEST_CASE("without --approach and --converge, steps are converged until borders do not show")
{
    const TiledWorkshop w("triangles", 20000, quarter);
    const std::string flow = " --time-step-edges 4 --steps 2";
    REQUIRE(w.smooth("whole.ply expected.ply --converge 1e-10" + flow) == 0);
    REQUIRE(w.smooth(w.inputs() + "--out-dir out" + flow) == 0);
    CHECK(w.distance("out", "expected.ply") < 1e-3);
}

TEST_CASE("files in text and with floats keep all else, and their borders are equal, too")
{
    const TiledWorkshop w("triangles", 2000, quarter, {FileFormat::Obj, Encoding::Ascii});
    for (const std::string& name : w.names())
        static_cast<void>(w.directory.with(name, "# " + name + "\nvn 0 0 1\n" + test::content_of(w.directory / name)));
    const std::string flow = " --time-step-edges 3 --steps 2" + exact;
    REQUIRE(w.smooth("whole.ply expected.ply" + flow) == 0);
    REQUIRE(w.smooth(w.inputs() + "--out-dir out" + flow) == 0);
    CHECK(w.distance("out", "expected.ply") < most_edges);
    CHECK(w.said().find("remark     tile0.obj: normals of vertices on borders") != std::string::npos);
    CHECK(w.content("out", 2).starts_with("# tile2.obj\n"));
    // Another format of one file changes nothing.
    write_mesh(w.directory / "tile1.ply", w.tiles()[1].mesh, TiledWorkshop::binary_ply);
    REQUIRE(w.smooth("tile0.obj tile1.ply tile2.obj tile3.obj --out-dir mixed" + flow) == 0);
    CHECK(w.content("mixed", 0) == w.content("out", 0));
    CHECK(read_mesh(w.directory / "mixed/tile1.ply").mesh.vertices ==
          read_mesh(w.directory / "out/tile1.obj").mesh.vertices);
    // In binary STL, coordinates are floats: the same double becomes the same float.
    const TiledWorkshop floats("triangles", 2000, quarter, {FileFormat::Stl, Encoding::BinaryLittleEndian});
    REQUIRE(floats.smooth(floats.inputs() + "--out-dir out" + flow) == 0);
    std::map<std::array<std::int64_t, 2>, std::array<double, 3>> by_place;
    int n_shared = 0;
    for (const std::string& name : floats.names()) {
        const Points before = read_mesh(floats.directory / name).mesh.vertices;
        const Points after = read_mesh(floats.directory / ("out/" + name)).mesh.vertices;
        REQUIRE(before.rows() == after.rows());
        for (Eigen::Index v = 0; v < before.rows(); ++v) {
            const std::array<std::int64_t, 2> place{std::llround(1e4 * before(v, 0)), std::llround(1e4 * before(v, 1))};
            const std::array<double, 3> now{after(v, 0), after(v, 1), after(v, 2)};
            const auto [first, is_new] = by_place.try_emplace(place, now);
            n_shared += is_new ? 0 : 1;
            CHECK(first->second == now);
        }
    }
    CHECK(n_shared > 80);
}

TEST_CASE("borders with a gap are joined by --weld, and a remark says where none coincide")
{
    const TiledWorkshop w("triangles", 2000, strip);
    PolygonMesh moved = w.tiles()[1].mesh;
    moved.vertices.col(2).array() += 1e-4;
    write_mesh(w.directory / "tile1.ply", moved, TiledWorkshop::binary_ply);
    const std::string flow = "--out-dir out --time-step-edges 3 --steps 2" + exact;
    REQUIRE(w.smooth(w.inputs() + flow) == 0);
    CHECK(w.said().find("No borders of two files coincide") != std::string::npos);
    CHECK(w.said().find("\ntiles      ") != std::string::npos);
    CHECK(w.said().find("; 0 of ") != std::string::npos);
    REQUIRE(w.smooth("whole.ply expected.ply --time-step-edges 3 --steps 2" + exact) == 0);
    REQUIRE(w.smooth(w.inputs() + flow + " --weld 2e-4") == 0);
    CHECK(w.said().find("No borders") == std::string::npos);
    CHECK(w.distance("out", "expected.ply") < 0.02);
}

TEST_CASE("borders that do not overlap are joined by --weld, at the place of the first file")
{
    constexpr int n = 40;
    constexpr double gap = 0.05;
    PolygonMesh whole;
    whole.vertices.resize((n + 1) * (n + 1), 3);
    const auto number = [&](int i, int j) { return i * (n + 1) + j; };
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            whole.vertices.row(number(i, j)) << i + (2 * i > n ? gap : 0.0), j, 0.3 * std::sin(37.0 * number(i, j));
    std::vector<Index> files;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            whole.add_face(std::vector<Index>{number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)});
            files.push_back(2 * i < n ? 0 : 1);
        }
    const Workshop w;
    write_mesh(w.directory / "whole.ply", whole, TiledWorkshop::binary_ply);
    write_mesh(w.directory / "tile0.ply", tile_of(whole, files, 0).mesh, TiledWorkshop::binary_ply);
    CutTile second = tile_of(whole, files, 1);
    second.mesh.vertices.topRows(n + 1).col(0).array() += gap;
    write_mesh(w.directory / "tile1.ply", second.mesh, TiledWorkshop::binary_ply);
    const std::string flow = " --time-step 1.5 --steps 2" + exact;
    REQUIRE(w.smooth("whole.ply expected.ply" + flow) == 0);
    REQUIRE(w.smooth("tile0.ply tile1.ply --out-dir out --weld 0.08" + flow) == 0);
    const Points expected = read_mesh(w.directory / "expected.ply").mesh.vertices;
    for (const Index file : {0, 1}) {
        const Points after = read_mesh(w.directory / ("out/tile" + std::to_string(file) + ".ply")).mesh.vertices;
        CHECK((after - expected(tile_of(whole, files, file).vertices, Eigen::all)).cwiseAbs().maxCoeff() < most_edges);
    }
}

TEST_CASE("lengths in percent and filters of several files are those of the whole mesh")
{
    // So that the diagonal is not 1.
    const TiledWorkshop w("noisy-sphere", 4000, quarter);
    for (const std::string flow :
         {" --time-step-edges 3 --attach 2%", " --time-step-edges 3 --within 0.2%",
          " --time-step-edges 3 --within 0.2%,1%,0.05%", " --time-step-edges 0.3 --filter low-pass --order 8"}) {
        CAPTURE(flow);
        REQUIRE(w.smooth("whole.ply expected.ply" + flow + exact) == 0);
        REQUIRE(w.smooth(w.inputs() + "--out-dir out" + flow + exact) == 0);
        CHECK(w.distance("out", "expected.ply") < most_edges);
    }
}

TEST_CASE(
    "what is said of several files is in mean edge lengths, too, and counts steps and files that miss the tolerance")
{
    const TiledWorkshop w("triangles", 2000, quarter);
    const auto moved = [&](const std::string& inputs) {
        REQUIRE(w.smooth(inputs + "--out-dir out --time-step-edges 3" + exact) == 0);
        const std::string said = w.said();
        const auto begin = said.find("\nresult     4 files in out: moved ");
        REQUIRE(begin != std::string::npos);
        // Those in parentheses; before them they are in the unit of the files.
        std::string in_edges;
        for (auto at = said.find('(', begin); at != std::string::npos; at = said.find('(', at + 1))
            in_edges += said.substr(at, said.find(')', at) + 1 - at);
        return in_edges;
    };
    const std::string of_tiles = moved(w.inputs());
    CHECK(of_tiles.find(" mean edge lengths)(") != std::string::npos);
    for (std::size_t i = 0; i < 4; ++i) {
        PolygonMesh large = w.tiles()[i].mesh;
        large.vertices *= 1024.0;
        write_mesh(w.directory / w.names()[i], large, TiledWorkshop::binary_ply);
    }
    CHECK(moved(w.inputs()) == of_tiles);
    CHECK(w.smooth(w.inputs() + "--out-dir out --time-step-edges 3 --steps 2 --subdomains 4 --converge 1e-40") == 4);
    CHECK(w.said().find("smooth: the tolerance 1e-40 was missed in 8 steps of 4 files; out has the last state\n") !=
          std::string::npos);
}

TEST_CASE("sheets that meet at a border of files and cannot be joined stay together")
{
    for (const std::function<Index(int, bool)>&file_of :
         {std::function<Index(int, bool)>([](int sheet, bool) { return sheet; }),
          std::function<Index(int, bool)>([](int sheet, bool) { return sheet / 2; }),
          std::function<Index(int, bool)>([](int, bool is_second) { return is_second ? 1 : 0; })})
        for (const std::string flow : {" --boundary free", ""}) {
            const Workshop w;
            std::vector<Index> files;
            const PolygonMesh whole = sheets_around_line(10, file_of, files);
            std::string words;
            std::map<Index, Point> places;
            const Index n_files = 1 + *std::ranges::max_element(files);
            for (Index file = 0; file < n_files; ++file) {
                words += "sheet" + std::to_string(file) + ".ply ";
                write_mesh(w.directory / ("sheet" + std::to_string(file) + ".ply"), tile_of(whole, files, file).mesh,
                           {FileFormat::Ply, Encoding::BinaryLittleEndian});
            }
            REQUIRE(w.smooth(words + "--out-dir out --time-step-edges 1 --steps 2" + flow + exact) == 0);
            CAPTURE(w.said());
            CHECK(w.said().find("where borders of files meet but cannot be joined") != std::string::npos);
            CHECK(w.said().find("No borders of two files coincide") == std::string::npos);
            double most = 0.0;
            for (Index file = 0; file < n_files; ++file) {
                const CutTile tile = tile_of(whole, files, file);
                const Points after =
                    read_mesh(w.directory / ("out/sheet" + std::to_string(file) + ".ply")).mesh.vertices;
                for (std::size_t i = 0; i < tile.vertices.size(); ++i) {
                    const Point now = after.row(static_cast<Eigen::Index>(i));
                    CHECK(places.try_emplace(tile.vertices[i], now).first->second == now);
                    most = std::max(most, (now - whole.vertices.row(tile.vertices[i])).norm());
                }
            }
            CHECK(most > 0.05);
        }
}

TEST_CASE("a run over files that was killed goes on to the same bytes, also in the last step")
{
    const TiledWorkshop w("triangles", 12000, quarter);
    const std::string arguments = w.inputs() + "--time-step-edges 4 --steps 3 --verbose --out-dir ";
    REQUIRE(w.smooth(arguments + "expected") == 0);
    struct Words {
        std::string last;
        std::string not_repeated;
    };
    for (const Words& words : {Words{"\nstep 1 of 3  tile1.ply", "step 1 of 3  tile0.ply"},
                               Words{"\nstep 2 of 3  tile2.ply", "step 2 of 3  tile0.ply"},
                               Words{"\nstep 3 of 3  tile1.ply", "step 3 of 3  tile0.ply"}}) {
        CAPTURE(words.last);
        std::filesystem::remove_all(w.directory / "out");
        {
            RunningProgram program(w.directory.path(), SMOOTH, arguments + "out");
            while (program.runs() && w.said().find(words.last) == std::string::npos)
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            program.send(SIGKILL);
            program.wait();
        }
        REQUIRE(w.has("out/.seamflow-tiles/run"));
        const bool has_result = w.has("out/.seamflow-tiles/tile-0.step-3");
        CHECK(has_result == words.last.starts_with("\nstep 3"));
        // Written again.
        std::filesystem::remove(w.directory / "out/tile0.ply");
        REQUIRE(w.smooth(arguments + "out") == 0);
        CHECK(w.said().find("\nresult     4 files in out") != std::string::npos);
        CHECK(w.said().find("resumed    after step ") != std::string::npos);
        CHECK(w.said().find(words.not_repeated) == std::string::npos);
        CHECK(w.are_same("out", "expected"));
        CHECK_FALSE(w.has("out/.seamflow-tiles"));
    }
}

TEST_CASE("a signal ends a run over files with 130; other options and changed files do not continue it")
{
    const TiledWorkshop w("triangles", 12000, quarter);
    const std::string arguments = w.inputs() + "--time-step-edges 4 --steps 200 --verbose --out-dir out";
    RunningProgram program(w.directory.path(), SMOOTH, arguments);
    while (program.runs() && w.said().find("\nstep 2 of 200  tile0.ply") == std::string::npos)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    // What follows # is a comment.
    CHECK(w.run(SMOOTH " tile0.ply --time-step 1 --out-dir out >second 2>&1 #") == 5);
    CHECK(test::content_of(w.directory / "second").find("another run works in this folder") != std::string::npos);
    program.send(SIGINT);
    CHECK(program.wait() == 130);
    CHECK(w.said().find(" of 200; the same command continues there") != std::string::npos);
    CHECK_FALSE(w.has("out/tile0.ply"));
    const auto refused = [&](const std::string& words, int status, const std::string& reason) {
        CAPTURE(words);
        CHECK(w.smooth(words) == status);
        CAPTURE(w.said());
        CHECK(w.said().find("out/.seamflow-tiles/run: ") != std::string::npos);
        CHECK(w.said().find(reason) != std::string::npos);
        CHECK(w.said().find("remove it to start over") != std::string::npos);
    };
    const std::string another = "belongs to another input or to other options";
    refused(arguments + " --laplacian uniform", 3, another);
    refused(w.inputs() + "--time-step-edges 4 --steps 201 --out-dir out", 3, another);
    refused("tile0.ply tile1.ply --time-step 1e-4 --steps 200 --out-dir out", 3, another);
    PolygonMesh changed = w.tiles()[3].mesh;
    changed.vertices(100, 2) += 1e-3;
    write_mesh(w.directory / "tile3.ply", changed, TiledWorkshop::binary_ply);
    refused(w.inputs() + "--time-step 1e-4 --steps 200 --out-dir out", 3, another);
    std::filesystem::remove_all(w.directory / "out/.seamflow-tiles");
    CHECK(w.smooth(w.inputs() + "--time-step-edges 4 --out-dir out") == 0);
}

TEST_CASE("memory does not grow with the number of files")
{
    const auto megabytes = [](int n_a_side) {
        const TiledWorkshop w("triangles", 15000 * n_a_side * n_a_side, [&](const Point& p) {
            return n_a_side * part_of_unit(p[0], n_a_side) + part_of_unit(p[1], n_a_side);
        });
        REQUIRE(w.smooth(w.inputs() + "--out-dir out --time-step-edges 1 --approach cg") == 0);
        const std::string said = w.said();
        std::smatch found;
        REQUIRE(std::regex_search(said, found, std::regex(", ([0-9.]+) MB\n")));
        return std::stod(found[1].str());
    };
    CHECK(megabytes(5) < 1.15 * megabytes(3));
}

TEST_CASE("--out-dir refuses what it cannot do, with the reason")
{
    const TiledWorkshop w("triangles", 2000, quarter);
    const auto refused = [&](const std::string& words, const std::string& reason, int status = 2) {
        CAPTURE(words);
        CHECK(w.smooth(words) == status);
        CAPTURE(w.said());
        CHECK(w.said().find(reason) != std::string::npos);
        CHECK_FALSE(w.has("out/tile0.ply"));
    };
    const std::string all = w.inputs() + "--out-dir out --time-step-edges 2 ";
    refused(w.inputs() + "--out-dir out", "needs an amount");
    refused(w.inputs() + "--out-dir out --preset fair", "cannot be combined with --preset: ");
    refused(w.inputs() + "--out-dir out --noise 1%", "cannot be combined with --noise: ");
    for (const std::string option :
         {"--rescale area",         "--reference",        "--keep-edges 30",      "--html page.html",
          "--checkpoint kept",      "--fix f.txt",        "--labels l.txt",       "--report report.json",
          "--every-step at-%d.ply", "--strict",           "--self-intersections", "--parts parts.ply",
          "--trace t.json",         "--task-graph t.dot", "--csv s.csv",          "--attach-weights w.txt",
          "--region r.txt",         "--feather 2%",       "--edges e.txt",        "--edges-from-file"})
        refused(all + option, "cannot be combined with " + option.substr(0, option.find(' ')) + ": ");
    refused(all + "--steps 0", "takes at least one step");
    refused(all + "--steps 2 --attach 2%", "--out-dir supports --attach with one step only");
    refused(all + "--steps 2 --within 0.1", "--out-dir supports --within with one step only");
    refused(all + "--steps 2 --flow linear", "--out-dir supports --flow with one step only");
    refused(w.inputs() + "--out-dir out --time-step-edges 1e5 --scheme explicit", "for explicit Euler steps");
    CHECK_FALSE(w.has("out/.seamflow-tiles"));
    refused("tile0.ply ./tile0.ply --out-dir out --time-step 1", "have the same name");
    refused("tile0.ply --out-dir . --time-step 1", "would be replaced");
    refused("tile0.ply - --out-dir out --time-step 1", "can be read only once");
    refused("tile0.ply tile9.ply --out-dir out --time-step 1", "tile9.ply: ", 3);
    refused("tile0.ply --out-dir tile1.ply --time-step 1", "tile1.ply: cannot create this folder", 5);
    refused("--out-dir out --time-step 1", "INPUT is required");
    refused("tile0.ply out.ply tile1.ply --time-step 1", "'tile1.ply' is one argument too many");
}
