#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/distributed/distributed_flow.h"
#include "engine/distributed/ranks/thread_transport.h"
#include "engine/measure/surface_measures.h"
#include "partition/errors.h"
#include "partition/metrics/vertex_distance.h"
#include "partition/metrics/volume.h"
#include "tests/engine/distributed/parts.h"
#include "tests/engine/distributed/rank_flows.h"
#include "tests/support/flows.h"
#include "tests/support/relative.h"

using namespace seamflow;
using test::by_sweeps;
using test::check_bits;
using test::converged;
using test::Example;
using test::flowed_on_ranks;
using test::Result;
using test::some_numbers_of_ranks;

namespace {

bool same(const RankMeasures& a, const RankMeasures& b)
{
    return a.area == b.area && a.volume == b.volume && a.mean_edge == b.mean_edge &&
           a.displacement.mean == b.displacement.mean && a.displacement.rms == b.displacement.rms &&
           a.displacement.max == b.displacement.max;
}

/// What every rank throws.
template <class Error>
void check_refusal(const std::function<void(Transport&)>& body, int n, const std::string& expected)
{
    CAPTURE(expected);
    run_on_threads(n, [&](Transport& transport) {
        std::string message;
        try {
            body(transport);
        } catch (const Error& error) {
            message = error.what();
        }
        CAPTURE(message);
        CHECK(message.find(expected) != std::string::npos);
    });
}

}  // namespace

TEST_CASE("ranks find the bits of one machine: open surfaces of any polygons, every Laplacian")
{
    for (const PolygonMesh& mesh : test::height_fields(900))
        for (const Laplacian laplacian : test::all_laplacians)
            check_bits({std::string(name_of(laplacian)), mesh, by_sweeps(laplacian, 2e-3)}, 12, {1, 3, 8});
}

TEST_CASE("ranks find the bits of one machine: filters, and displacements that are bounded")
{
    for (const PolygonMesh& mesh : {make_triangles(900), make_mixed_polygons(900), make_noisy_sphere(1500)}) {
        FlowOptions options = by_sweeps(Laplacian::Uniform, 1e-3);
        options.order = 3;
        check_bits({"order 3", mesh, options}, 12, {1, 3, 8});
        options.motion.within = 0.01;
        check_bits({"bounded", mesh, options}, 12, {1, 3, 8});
        FlowOptions low_pass = converged(Laplacian::Fujiwara, 2e-3);
        low_pass.filter = Filter::LowPass;
        low_pass.order = 3;
        low_pass.motion.within = 0.005;
        check_bits({"low-pass, bounded", mesh, low_pass}, 12, {1, 3, 8});
        CHECK(test::largest_difference(test::flowed(mesh, low_pass), mesh.vertices) <= 0.005 * (1.0 + 1e-12));
    }
}

TEST_CASE("ranks find the bits of one machine: closed, not orientable, of several components, with any number of ranks")
{
    const FlowOptions options = by_sweeps(Laplacian::Fujiwara, 3e-2);
    check_bits({"torus", test::triangle_torus(30, 24), options}, 9, some_numbers_of_ranks);
    check_bits({"quads", test::quad_torus(24, 24), options}, 8, some_numbers_of_ranks);
    check_bits({"band", test::moebius_band(60, 8), options}, 7, some_numbers_of_ranks);
    check_bits({"sphere", make_noisy_sphere(1500), by_sweeps(Laplacian::AlexaWardetzky, 1e-3)}, 16,
               some_numbers_of_ranks);
    check_bits({"three", test::side_by_side({test::triangle_torus(16, 12), make_hexagons(500), test::cylinder(12, 20)}),
                options},
               10, some_numbers_of_ranks);
    // Fewer sub-meshes than ranks: some have nothing.
    check_bits({"two", make_triangles(600), options}, 2, some_numbers_of_ranks);
}

