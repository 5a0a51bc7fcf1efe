#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "samples/figures/claims.h"
#include "samples/figures/experiment.h"
#include "samples/figures/table.h"

namespace seamflow {

/// The results of a figure.
struct FigureResult {
    const Experiment* experiment = nullptr;
    Table table;
    std::vector<Claim> claims;
};

/// One page for all figures that were made, under their numbers in the paper, for any browser: pictures side by side in
/// the order of the paper, curves, the last step of every flow with its settings and command beside the authors'
/// numbers, and the paper's claims beside the measurements. It links to the files beside it.
/// @param with_pages whether each figure has a page of its own, FIGURE.html.
/// @param many claims about the tables with 2 to 32 sub-meshes. @param to_come the results still to come; empty: none.
/// @param remark a sentence above all figures; empty: none.
std::string index_html(const std::vector<FigureResult>& results, const std::vector<Claim>& many, bool with_pages,
                       const std::string& to_come = {}, const std::string& remark = {});

}  // namespace seamflow
