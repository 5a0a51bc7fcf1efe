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
    /// Where it does not hold, why, as far as it is known; else empty.
    std::string why = {};
};

/// What the paper's words are taken to mean where they leave it open. Lengths in mean edge lengths.
struct ClaimLimits {
    /// "Small distances", "good outcomes": up to this V_mean a vertex is on average closer to its counterpart than to
    /// any other vertex, ...
    double close_vertices = 0.5;
    /// ... and up to this H_mean the surfaces are, by the same factor, closer than half of that.
    double close_surfaces = 0.25;
    /// "Hard to distinguish": up to this V_mean. In the paper's picture of 60 by 60 faces an edge is about 0.6 mm.
    double alike = 0.25;
    /// "Tangential shifts": the drift is so many times that of the Laplacians that are said to have none.
    double drags = 2.0;
    /// "Significant artifacts", "much slower": how many times larger Schwarz's V_mean is than Robin's. The authors'
    /// code gives 18 for Δ_F.
    double delays = 10.0;
    double delays_velho = 5.0;
    /// "Artifacts": the roughness is more than so many times that of the input; "performs well": it is not.
    double artifacts = 2.0;
    /// "Spiky": degrees of roughness. Neighbouring triangles stand at this angle to each other then.
    double spiky = 45.0;
};

/// What the paper says about the figure of that name, and whether it holds in its table.
std::vector<Claim> claims_of(const Table& table, const ClaimLimits& limits = {});

/// Of the tables with 2 to 32 sub-meshes, which the paper does not have: the library's defaults against the plain
/// method.
std::vector<Claim> claims_of_many(const std::vector<Table>& tables, const ClaimLimits& limits = {});

/// Writes figure, claim, measured, holds (yes or no), why as CSV.
/// @throws OutputError naming the file.
void write_claims(const std::filesystem::path& path, const std::vector<Claim>& claims);

/// Two lines for each, a third where it does not hold.
void print_claims(std::ostream& out, const std::vector<Claim>& claims);

}  // namespace seamflow