TEST_CASE("ranks find the bits of one machine: vertices held, not manifold, far from the origin")
{
    const FlowOptions options = by_sweeps(Laplacian::Fujiwara, 1e-2);
    PolygonMesh far = make_mixed_polygons(700);
    far.vertices.rowwise() += Point(1e6, -3e5, 1e7);
    check_bits({"far", far, options}, 8, {1, 3, 5});
    Example held{"held", make_triangles(700), options};
    for (Index v = 0; v < held.mesh.n_vertices(); v += 13)
        held.fixed.push_back(v);
    check_bits(held, 8, {1, 3, 5});
    // A face without edges to speak of, at whose vertices nothing is defined.
    PolygonMesh shrunk = make_triangles(700);
    const auto corners_of_shrunk = shrunk.face(300);
    for (const Index v : corners_of_shrunk)
        shrunk.vertices.row(v) = shrunk.vertices.row(corners_of_shrunk.front()).eval();
    check_bits({"shrunk", shrunk, options}, 8, {1, 3, 5});
    // Two sheets with a seam of four faces at each edge.
    PolygonMesh crossed = make_triangles(400);
    const Index n = crossed.n_vertices();
    PolygonMesh other = crossed;
    crossed.vertices.conservativeResize(2 * n, 3);
    for (Index v = 0; v < n; ++v)
        crossed.vertices.row(n + v) = crossed.vertices.row(v) + Eigen::RowVector3d(0.0, 0.0, 1.0);
    for (Index f = 0; f < other.n_faces(); ++f) {
        std::vector<Index> corners;
        for (const Index v : other.face(f))
            corners.push_back(v % 20 == 0 ? v : v + n);
        crossed.add_face(corners);
    }
    check_bits({"crossed", crossed, options}, 8, {1, 3, 5});
}

TEST_CASE("ranks find the bits of one machine: other conditions, terms and orders of the sweep, any number of threads")
{
    const PolygonMesh mesh = make_mixed_polygons(900);
    const FlowOptions defaults = by_sweeps(Laplacian::VirtualRefinement, 2e-3);
    FlowOptions options = defaults;
    options.interface.transmission = Transmission::Derivative;
    check_bits({"derivative", mesh, options}, 10, {1, 3, 5});
    options = defaults;
    options.interface.conditions = Conditions::AdaptedVentcell;
    options.interface.q = 0.1;
    options.interface.sweep = Sweep::Fixed;
    check_bits({"Ventcell", mesh, options}, 10, {1, 3, 5});
    options = defaults;
    options.filter = Filter::LowPass;
    options.motion.attachment = 0.3;
    check_bits({"low-pass", mesh, options}, 10, {1, 3, 5});
    options = defaults;
    options.flow = FlowEquation::Conformalized;
    options.interface.colouring = Colouring::Label;
    options.interface.correction = Correction::None;
    check_bits({"conformalized", mesh, options}, 10, {1, 3, 5});
    for (const int threads : {2, 3}) {
        options = defaults;
        options.resources.threads = threads;
        check_bits({"threads", mesh, options}, 20, {1, 3, 5});
    }
}

TEST_CASE("ranks find the bits of one machine in sweeps with a free boundary, where no two sub-meshes share it")
{
    // Rings of a tube, and a torus beside it.
    const PolygonMesh tube = test::cylinder(24, 40);
    Example example{"tube", test::side_by_side({tube, test::triangle_torus(20, 16)}), {}};
    for (Index f = 0; f < example.mesh.n_faces(); ++f)
        example.labels.push_back(f < tube.n_faces() ? f * 7 / tube.n_faces() : 7);
    for (const Laplacian laplacian : {Laplacian::Fujiwara, Laplacian::AlexaWardetzky, Laplacian::VirtualRefinement}) {
        example.options = by_sweeps(laplacian, 1e-2);
        example.options.motion.boundary = Boundary::Free;
        check_bits(example, 0, {1, 2, 3, 5});
        example.fixed = {3, 4, 40, 500};
        example.options.filter = Filter::LowPass;
        example.options.motion.attachment = 0.3;
        check_bits(example, 0, {1, 2, 3, 5});
        example.fixed.clear();
    }
    // Sub-meshes that share it are refused, on all ranks as on one machine.
    for (std::size_t f = 0; f < example.labels.size(); ++f)
        example.labels[f] = static_cast<Index>(f % 24 < 12 && example.labels[f] == 6 ? 8 : example.labels[f]);
    FlowOptions options = example.options;
    options.cut.labels = example.labels;
    PolygonMesh mesh = example.mesh;
    CHECK_THROWS_AS(mean_curvature_flow(mesh, options), OptionError);
    check_refusal<OptionError>(
        [&](Transport& transport) {
            MeshPart part = test::part_of(example.mesh, example.labels, transport.rank(), 3);
            distributed_mean_curvature_flow(transport, part, example.options);
        },
        3, "boundary is free and shared by several sub-meshes, which need converged steps");
}

