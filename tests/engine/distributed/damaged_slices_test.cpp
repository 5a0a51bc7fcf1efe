// Files of every format, damaged at random, of which every rank reads and writes a slice.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <doctest/doctest.h>

#include "samples/meshes/random_numbers.h"
#include "tests/engine/distributed/shared_files.h"
#include "tests/support/flows.h"

using namespace seamflow;

namespace {

struct Form {
    const char* name;
    FileKind kind;
};
constexpr std::array forms{Form{"in.obj", {FileFormat::Obj, Encoding::Ascii}},
                           Form{"in.off", {FileFormat::Off, Encoding::Ascii}},
                           Form{"in.ply", {FileFormat::Ply, Encoding::Ascii}},
                           Form{"in.ply", {FileFormat::Ply, Encoding::BinaryLittleEndian}},
                           Form{"in.ply", {FileFormat::Ply, Encoding::BinaryBigEndian}},
                           Form{"in.stl", {FileFormat::Stl, Encoding::Ascii}},
                           Form{"in.stl", {FileFormat::Stl, Encoding::BinaryLittleEndian}}};

/// Exchanges some characters, takes some out, has some twice, or cuts the file off.
std::string damaged(std::string content, RandomNumbers& random)
{
    constexpr std::string_view characters = "0123456789 \n\n\r-+.#vfx\\\xff";
    const auto place = [&] { return static_cast<std::size_t>(random.below(static_cast<int>(content.size()))); };
    const auto length = [&] { return static_cast<std::size_t>(1 + random.below(40)); };
    for (int n = 1 + random.below(3); n > 0; --n) {
        // One after the other, so that all compilers do the same damage.
        const int kind = random.below(6);
        const std::size_t begin = place();
        if (kind == 0) {
            content.erase(begin, length());
        } else if (kind == 1) {
            const std::size_t from = place();
            content.insert(begin, content.substr(from, length()));
        } else if (kind == 2) {
            content.resize(content.size() - content.size() / 8 + begin / 8);
        } else {
            content[begin] = characters[static_cast<std::size_t>(random.below(static_cast<int>(characters.size())))];
        }
    }
    return content;
}

}  // namespace

TEST_CASE("damaged files in slices are read, or refused, as on one machine")
{
    const test::TemporaryDirectory directory;
    int n_faulty = 0;
    int n_faultless = 0;
    for (const Form& form : forms) {
        const auto file = directory / form.name;
        write_mesh(file, make_triangles(100), form.kind);
        const std::string good = test::content_of(file);
        CAPTURE(form.name);
        for (std::uint32_t seed = 1; seed <= 60; ++seed) {
            CAPTURE(seed);
            RandomNumbers random(seed);
            (test::check_content_as_on_one_machine(file, damaged(good, random)) ? n_faulty : n_faultless) += 1;
        }
    }
    CHECK(n_faulty > 100);
    CHECK(n_faultless > 50);
}

TEST_CASE("files without faces in slices are as on one machine")
{
    const test::TemporaryDirectory directory;
    PolygonMesh mesh = make_triangles(100);
    mesh.face_offsets = {0};
    mesh.face_vertices = {};
    for (const Form& form : forms) {
        if (form.kind.format == FileFormat::Stl)
            continue;
        CAPTURE(form.name);
        const auto file = directory / form.name;
        write_mesh(file, mesh, form.kind);
        CHECK(!test::check_content_as_on_one_machine(file, test::content_of(file)));
    }
}
