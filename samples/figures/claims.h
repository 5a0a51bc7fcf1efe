#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "samples/figures/table.h"

namespace seamflow {

/// Something that the paper says about a figure, as an inequality between numbers of its table.
struct Claim {
    std::string figure;
    /// In words, with the inequality that it is taken to mean.
    std::string text;
    /// The numbers that decide.
    std::string measured;
    /// False also where a number is missing, because a flow ended before its time.
    bool holds = false;
};

/// What "close" and "more" are taken to mean where the paper's words leave it open. Lengths in mean edge lengths.
struct ClaimLimits {
    /// Mean distance of vertices, and of surfaces, up to which two meshes count as close: half an edge, and a tenth.
    double close_vertices = 0.5;
    double close_surfaces = 0.1;
    /// Mean distance of vertices up to which two meshes are hard to tell apart.
    double alike = 0.1;
    /// A Laplacian drags a texture if its drift is so many times that of those that do not.
    double drags = 3.0;
    /// How many times larger Schwarz's V_mean on the wavy cylinder is than Robin's.
    double delays = 10.0;
    /// Degrees of roughness beyond which a mesh counts as spiky.
    double spiky = 45.0;
};

/// What the paper says about the figure of that name, and whether it holds in its table.
std::vector<Claim> claims_of(const Table& table, const ClaimLimits& limits = {});

/// Of the tables with 2 to 32 sub-meshes, which the paper does not have: the library's defaults against the plain
/// method.
std::vector<Claim> claims_of_many(const std::vector<Table>& tables, const ClaimLimits& limits = {});

/// Writes figure, claim, measured, holds (yes or no) as CSV.
/// @throws OutputError naming the file.
void write_claims(const std::filesystem::path& path, const std::vector<Claim>& claims);

/// A line or two for each.
void print_claims(std::ostream& out, const std::vector<Claim>& claims);

}  // namespace seamflow
