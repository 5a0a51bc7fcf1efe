#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/reliefs.h"

namespace seamflow::test {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// 0 to 1.
double fraction(double x)
{
    return x - std::floor(x);
}

double clamped(double x)
{
    return std::clamp(x, 0.0, 1.0);
}

/// From 1 down to 0 at a half, and up again.
double zigzag(double x)
{
    return std::abs(2.0 * fraction(x) - 1.0);
}

double half_circle(double x)
{
    const double t = zigzag(x);
    return std::sqrt(std::max(0.0, 1.0 - t * t));
}

/// Whether the number of a row is odd.
bool is_odd(double row)
{
    return fraction(0.5 * row) > 0.25;
}

/// A step of one edge at `distance` wavelengths.
double step_down(double distance, const Place& place)
{
    return clamped((distance - place.nearest) * place.wavelength + 0.5);
}

double egg_crate(const Place& p)
{
    return 0.5 + 0.5 * std::sin(two_pi * p.a) * std::sin(two_pi * p.b);
}

double corrugations(const Place& p)
{
    return 0.5 + 0.5 * std::sin(two_pi * p.a);
}

double rings(const Place& p)
{
    return 0.5 + 0.5 * std::sin(two_pi * p.b);
}

double corduroy(const Place& p)
{
    return half_circle(p.a);
}

double ribs(const Place& p)
{
    return clamped((0.25 - std::abs(fraction(p.a) - 0.5)) * p.wavelength + 0.5);
}

double grooves(const Place& p)
{
    return 1.0 - clamped((0.12 - std::abs(fraction(p.a) - 0.5)) * p.wavelength + 0.5);
}

double fins(const Place& p)
{
    return fraction(p.a) < 0.4 ? 1.0 : 0.0;
}

double knurl(const Place& p)
{
    return std::min(zigzag(p.a + p.b), zigzag(p.a - p.b));
}

double thread(const Place& p)
{
    return clamped(1.3 * zigzag(p.b) - 0.15);
}

double bricks(const Place& p)
{
    const double row = std::floor(2.0 * p.b);
    const double x = fraction(is_odd(row) ? p.a + 0.5 : p.a);
    const double y = fraction(2.0 * p.b);
    return clamped(p.wavelength * std::min({x, 1.0 - x, 0.5 * y, 0.5 - 0.5 * y}) - 0.3);
}

double weave(const Place& p)
{
    const double a = 2.0 * p.a;
    const double b = 2.0 * p.b;
    const double warp = half_circle(a) * (0.6 + 0.4 * std::cos(std::numbers::pi * (b - 0.5 + std::floor(a))));
    const double weft = half_circle(b) * (0.6 - 0.4 * std::cos(std::numbers::pi * (a - 0.5 + std::floor(b))));
    return std::max(warp, weft);
}

double tiles(const Place& p)
{
    return 0.7 * fraction(p.b) + 0.3 * half_circle(is_odd(std::floor(p.b)) ? p.a + 0.5 : p.a);
}

/// Engraved, with flanks of 37 degrees; the height is in edges.
double squares(const Place& p)
{
    const double from_middle = std::max(std::abs(fraction(p.a) - 0.5), std::abs(fraction(p.b) - 0.5));
    return -clamped(0.75 * (0.35 - from_middle) * p.wavelength);
}

double gyroid(const Place& p)
{
    const Point x = two_pi * p.position;
    return 0.5 + 0.33 * (std::sin(x.x()) * std::cos(x.y()) + std::sin(x.y()) * std::cos(x.z()) +
                         std::sin(x.z()) * std::cos(x.x()));
}

double studs(const Place& p)
{
    return step_down(0.3, p);
}

double dimples(const Place& p)
{
    const double t = p.nearest / 0.42;
    return -std::max(0.0, 1.0 - t * t);
}

/// Dimples that meet.
double hammered(const Place& p)
{
    const double t = p.nearest / 0.62;
    return std::min(1.0, t * t);
}

double pebbles(const Place& p)
{
    const double t = p.nearest / 0.45;
    return std::sqrt(std::max(0.0, 1.0 - t * t));
}

/// Walls halfway between centres.
double walls(const Place& p)
{
    return clamped(1.5 - 0.5 * (p.next - p.nearest) * p.wavelength);
}

/// Cells with grooves between them.
double cells(const Place& p)
{
    return clamped((p.next - p.nearest) / 0.35);
}

/// Blocks with a gap between them.
double cell_tops(const Place& p)
{
    return clamped(0.5 * (p.next - p.nearest) * p.wavelength - 0.5);
}

double letters(const Place& p)
{
    return step_down(0.11, p);
}

/// On which body a relief is; see ReliefKind.
struct Variant {
    Body body;
    Lattice lattice;
    double wavelength;
    double height;
    double angle = 0.0;
    double share = 1.0;
};

struct Variants {
    const char* name;
    Relief relief;
    std::vector<Variant> variants;
};

std::vector<Variants> waves()
{
    using enum Body;
    using enum Lattice;
    return {
        {"egg crate",
         {egg_crate},
         {{Plate, Square, 3, 0.2}, {Plate, Jittered, 8, 0.6, 17}, {Torus, Square, 6, 0.4}, {Tube, Jittered, 5, 0.4}}},
        {"corrugations",
         {corrugations},
         {{Plate, Square, 8, 1, 17}, {Tube, Jittered, 10, 1.2}, {Torus, Square, 5, 0.5}, {Plate, Jittered, 4, 0.2}}},
        {"corduroy", {corduroy}, {{Plate, Square, 6, 0.5}, {Tube, Hexagonal, 4, 0.3}}},
        {"ribs",
         {ribs},
         {{Tube, Square, 12, 1}, {Plate, Jittered, 6, 0.6}, {Plate, Square, 10, 1, 17}, {Tube, Square, 8, 1, 0, 0.7}}},
        {"grooves", {grooves}, {{Plate, Jittered, 8, 0.5, 17}}},
        {"fins",
         {fins},
         {{Plate, Square, 6, 2}, {Plate, Jittered, 8, 1, 17}, {Tube, Square, 7, 1.5}, {Tube, Hexagonal, 6, 1, 0, 0.5}}},
        {"knurl",
         {knurl},
         {{Plate, Square, 5, 1},
          {Plate, Jittered, 10, 1.5, 17},
          {Tube, Jittered, 6, 0.8},
          {Torus, Square, 10, 1},
          {Tube, Hexagonal, 8, 1, 0, 0.5}}},
        {"thread", {thread}, {{Tube, Square, 8, 1, 9}, {Tube, Jittered, 10, 1.5, 12}, {Tube, Square, 5, 0.6, 6, 0.7}}},
        {"gyroid", {gyroid}, {{Ball, Square, 6, 0.3}, {Ball, Square, 9, 0.5}, {Torus, Jittered, 8, 0.5}}},
        {"rings", {rings}, {{Ball, Square, 8, 0.5}, {Ball, Square, 6, 0.3, 0, 0.5}}},
        {"weave",
         {weave},
         {{Plate, Square, 8, 0.6}, {Plate, Jittered, 10, 0.8, 17}, {Tube, Jittered, 9, 0.7}, {Torus, Square, 16, 1}}},
    };
}

std::vector<Variants> blocks_and_centres()
{
    using enum Body;
    using enum Lattice;
    return {
        {"bricks",
         {bricks},
         {{Plate, Square, 8, 0.5},
          {Plate, Jittered, 12, 0.7, 17},
          {Tube, Square, 12, 0.4},
          {Torus, Jittered, 16, 0.6}}},
        {"tiles", {tiles}, {{Plate, Square, 8, 0.7}, {Plate, Jittered, 10, 1, 17}, {Tube, Square, 12, 1}}},
        {"squares",
         {squares},
         {{Plate, Jittered, 5.6, 1}, {Plate, Jittered, 11, 1.6}, {Plate, Square, 8, 1.5, 17}, {Tube, Square, 9, 1}}},
        {"studs",
         {studs, Centres::Square},
         {{Plate, Square, 12, 1}, {Plate, Jittered, 8, 0.5, 17}, {Torus, Jittered, 10, 1}, {Ball, Square, 10, 0.7}}},
        {"dimples",
         {dimples, Centres::Square},
         {{Ball, Square, 10, 0.5},
          {Ball, Square, 5, 0.3},
          {Plate, Square, 5, 0.4, 17},
          {Ball, Square, 8, 0.4, 0, 0.7}}},
        {"honeycomb",
         {walls, Centres::Hexagonal},
         {{Plate, Square, 8, 0.7}, {Plate, Jittered, 10, 1, 17}, {Tube, Jittered, 12, 1}}},
        {"hammer marks",
         {hammered, Centres::Irregular},
         {{Plate, Square, 8, 0.6}, {Plate, Jittered, 6, 0.4}, {Ball, Square, 8, 0.5}, {Tube, Jittered, 10, 0.7}}},
        {"leather", {cells, Centres::Irregular}, {{Plate, Square, 8, 0.5}, {Ball, Square, 10, 0.6}}},
        {"pebbles",
         {pebbles, Centres::Irregular},
         {{Plate, Jittered, 7, 0.4}, {Ball, Square, 8, 0.6}, {Torus, Square, 10, 0.8}}},
        {"letters",
         {letters, Centres::Strokes},
         {{Plate, Square, 12, 1}, {Plate, Jittered, 16, 1, 17}, {Tube, Jittered, 12, 0.7}}},
        {"hexagonal studs",
         {cell_tops, Centres::Hexagonal},
         {{Plate, Hexagonal, 8, 0.8, 17}, {Torus, Square, 10, 0.7}}},
    };
}

}  // namespace

std::span<const ReliefKind> relief_kinds()
{
    static const std::vector<ReliefKind> kinds = [] {
        std::vector<ReliefKind> all;
        for (const std::vector<Variants>& group : {waves(), blocks_and_centres()})
            for (const auto& [name, relief, variants] : group)
                for (const Variant& variant : variants)
                    all.push_back({name, relief, variant.body, variant.lattice, variant.wavelength, variant.height,
                                   variant.angle, variant.share});
        return all;
    }();
    return kinds;
}

}  // namespace seamflow::test