TEST_CASE("an estimate that is far off is told of as by one machine")
{
    Example example{"drift", make_triangles(900), by_sweeps(Laplacian::Fujiwara, 1.0)};
    PolygonMesh mesh = example.mesh;
    FlowOptions options = example.options;
    options.cut.subdomains = 12;
    const FlowReport report = mean_curvature_flow(mesh, options);
    const auto says_so = [](const std::string& remark) { return remark.find("by estimate") != std::string::npos; };
    const auto expected = std::ranges::find_if(report.remarks, says_so);
    REQUIRE(expected != report.remarks.end());
    for (const RankReport& rank : flowed_on_ranks(example, report.cut.labels, 3).reports)
        CHECK(std::ranges::count(rank.flow.remarks, *expected) == 1);
}

TEST_CASE("ranks find the bits of one machine with weights of the attachment")
{
    Example example{"weights", make_mixed_polygons(700), by_sweeps(Laplacian::VirtualRefinement, 2e-3)};
    for (Index v = 0; v < example.mesh.n_vertices(); ++v)
        example.weights.push_back(v % 5);
    check_bits(example, 8, {1, 3, 5});
    example.options = converged(Laplacian::VirtualRefinement, 2e-3);
    check_bits(example, 8, {1, 3, 5});
}

TEST_CASE("faces that repeat others are left out, wherever they are")
{
    const PolygonMesh once = make_mixed_polygons(500);
    for (const Index stride : {1, 7}) {
        CAPTURE(stride);
        Example example{"repeated", once, by_sweeps(Laplacian::Fujiwara, 1e-3)};
        for (Index f = 0; f < once.n_faces(); f += stride)
            example.mesh.add_face(once.face(f));
        PolygonMesh mesh = example.mesh;
        FlowOptions options = example.options;
        options.cut.subdomains = 8;
        const FlowReport report = mean_curvature_flow(mesh, options);
        // To sub-meshes that need not be near.
        std::vector<Index> labels = report.cut.labels;
        for (Index f = once.n_faces(); f < example.mesh.n_faces(); ++f)
            labels[f] = (labels[f] + f) % report.cut.n_sub_meshes();
        for (const int n : {1, 3, 5}) {
            CAPTURE(n);
            const Result result = flowed_on_ranks(example, labels, n);
            CHECK(test::same_bits(result.positions, mesh.vertices));
            for (const RankReport& rank : result.reports) {
                CHECK(rank.flow.mesh.faces == example.mesh.n_faces());
                REQUIRE(rank.flow.remarks.size() == 1);
                CHECK(std::ranges::count(report.remarks, rank.flow.remarks.front()) == 1);
            }
        }
    }
}

TEST_CASE("ranks do not wait for each other in a circle where memory is scarce")
{
    Example example{"scarce", make_triangles(2500), by_sweeps(Laplacian::Fujiwara, 1e-3, 4)};
    std::size_t limit = 20'000;
    for (bool is_refused = true; is_refused; limit += limit / 5) {
        REQUIRE(limit < 100'000'000);
        example.options.resources.memory_limit = limit;
        try {
            check_bits(example, 40, {3});
            is_refused = false;
        } catch (const OptionError&) {
            continue;
        }
    }
    check_bits(example, 40, {1, 2, 5, 8});
}

