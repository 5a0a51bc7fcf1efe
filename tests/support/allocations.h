#pragma once

namespace seamflow::test {

/// How often operator new has been called; a program that asks counts from its start on.
long n_allocations();

}  // namespace seamflow::test
