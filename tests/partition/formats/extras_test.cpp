#include <doctest/doctest.h>

#include "partition/formats/obj.h"
#include "partition/formats/off.h"
#include "partition/formats/ply.h"

using namespace seamflow;

using List = std::vector<std::string>;

TEST_CASE("what an OBJ file holds besides a surface")
{
    CHECK(extras_of_obj("a", "# comment\nv 0 0 0\nf 1 2 3\n").empty());
    CHECK(extras_of_obj("a", "v 0 0 0 1\nvt 0 0\nvn 0 0 1\nmtllib a\nusemtl a\ng a\no b\ns 1\nv 0 0 0 1 0 0\n") ==
          List{"weights", "texture coordinates", "normals", "materials", "groups", "smoothing groups", "colours"});
    CHECK(extras_of_obj("a", "l 1 2\np 1\ncurv 1\n") == List{"lines", "points", "other statements"});
}

TEST_CASE("what an OFF file holds besides a surface")
{
    CHECK(extras_of_off("a", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").empty());
    CHECK(extras_of_off("a", "STCNOFF 1 0 0\n0 0 0 0 0 1 1 1 1 0 0\n") ==
          List{"texture coordinates", "colours", "normals"});
    CHECK(extras_of_off("a", "OFF 3 1 0\n0 0 0 255\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n") ==
          List{"further numbers of vertices", "colours of faces"});
}

TEST_CASE("what a PLY file holds besides a surface")
{
    const std::string vertices = "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
                                 "property float z\n";
    CHECK(extras_of_ply("a", vertices + "element face 0\nproperty list uchar int vertex_index\nend_header\n").empty());
    CHECK(extras_of_ply("a", vertices + "property uchar red\nproperty uchar green\nelement face 0\nproperty list uchar "
                                        "int vertex_index\nproperty int label\nelement edge 0\nproperty int a\n"
                                        "end_header\n") ==
          List{"properties of vertices (red green)", "properties of faces (label)", "the element edge"});
}