TEST_CASE("what is measured is that of the whole mesh, and the same for any number of ranks")
{
    for (const PolygonMesh& mesh : {make_noisy_sphere(900), make_mixed_polygons(600), test::moebius_band(60, 8)}) {
        Example example{"measured", mesh, converged(Laplacian::VirtualRefinement, 1e-3)};
        example.options.steps = 1;
        PolygonMesh moved = mesh;
        FlowOptions options = example.options;
        options.cut.subdomains = 9;
        const FlowReport report = mean_curvature_flow(moved, options);
        std::vector<RankReport> first;
        for (const int n : {1, 2, 5}) {
            CAPTURE(n);
            const Result result = flowed_on_ranks(example, report.cut.labels, n);
            if (first.empty())
                first = result.reports;
            for (const RankReport& rank : result.reports) {
                CHECK(same(*rank.before, *first.front().before));
                CHECK(same(*rank.after, *first.front().after));
                CHECK(rank.flow.steps[0].estimated_v_max == first.front().flow.steps[0].estimated_v_max);
                CHECK(rank.vertices + rank.foreign_vertices <= mesh.n_vertices());
                CHECK(rank.flow.mesh.vertices == mesh.n_vertices());
            }
        }
        const RankMeasures& before = *first.front().before;
        const RankMeasures& after = *first.front().after;
        CHECK(before.area == test::relative(total_area(mesh), 1e-5));
        CHECK(after.area == test::relative(total_area(moved), 1e-5));
        CHECK(after.mean_edge == test::relative(mean_edge_length(moved), 1e-5));
        CHECK(after.volume.has_value() == encloses_volume(mesh, run_serially));
        if (after.volume)
            CHECK(*after.volume ==
                  test::relative(volume_of_cones(moved, moved.vertices, Point::Zero(), run_serially), 1e-5));
        CHECK(before.displacement.max == 0.0);
        const Eigen::VectorXd distances = (moved.vertices - mesh.vertices).rowwise().norm();
        CHECK(after.displacement.max == distances.maxCoeff());
        CHECK(after.displacement.mean == test::relative(distances.mean(), 1e-5));
        CHECK(after.displacement.rms == test::relative(std::sqrt(distances.squaredNorm() / moved.n_vertices()), 1e-5));
        CHECK(first.front().flow.steps[0].moved->max == after.displacement.max);
        CHECK(*first.front().flow.steps[0].estimated_v_max == test::relative(*report.steps[0].estimated_v_max, 1e-5));
    }
}

TEST_CASE("observers see each step on all ranks, and can work together")
{
    const PolygonMesh mesh = make_mixed_polygons(600);
    FlowOptions options = by_sweeps(Laplacian::Fujiwara, 1e-3);
    options.cut.subdomains = 6;
    PolygonMesh moved = mesh;
    std::vector<Points> expected;
    const FlowReport report =
        mean_curvature_flow(moved, options, [&](const StepState& state) { expected.push_back(state.positions); });
    options.cut.subdomains = 0;
    const auto part_at = [&](int rank) { return test::part_of(mesh, report.cut.labels, rank, 3); };
    run_on_threads(3, [&](Transport& transport) {
        MeshPart part = part_at(transport.rank());
        int steps = 0;
        distributed_mean_curvature_flow(transport, part, options, [&](const RankStepState& state) {
            CHECK(state.step == ++steps);
            CHECK(state.part.labels == part.labels);
            const std::vector<Index> numbers(part.vertex_numbers.begin(), part.vertex_numbers.end());
            CHECK(test::same_bits(state.part.mesh.vertices, expected[steps - 1](numbers, Eigen::all)));
            CHECK(state.comm.gather_all(std::vector<int>{steps}) == std::vector<int>(3, steps));
        });
        CHECK(steps == options.steps);
    });
    check_refusal<OutputError>(
        [&](Transport& transport) {
            MeshPart part = part_at(transport.rank());
            const Points before = part.mesh.vertices;
            try {
                distributed_mean_curvature_flow(transport, part, options, [&](const RankStepState& state) {
                    if (state.step == 2 && transport.rank() == 1)
                        throw OutputError("the disk is full");
                    state.comm.gather_all(std::vector<int>{state.step});
                });
            } catch (const OutputError&) {
                CHECK(test::same_bits(part.mesh.vertices, before));
                throw;
            }
        },
        3, "rank 1 on this process: the disk is full");
}

