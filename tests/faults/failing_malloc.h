#pragma once

namespace seamflow::test {

/// Whether FailingAllocation reaches malloc, too, and live_blocks is known: not where a sanitizer has its own.
bool has_failing_malloc();

/// How many of the blocks that this program, METIS and SuiteSparse have taken from the heap have not been given back.
long live_blocks();

}  // namespace seamflow::test
