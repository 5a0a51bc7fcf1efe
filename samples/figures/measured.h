#pragma once

#include <string>
#include <vector>

#include "samples/figures/experiment.h"
#include "samples/figures/table.h"

namespace seamflow {

/// One of the numbers of a row.
using Quantity = double (*)(const Row&);

inline constexpr Quantity v_mean = [](const Row& row) { return row.v.mean; };
inline constexpr Quantity v_max = [](const Row& row) { return row.v.max; };
inline constexpr Quantity h_mean = [](const Row& row) { return row.h.mean; };
inline constexpr Quantity drift = [](const Row& row) { return row.drift; };
inline constexpr Quantity rough = [](const Row& row) { return row.roughness.rms; };
inline constexpr Quantity interface_length = [](const Row& row) { return row.interface_length; };

/// A value with its name.
struct Measured {
    std::string name;
    double value;
};

/// "Δ_F", "Δ_A" or "Δ_P".
std::string symbol_of(Laplacian laplacian);

/// The quantity of a flow (see Table::find) after a step; not a number if there is no such row.
double quantity(const Table& table, Laplacian laplacian, std::string_view conditions, int step, Quantity what);

/// The same after the last step for several Laplacians, each under its symbol.
std::vector<Measured> last_step(const Table& table, const std::vector<Laplacian>& laplacians,
                                std::string_view conditions, Quantity what);

/// "Δ_F 0.277, Δ_A 0.0241", with three significant digits; "none" for values that are not a number.
std::string listed(const std::vector<Measured>& values);

/// Whether all of them are numbers, and none is larger than a limit.
bool at_most(const std::vector<Measured>& values, double limit);

}  // namespace seamflow
