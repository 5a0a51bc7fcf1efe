#pragma once

#include <span>
#include <string>
#include <vector>

#include "partition/polygon_mesh.h"

/// Surfaces without noise that look as if they had some: bodies with a relief as fine as a few edges.
namespace seamflow::test {

/// A place of a body, seen by a relief. Lengths are in wavelengths.
struct Place {
    /// Around the body and along it.
    double a = 0.0;
    double b = 0.0;
    /// From the nearest centre of the relief, and from the next one.
    double nearest = 0.0;
    double next = 0.0;
    /// Where the place is.
    Point position = Point::Zero();
    /// In mean edges.
    double wavelength = 0.0;
};

/// Where the centres of a relief are, about a wavelength apart.
enum class Centres {
    None,
    Square,
    Hexagonal,
    /// Moved at random from a square lattice.
    Irregular,
    /// Along random strokes, a few around each centre of a square lattice, as those of letters.
    Strokes,
};

/// A pattern of heights, about 0 to 1.
struct Relief {
    double (*height)(const Place& place) = nullptr;
    Centres centres = Centres::None;
};

enum class Body { Plate, Tube, Torus, Ball };

/// How the vertices of a plate, a tube or a torus lie; those of a ball lie on circles of latitude.
enum class Lattice { Square, Hexagonal, Jittered };

/// A relief on a body.
struct ReliefKind {
    std::string name;
    Relief relief;
    Body body = Body::Plate;
    Lattice lattice = Lattice::Square;
    /// In mean edges; on closed bodies the nearest length of which a whole number goes around.
    double wavelength = 0.0;
    /// In mean edges.
    double height = 0.0;
    /// Between the lattice and the relief, in degrees; on closed bodies about that, so that the relief closes.
    double angle = 0.0;
    /// The part of the body along which there is a relief.
    double share = 1.0;
};

/// 72 of them: 22 reliefs with wavelengths of 3 to 16 edges on bodies and lattices of each sort.
std::span<const ReliefKind> relief_kinds();

struct ReliefSurface {
    PolygonMesh mesh;
    /// #V by 3: of the body without relief.
    Points normals;
    /// #V: along the normals.
    std::vector<double> heights;
};

/// @param vertices about as many, 100 at least.
ReliefSurface make_relief(const ReliefKind& kind, Index vertices);

}  // namespace seamflow::test
