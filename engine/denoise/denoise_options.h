#pragma once

#include <optional>
#include <variant>

#include "engine/options/motion_options.h"

namespace seamflow {

/// Which coordinates of a mesh are rounded: those of voxels, of slices, of heights in whole metres. Rounding is no
/// noise: each coordinate lies within half a step of the true one.
struct Rounding {
    enum class Kind {
        /// Steps are found, and count on components whose roughness they explain. Not if vertices move along normals
        /// or oblique lines.
        Found,
        /// Steps are known: `steps`.
        Given,
        /// Nothing counts as rounded.
        Never,
    };
    Kind kind = Kind::Found;
    /// The steps of x, y and z, in units of length: finite, at least 0, and not all 0. 0: not rounded.
    Point steps = Point::Zero();

    friend bool operator==(const Rounding& a, const Rounding& b)
    {
        return a.kind == b.kind && a.steps.cwiseEqual(b.steps).all();
    }
};

/// Removes noise, as much as there is at each place: each step estimates the true normal of each face and how large the
/// noise is there, and moves vertices to fit; along the normals, unless a face would fold. Edges, round parts and
/// details stay, and where there is no noise, vertices stay bit for bit. One step is enough; further ones treat what is
/// left as noise. On components whose roughness rounding explains, there is no noise to remove: the first step finds
/// the smoothest surface whose coordinates are within half a step of the given ones.
struct RemoveNoise {
    static constexpr double default_edge_angle = 30.0;

    /// Edges at which the normals of faces differ by more than this angle stay where the noise is small; in degrees,
    /// above 0 and below 180.
    double edge_angle = default_edge_angle;
    Rounding rounding = {};
};

/// Smooths the surface between edges by an amount that is given, whether there is noise or not: in each step, face
/// normals diffuse by dt, but not across edges, and vertices move to fit them. Because edges do not suffer, eight to
/// thirty squared mean edge lengths suit one step of parts of planes with noise. Clean round parts bend by it. Further
/// steps start from the resulting surface. Fixed vertices stay, and a free boundary does not shrink.
struct SmoothBetweenEdges {
    /// Edges at which the normals of faces differ by more than this angle stay, and so do corners where such edges
    /// meet; in degrees, above 0 and below 180; 20 to 40 suit most meshes.
    double edge_angle = RemoveNoise::default_edge_angle;
    SmoothingAmount amount = {};
};

/// Smooths the boundary alone: each of its lines becomes a curve that bends less (see smooth_curve), in which bumps of
/// the radius are half as high, and which neither shrinks nor slides along itself. The surface follows within a band a
/// few times as wide as the motion.
struct SmoothRims {
    SmoothingAmount amount = {};
};

/// A method that takes a surface as a whole, without sub-meshes and without the equations of a flow.
using DenoiseMethod = std::variant<RemoveNoise, SmoothBetweenEdges, SmoothRims>;

/// All options of denoise(): `{.method = SmoothBetweenEdges{.edge_angle = 40.0, .amount = {.time_step = 0.05}}}`.
struct DenoiseOptions {
    DenoiseMethod method = RemoveNoise{};
    /// From 0 (which leaves the mesh as it is) to most_steps.
    int steps = 1;
    /// Without attachment. Edges in feature_edges are kept whatever their angle: faces on the two sides are smoothed
    /// independently.
    MotionOptions motion = default_motion();
    /// At most most_threads. 0: those of the calling TBB arena (by default all cores). The result is the same, bit for
    /// bit, for any number.
    int threads = 0;
    /// Measures mean curvature and displacements after each step. If false, they are 0 in the report.
    bool measures = true;

    /// Boundaries are free, and the volume of no component changes by a larger fraction than
    /// ComponentLimits::most_volume_change.
    static MotionOptions default_motion()
    {
        return {.boundary = Boundary::Free, .limits = {.volume = ComponentLimits::most_volume_change}};
    }
};

/// Checks all options. @throws OptionError naming the option, its value and a remedy; InputError naming the vertex for
/// a strength.
void require_valid(const DenoiseOptions& options);

}  // namespace seamflow