TEST_CASE("a failure on one rank ends all with one message")
{
    const PolygonMesh mesh = make_triangles(600);
    PolygonMesh cut = mesh;
    FlowOptions options = by_sweeps(Laplacian::Fujiwara, 1e-3);
    options.cut.subdomains = 6;
    const std::vector<Index> labels = mean_curvature_flow(cut, options).cut.labels;
    options.cut.subdomains = 0;
    const auto flow = [&](const FlowOptions& with, const std::vector<Index>& from,
                          const std::function<void(MeshPart&, int)>& change = {}) {
        return [&mesh, with, from, change](Transport& transport) {
            MeshPart part = test::part_of(mesh, from, transport.rank(), 3);
            if (change)
                change(part, transport.rank());
            const Points before = part.mesh.vertices;
            const auto check_unmoved = [&] { CHECK(test::same_bits(part.mesh.vertices, before)); };
            try {
                distributed_mean_curvature_flow(transport, part, with);
            } catch (...) {
                check_unmoved();
                throw;
            }
        };
    };
    // A step that throws vertices too far, which single ranks find.
    FlowOptions tight = options;
    tight.accuracy.largest_update = 1e-9;
    check_refusal<ComputationError>(flow(tight, labels), 3, "step 1, sub-mesh ");
    // Options.
    FlowOptions converged = options;
    converged.accuracy.approach = Approach::ConjugateGradients;
    check_refusal<OptionError>(flow(converged, labels), 3, "approach has to be sweep");
    converged.accuracy.approach = Approach::Converged;
    converged.laplacian = Laplacian::PtackovaVelho;
    check_refusal<OptionError>(flow(converged, labels), 3, "use sweeps");
    // What one rank alone has wrong.
    const auto spoil = [](MeshPart& part, int rank) {
        if (rank == 1)
            part.mesh.vertices(0, 0) = std::numeric_limits<double>::quiet_NaN();
    };
    check_refusal<InputError>(flow(options, labels, spoil), 3, "rank 1 on this process: ");
    const auto shuffle = [](MeshPart& part, int rank) {
        if (rank == 2)
            std::swap(part.face_numbers[3], part.face_numbers[4]);
    };
    check_refusal<InputError>(flow(options, labels, shuffle), 3, "rank 2 on this process: the numbers of a part");
    const auto share = [](MeshPart& part, int rank) {
        if (rank == 2)
            part.labels[0] = 0;
    };
    check_refusal<InputError>(flow(options, labels, share), 3, "sub-mesh 0 has faces of rank 0 and of rank 2");
    // A mesh that is a line.
    const auto flatten = [](MeshPart& part, int) { part.mesh.vertices.rightCols(2).setZero(); };
    FlowOptions by_areas = options;
    by_areas.laplacian = Laplacian::AlexaWardetzky;
    check_refusal<InputError>(flow(by_areas, labels, flatten), 3, "nothing can move: ");
    // Two faces that belong elsewhere, which leaves sub-meshes in pieces or pinched.
    std::vector<Index> torn = labels;
    const auto first = std::ranges::find(torn, 2);
    const auto last = std::find(torn.rbegin(), torn.rend(), 3);
    *first = 3;
    *last = 2;
    check_refusal<InputError>(flow(options, torn), 3, "use the mended labels that a flow of the same mesh reports");
    // Weights of one rank alone.
    const auto attach = [](MeshPart& part, int rank) {
        if (rank == 1)
            part.attachment_weights.assign(part.vertex_numbers.size(), 1.0);
    };
    check_refusal<InputError>(flow(options, labels, attach), 3, "some ranks have attachment weights");
    const auto weaken = [](MeshPart& part, int rank) {
        part.strengths.assign(part.vertex_numbers.size(), 0.5);
        if (rank == 2)
            part.strengths[1] = 1.5;
    };
    check_refusal<InputError>(flow(test::converged(Laplacian::Fujiwara, 1e-3), labels, weaken), 3,
                              "rank 2 on this process: the strength of vertex ");
    const auto weaken_one = [](MeshPart& part, int rank) {
        if (rank == 0)
            part.strengths.assign(part.vertex_numbers.size(), 0.5);
    };
    check_refusal<InputError>(flow(test::converged(Laplacian::Fujiwara, 1e-3), labels, weaken_one), 3,
                              "some ranks have strengths");
    const auto all = [](MeshPart& part, int /*rank*/) { part.strengths.assign(part.vertex_numbers.size(), 0.5); };
    check_refusal<OptionError>(flow(options, labels, all), 3, "strength is given, whose steps are converged");
}

