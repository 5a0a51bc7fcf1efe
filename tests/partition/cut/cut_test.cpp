#include <algorithm>
#include <set>

#include <doctest/doctest.h>

#include "partition/connected_components.h"
#include "partition/cut/cut_into.h"
#include "partition/errors.h"
#include "tests/support/backwards.h"
#include "tests/support/cut_checks.h"
#include "tests/support/messages.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;
using namespace seamflow::test;

namespace {

void check_sound(const NamedMesh& m, const Cut& cut)
{
    REQUIRE(cut.labels.size() == static_cast<std::size_t>(m.mesh.n_faces()));
    const std::set<Index> distinct(cut.labels.begin(), cut.labels.end());
    REQUIRE(static_cast<Index>(distinct.size()) == cut.n_parts);
    if (cut.n_parts > 0) {
        CHECK(*distinct.begin() == 0);
        CHECK(*distinct.rbegin() == cut.n_parts - 1);
    }
    if (cut.n_parts > 1)
        CHECK_MESSAGE(!first_defect(m.mesh, m.topology, cut.labels),
                      first_defect(m.mesh, m.topology, cut.labels).value_or(""));
}

}  // namespace

TEST_CASE("every mesh can be cut into any number of parts")
{
    for (const NamedMesh& m : assorted_meshes())
        for (const Index k : {1, 2, 3, 4, 7, 12, 100, 2147483647}) {
            CAPTURE(m.name);
            CAPTURE(k);
            const Cut cut = cut_into(m.mesh, m.topology, k);
            check_sound(m, cut);
            CHECK(cut.remarks.empty() == (cut.n_parts == k || m.mesh.n_faces() == 0));
            // Before adding, so that the largest k does not overflow.
            CHECK(cut.n_parts - face_components(m.mesh, m.topology).count() <= k);
            const Cut again = cut_into(m.mesh, m.topology, k);
            CHECK(again.labels == cut.labels);
        }
}

TEST_CASE("a mesh large enough is cut into as many parts as asked, about equal")
{
    for (const NamedMesh& m : {with_topology(quad_grid(40, 30)), with_topology(triangle_torus(30, 30)),
                               with_topology(hexagon_sheet(30, 30))})
        for (const Index k : {2, 5, 16, 40}) {
            const Cut cut = cut_into(m.mesh, m.topology, k);
            check_sound(m, cut);
            CHECK(cut.n_parts == k);
            CHECK(cut.repaired_faces == 0);
            std::vector<Index> sizes(static_cast<std::size_t>(k), 0);
            for (const Index label : cut.labels)
                ++sizes[static_cast<std::size_t>(label)];
            CHECK(*std::max_element(sizes.begin(), sizes.end()) < 1.6 * m.mesh.n_faces() / k);
        }
}

TEST_CASE("large meshes, divided by clusters, are cut soundly too, however loops are run")
{
    const NamedMesh m =
        with_topology(side_by_side({triangle_torus(500, 500), quad_grid(3, 3), triangle_grid(100, 30)}));
    for (const Index k : {2, 90}) {
        const Cut cut = cut_into(m.mesh, m.topology, k);
        check_sound(m, cut);
        CHECK(cut.n_parts >= k);
        CHECK(cut.repaired_faces == 0);
        std::vector<Index> sizes(static_cast<std::size_t>(cut.n_parts), 0);
        for (const Index label : cut.labels)
            ++sizes[static_cast<std::size_t>(label)];
        CHECK(*std::max_element(sizes.begin(), sizes.end()) < 1.1 * m.mesh.n_faces() / k);
    }
    CHECK(cut_into(m.mesh, make_topology(m.mesh, run_backwards), 90, run_backwards).labels ==
          cut_into(m.mesh, m.topology, 90).labels);
}

TEST_CASE("what takes but one thread is handed out once, if there is any, and changes nothing but who does it")
{
    const NamedMesh m = with_topology(triangle_torus(40, 40));
    for (const Index k : {1, 2, 90}) {
        int n_calls = 0;
        const Cut cut = cut_into(m.mesh, m.topology, k, run_serially, [&](const std::function<void()>& serial) {
            ++n_calls;
            serial();
        });
        CHECK(n_calls == (k > 1 ? 1 : 0));
        CHECK(cut.labels == cut_into(m.mesh, m.topology, k).labels);
    }
    struct Stopped {};
    CHECK_THROWS_AS(cut_into(m.mesh, m.topology, 4, run_serially,
                             [](const std::function<void()>& serial) {
                                 serial();
                                 throw Stopped();
                             }),
                    Stopped);
}

TEST_CASE("one part is the whole mesh, with all its components")
{
    const NamedMesh m = with_topology(side_by_side({quad_grid(3, 3), quad_torus(4, 4)}));
    const Cut cut = cut_into(m.mesh, m.topology, 1);
    CHECK(cut.n_parts == 1);
    CHECK(cut.remarks.empty());
    CHECK(cut.labels == std::vector<Index>(25, 0));
}

