#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "samples/figures/table.h"

namespace seamflow {

/// A statement of the paper about a figure, as an inequality between numbers of its table.
struct Claim {
    std::string figure;
    /// In words, with the inequality that it is taken to mean.
    std::string text;
    /// The numbers that decide whether it holds.
    std::string measured;
    /// False also where a number is missing, because a flow ended early.
    bool holds = false;
    /// If it does not hold, the reason, as far as it is known; else empty.
    std::string why = {};
};

/// The meaning of the paper's words where they leave it open. Lengths are in mean edge lengths.
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
    /// "Spiky": degrees of roughness. Neighbouring triangles are then at this angle to each other.
    double spiky = 45.0;
};

/// The paper's claims about the figure of a table, and whether they hold in the table.
std::vector<Claim> claims_of(const Table& table, const ClaimLimits& limits = {});

/// Claims about the tables with 2 to 32 sub-meshes, which the paper does not have: the library's defaults against the
/// plain method.
std::vector<Claim> claims_of_many(const std::vector<Table>& tables, const ClaimLimits& limits = {});

/// Writes figure, claim, measured, holds (yes or no), why as CSV.
/// @throws OutputError naming the file.
void write_claims(const std::filesystem::path& path, const std::vector<Claim>& claims);

/// Prints two lines for each, and a third if it does not hold.
void print_claims(std::ostream& out, const std::vector<Claim>& claims);

}  // namespace seamflow
