#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace seamflow {

/// Asks the system for large pages for memory that has not been touched yet. It may ignore this, and does nothing for
/// less than such a page. To touch memory in small pages for the first time takes longer than to copy it, and large
/// pages are found faster later on. Neighbouring arrays may share a large page.
void prefer_large_pages(void* memory, std::size_t n_bytes);

/// Makes room for n values, in large pages where the system has them.
template <class Value>
void reserve_large(std::vector<Value>& values, std::size_t n)
{
    if (n <= values.capacity())
        return;
    values.reserve(n);
    prefer_large_pages(values.data(), values.capacity() * sizeof(Value));
}

/// n equal values, in large pages where the system has them.
template <class Value>
std::vector<Value> large_vector(std::size_t n, const Value& value = Value())
{
    std::vector<Value> values;
    reserve_large(values, n);
    values.resize(n, value);
    return values;
}

/// n values that are still to be set, in large pages where the system has them: touched by the threads that fill them,
/// not by the one that allocates them.
template <class Value>
std::unique_ptr<Value[]> uninitialised(std::size_t n)
{
    auto values = std::make_unique_for_overwrite<Value[]>(n);
    prefer_large_pages(values.get(), n * sizeof(Value));
    return values;
}

}  // namespace seamflow