TEST_CASE("components get parts in proportion to their size, small ones on top")
{
    const NamedMesh m =
        with_topology(side_by_side({quad_grid(30, 20), quad_grid(1, 1), quad_grid(20, 15), quad_grid(1, 1)}));
    const Cut cut = cut_into(m.mesh, m.topology, 6);
    check_sound(m, cut);
    CHECK(cut.n_parts == 8);
    CHECK(count_with(cut.remarks, "4 connected components") > 0);
    CHECK(std::set<Index>(cut.labels.begin(), cut.labels.begin() + 600).size() == 4);
    CHECK(std::set<Index>(cut.labels.begin() + 601, cut.labels.begin() + 901).size() == 2);
}

TEST_CASE("a mesh too small for k parts says so")
{
    const NamedMesh m = with_topology(quad_grid(6, 6));
    const Cut cut = cut_into(m.mesh, m.topology, 1000);
    CHECK(cut.n_parts <= 3);
    CHECK(count_with(cut.remarks, "too few") > 0);
}

TEST_CASE("the number of parts must be positive")
{
    const NamedMesh m = with_topology(quad_grid(2, 2));
    CHECK_THROWS_AS(cut_into(m.mesh, m.topology, 0), OptionError);
    CHECK_THROWS_AS(cut_into(m.mesh, m.topology, -3), OptionError);
}

TEST_CASE("a mesh without faces has no parts")
{
    const NamedMesh m = with_topology(PolygonMesh{});
    CHECK(cut_into(m.mesh, m.topology, 4).n_parts == 0);
    CHECK(cut_by_labels(m.mesh, m.topology, {}).n_parts == 0);
}

TEST_CASE("good labels are taken as they are")
{
    const NamedMesh m = with_topology(quad_grid(4, 1));
    const std::vector<Index> labels{1, 1, 0, 2};
    const Cut cut = cut_by_labels(m.mesh, m.topology, labels);
    CHECK(cut.labels == labels);
    CHECK(cut.n_parts == 3);
    CHECK(cut.repaired_faces == 0);
    CHECK(cut.remarks.empty());
}

TEST_CASE("labels with gaps, loose components or several components are put right and remarked upon")
{
    const NamedMesh strip = with_topology(quad_grid(5, 1));
    const Cut gaps = cut_by_labels(strip.mesh, strip.topology, std::vector<Index>{9, 9, 4, 4, 4});
    CHECK(gaps.labels == std::vector<Index>{1, 1, 0, 0, 0});
    CHECK(count_with(gaps.remarks, "gaps") > 0);
    const Cut one_gap = cut_by_labels(strip.mesh, strip.topology, std::vector<Index>{0, 0, 2, 2, 2});
    CHECK(one_gap.labels == std::vector<Index>{0, 0, 1, 1, 1});
    CHECK(count_with(one_gap.remarks, "gaps") > 0);
    const Cut no_gap = cut_by_labels(strip.mesh, strip.topology, std::vector<Index>{0, 0, 1, 1, 1});
    CHECK(count_with(no_gap.remarks, "gaps") == 0);

    const Cut loose = cut_by_labels(strip.mesh, strip.topology, std::vector<Index>{0, 0, 1, 1, 0});
    CHECK(loose.labels == std::vector<Index>{0, 0, 1, 1, 1});
    CHECK(loose.repaired_faces == 1);
    CHECK(count_with(loose.remarks, "1 face had to change parts") > 0);

    const NamedMesh two = with_topology(side_by_side({quad_grid(2, 1), quad_grid(2, 1)}));
    const Cut split = cut_by_labels(two.mesh, two.topology, std::vector<Index>{0, 1, 0, 0});
    CHECK(split.labels == std::vector<Index>{0, 1, 2, 2});
    CHECK(count_with(split.remarks, "there are 3") > 0);
}

TEST_CASE("equal labels leave the mesh uncut")
{
    const NamedMesh m = with_topology(side_by_side({quad_grid(2, 1), quad_grid(2, 1)}));
    const Cut cut = cut_by_labels(m.mesh, m.topology, std::vector<Index>{0, 0, 0, 0});
    CHECK(cut.n_parts == 1);
    CHECK(cut.remarks.empty());
}

TEST_CASE("labels that do not fit the mesh are refused")
{
    const NamedMesh m = with_topology(quad_grid(2, 1));
    CHECK_THROWS_WITH_AS(cut_by_labels(m.mesh, m.topology, std::vector<Index>{0, 0, 0}),
                         "there are 3 labels for 2 faces: give one label for each face", InputError);
    CHECK_THROWS_WITH_AS(cut_by_labels(m.mesh, m.topology, std::vector<Index>{0, -1}),
                         "face 1 (numbered from 0) has the label -1: labels must be at least 0", InputError);
}
