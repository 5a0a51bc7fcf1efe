#include <string>

#include <doctest/doctest.h>

#include "partition/formats/mesh_io.h"
#include "samples/page/file_colours.h"
#include "samples/page/read_file_colours.h"
#include "samples/page/texture_images.h"
#include "tests/support/temporary_directory.h"

using namespace seamflow;

namespace {

const std::string png = "\x89PNG\r\n\x1a\nis all that is looked at";

/// A file in a folder of its own, and what is read of it.
struct ColouredFile {
    explicit ColouredFile(const std::string& name)
        : path(folder / name)
    {
    }

    void beside(const std::string& name, const std::string& content) const
    {
        static_cast<void>(folder.with(name, content));
    }

    [[nodiscard]] FileColours read(const std::string& content) const
    {
        static_cast<void>(folder.with(path.filename().string(), content));
        FaultLog faults{.of_faces_alone = true};
        const MeshFile file = read_faulty_mesh(path, faults);
        return read_file_colours(path, file, faults.faces_left_out);
    }

    test::TemporaryDirectory folder;
    std::filesystem::path path;
};

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string ply_header = "ply\nformat ascii 1.0\ncomment TextureFile map.png\nelement vertex 4\n"
                               "property float x\nproperty float y\nproperty float z\n";

/// The place of a corner.
std::array<float, 2> place(const FileColours& colours, std::size_t corner)
{
    return colours.places[usize(colours.place_of_corner[corner])];
}

using Place = std::array<float, 2>;

}  // namespace

TEST_CASE("OBJ: the corners' places, counted from the front and from the back, and the material of each face")
{
    const ColouredFile file("a.obj");
    file.beside("my map.png", png);
    file.beside("a.mtl", "newmtl red one\nKd 1 0 0.5\nnewmtl mapped\nKd 0 0 0\nmap_Kd -s 2 2 2 -clamp on my map.png\n");
    const FileColours colours =
        file.read("mtllib a.mtl\n" + square + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 .5\nusemtl mapped\n" +
                  "f 1 1 2\nf 1/1 2/2/9 3/3\nusemtl red one\nf 1/-4 3/-2 4/-1\n");
    CHECK(colours.remarks.empty());
    REQUIRE(colours.materials.size() == 2);
    CHECK(colours.material_of_face == std::vector<Index>{0, 1});
    CHECK(colours.materials[0].image.starts_with("data:image/png;base64,iVBORw0KGgp"));
    CHECK(colours.materials[0].colour == Colour{255, 255, 255});
    CHECK(colours.materials[1].image.empty());
    CHECK(colours.materials[1].colour == Colour{255, 0, 128});
    REQUIRE(colours.place_of_corner.size() == 6);
    CHECK(place(colours, 1) == Place{1, 0});
    CHECK(place(colours, 2) == Place{1, 1});
    CHECK(place(colours, 3) == Place{0, 0});
    CHECK(place(colours, 5) == Place{0, 0.5});
}

TEST_CASE("OBJ: numbers of places that there are not, and none at all, are no reason to stop")
{
    const ColouredFile file("a.obj");
    file.beside("map.png", png);
    file.beside("a.mtl", "newmtl m\nmap_Kd map.png\n");
    for (const std::string face : {"f 1/7 2/-9 3/99999999999", "f 1 2 3"})
        for (const std::string more : {"", "vt 1 1\n"}) {
            const FileColours colours = file.read("mtllib a.mtl\n" + square + more + "usemtl m\n" + face + "\n");
            REQUIRE(colours.materials.size() == 1);
            CHECK(colours.place_of_corner == std::vector<Index>{0, 0, 0});
        }
}

TEST_CASE("places that are no numbers are 0")
{
    const ColouredFile file("a.obj");
    file.beside("map.png", png);
    file.beside("a.mtl", "newmtl m\nmap_Kd map.png\n");
    const FileColours colours =
        file.read("mtllib a.mtl\n" + square + "vt nan 1\nvt 1e99 .5\nvt .5\nusemtl m\nf 1/1 2/2 3/3\n");
    CHECK(colours.places == std::vector<Place>{{0, 1}, {0, 0.5}, {0.5, 0}});
}

TEST_CASE("a material file called - is not standard input")
{
    CHECK(folder_of("a.obj") / "-" != "-");
    CHECK(folder_of("b/a.obj") == "b");
}