TEST_CASE("ranks find the bits of one machine: components that vanish, in one sub-mesh or several")
{
    for (const double size : {1e-6, 1e-12}) {
        PolygonMesh mesh =
            test::together({test::ball(1.0, {0.0, 0.0, 0.0}, 300), test::ball(size, {3.0, 0.0, 0.0}, 100),
                            test::ball(2.0 * size, {-2.0, 1.0, 0.0}, 120)});
        Example example{"small", mesh, by_sweeps(Laplacian::Fujiwara, 0.002)};
        check_bits(example, 6, some_numbers_of_ranks);
        // Through the small ones, too.
        for (Index f = 0; f < mesh.n_faces(); ++f)
            example.labels.push_back((7 * f) / 5 % 5);
        check_bits(example, 5, some_numbers_of_ranks);
        example.options = converged(Laplacian::VirtualRefinement, 0.002);
        check_bits(example, 5, {1, 2, 3});
        example.options.motion.attachment = 100.0;
        check_bits(example, 5, {1, 3});
    }
}

TEST_CASE("ranks find the bits of one machine: strengths, and motion along lines")
{
    const PolygonMesh mesh = make_mixed_polygons(900);
    Example uneven{"uneven", mesh, converged(Laplacian::VirtualRefinement, 5e-2)};
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        uneven.strengths.push_back(0.05 + 0.95 * std::abs(std::sin(0.1 * v)));
    check_bits(uneven, 8, {1, 3});
    uneven.options.motion.attachment = 0.3;
    check_bits(uneven, 8, {1, 3});
    // A moving boundary, with which all faces flow on one machine, too.
    uneven.options.motion.boundary = Boundary::Free;
    for (Index v = 0; v < mesh.n_vertices(); ++v)
        if (mesh.vertices(v, 0) < mesh.vertices.col(0).mean())
            uneven.strengths[at(v)] = 0.0;
    check_bits(uneven, 8, {1, 3});

    const PolygonMesh ball = make_noisy_sphere(1500);
    for (const bool by_normals : {false, true}) {
        CAPTURE(by_normals);
        for (FlowOptions options : {test::by_sweeps(Laplacian::Fujiwara, 1e-3), converged(Laplacian::Fujiwara, 1e-3)}) {
            options.motion.direction = {.kind =
                                            by_normals ? MotionDirection::Kind::Normal : MotionDirection::Kind::Vector,
                                        .vector = {1.0, 2.0, -0.5}};
            check_bits({"ball", ball, options}, 7, some_numbers_of_ranks);
            options.motion.within = 0.01;
            check_bits({"within", ball, options}, 7, {1, 3});
        }
    }
}

TEST_CASE("ranks do not pose small components that hardly move")
{
    const PolygonMesh mesh =
        test::together({test::ball(1.0, {0.0, 0.0, 0.0}, 300), test::ball(1e-6, {3.0, 0.0, 0.0}, 100)});
    Example example{"small", mesh, converged(Laplacian::Fujiwara, 0.002)};
    example.strengths.assign(at(mesh.n_vertices()), 1.0);
    for (Index v = 350; v < mesh.n_vertices(); ++v)
        example.strengths[at(v)] = 1e-6;
    for (Index f = 0; f < mesh.n_faces(); ++f)
        example.labels.push_back((7 * f) / 5 % 5);
    check_bits(example, 5, {1, 3});
}
