#pragma once

/// Whether mutant `number` is the one that runs: the one that the environment variable SEAMFLOW_MUTANT names, read
/// once. The first call with a number appends it as a line to the file that SEAMFLOW_MUTANTS_REACHED names, if it names
/// one.
///
/// Every source of the mutated copy of the tree includes this first; see tests/mutants/run.sh.
[[nodiscard]] bool seamflow_mutant(int number) noexcept;