TEST_CASE("images are looked for where the file says and beside it, and what is amiss is told")
{
    const ColouredFile file("a.obj");
    file.beside("map.png", png);
    file.beside("map.tga", "no browser shows this");
    const auto with_image = [&](const std::string& name) {
        file.beside("a.mtl", "newmtl m\nmap_Kd " + name + "\n");
        return file.read("mtllib a.mtl\n" + square + "vt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    };
    for (const std::string name : {"map.png", "./map.png", "C:\\textures\\map.png", "/nowhere/map.png"}) {
        CAPTURE(name);
        CHECK_FALSE(with_image(name).materials.empty());
    }
    const FileColours missing = with_image("other.png");
    CHECK(missing.materials.empty());
    CHECK(missing.place_of_corner.empty());
    REQUIRE(missing.remarks.size() == 1);
    CHECK(missing.remarks[0].find("other.png, which is not beside the mesh") != std::string::npos);
    CHECK(with_image("map.tga").remarks.at(0).find("not a PNG") != std::string::npos);
    const FileColours lost = file.read("mtllib none.mtl\n" + square + "usemtl m\nf 1 2 3\n");
    CHECK(lost.materials.empty());
    CHECK(lost.remarks.at(0).find("none.mtl") != std::string::npos);
}

TEST_CASE("OBJ: colours of vertices, from 0 to 1 or to 255")
{
    const ColouredFile file("a.obj");
    const FileColours to_one = file.read("v 0 0 0 1 0 0\nv 1 0 0 0 .5 0\nv 1 1 0 0 0 nan\nf 1 2 3\n");
    CHECK(to_one.of_vertices == std::vector<Colour>{{255, 0, 0}, {0, 128, 0}, {0, 0, 128}});
    const FileColours to_255 = file.read("v 0 0 0 255 0 0\nv 1 0 0 0 51 0\nv 1 1 0 0 0 255\nf 1 2 3\n");
    CHECK(to_255.of_vertices == std::vector<Colour>{{255, 0, 0}, {0, 51, 0}, {0, 0, 255}});
    CHECK(file.read("v 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").of_vertices.empty());
    CHECK(file.read("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nf 1 2 3\n").of_vertices.empty());
}

TEST_CASE("PLY: colours and places of vertices")
{
    const ColouredFile file("a.ply");
    file.beside("map.png", png);
    const FileColours colours = file.read(
        ply_header + "property float s\nproperty float t\nproperty uchar red\nproperty uchar green\n"
                     "property uchar blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                     "0 0 0 0 0 1 2 3\n1 0 0 1 0 4 5 6\n1 1 0 1 1 7 8 9\n0 1 0 nan 1 0 0 255\n4 0 1 2 3\n");
    CHECK(colours.remarks.empty());
    CHECK(colours.of_vertices == std::vector<Colour>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {0, 0, 255}});
    REQUIRE(colours.materials.size() == 1);
    CHECK(colours.material_of_face == std::vector<Index>{0});
    CHECK(place(colours, 2) == Place{1, 1});
    CHECK(place(colours, 3) == Place{0, 1});
}

TEST_CASE("PLY: places of corners, but of faces that are left out")
{
    const ColouredFile file("a.ply");
    file.beside("map.png", png);
    const std::string text =
        ply_header + "element face 3\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
                     "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                     "3 0 1 2 6 0 0 .5 0 .5 1\n3 0 0 1 6 9 9 9 9 9 9\n3 0 2 3 6 .25 0 .5 1 1 1\n";
    const FileColours colours = file.read(text);
    REQUIRE(colours.place_of_corner.size() == 6);
    CHECK(place(colours, 1) == Place{0.5, 0});
    CHECK(place(colours, 3) == Place{0.25, 0});
    CHECK(place(colours, 4) == Place{0.5, 1});
    CHECK(colours.place_of_corner[2] == colours.place_of_corner[4]);
    std::filesystem::remove(file.path.parent_path() / "map.png");
    const FileColours without = file.read(text);
    CHECK(without.materials.empty());
    CHECK(without.places.empty());
    CHECK(without.remarks.at(0).find("map.png") != std::string::npos);
}

TEST_CASE("PLY: places of corners stay with them where the file repeats a corner, or lists the places first")
{
    const ColouredFile file("a.ply");
    file.beside("map.png", png);
    const std::string corners = "property list uchar int vertex_index\n";
    const std::string places = "property list uchar float texcoord\n";
    const std::string points = "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const FileColours behind = file.read(ply_header + "element face 3\n" + corners + places + points +
                                         "4 0 1 1 2 8 0 0 .5 0 9 9 .5 1\n3 0 2 3 6 .25 0 .5 1 1 1\n"
                                         "4 0 1 2 0 8 0 0 .5 0 .5 1 9 9\n");
    const FileColours before = file.read(ply_header + "element face 3\n" + places + corners + points +
                                         "8 0 0 .5 0 9 9 .5 1 4 0 1 1 2\n6 .25 0 .5 1 1 1 3 0 2 3\n"
                                         "8 0 0 .5 0 .5 1 9 9 4 0 1 2 0\n");
    for (const FileColours& colours : {behind, before}) {
        REQUIRE(colours.place_of_corner.size() == 9);
        const std::vector<Place> expected{{0, 0}, {0.5, 0}, {0.5, 1}, {0.25, 0}, {0.5, 1},
                                          {1, 1}, {0, 0},   {0.5, 0}, {0.5, 1}};
        for (std::size_t corner = 0; corner < expected.size(); ++corner)
            CHECK(place(colours, corner) == expected[corner]);
    }
    // A list that is too short, as one too long, is no reason to stop.
    const FileColours odd = file.read(ply_header + "element face 2\n" + corners + places + points +
                                      "3 0 1 2 2 .5 .5\n3 0 2 3 8 .25 0 .5 1 1 1 7 7\n");
    REQUIRE(odd.place_of_corner.size() == 6);
    CHECK(place(odd, 0) == Place{0.5, 0.5});
    CHECK(place(odd, 2) == Place{0, 0});
    CHECK(place(odd, 5) == Place{1, 1});
}

TEST_CASE("a file that is not that of the mesh, and formats without colours, have none")
{
    const ColouredFile file("a.obj");
    MeshFile other = read_mesh(file.folder.with("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    file.beside("a.obj", square + "f 1 2 3 4\n");
    const FileColours colours = read_file_colours(file.path, other, {});
    CHECK(colours.remarks.at(0).find("the face is not that of the mesh") != std::string::npos);
    CHECK(read_file_colours("-", other, {}).remarks.empty());
    other.kind.format = FileFormat::Stl;
    CHECK(read_file_colours("a.stl", other, {}).remarks.empty());
}

TEST_CASE("images are told by their first bytes")
{
    CHECK(image_type(png) == "image/png");
    CHECK(image_type("\xff\xd8\xff\xe0") == "image/jpeg");
    CHECK(image_type(std::string("RIFF\0\0\0\0WEBPVP8 ", 16)) == "image/webp");
    CHECK(image_type("RIFFxxxxWAVE") == "");
    CHECK(image_type("") == "");
}
