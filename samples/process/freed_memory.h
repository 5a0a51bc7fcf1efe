#pragma once

namespace seamflow {

/// Returns memory that was freed to the system. The C library keeps much of it for later, where it lies between memory
/// still in use.
void return_freed_memory();

}  // namespace seamflow
