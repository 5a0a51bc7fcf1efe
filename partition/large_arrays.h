#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace seamflow {

/// Asks the system for large pages for memory that has not been touched yet. The system may ignore this, and does
/// nothing for memory smaller than such a page. Touching memory in small pages for the first time takes longer than
/// copying it, and large pages are faster to look up later. Neighbouring arrays may share a large page.
void prefer_large_pages(void* memory, std::size_t n_bytes);

/// Reserves memory for n values, in large pages where the system has them.
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

/// Resizes a matrix of Eigen, in large pages where the system has them; no entry is initialised. A matrix that has this
/// size already stays as it is.
template <class Matrix>
void resize_large(Matrix& matrix, std::ptrdiff_t rows, std::ptrdiff_t columns)
{
    if (matrix.rows() == rows && matrix.cols() == columns)
        return;
    matrix.resize(rows, columns);
    prefer_large_pages(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(typename Matrix::Scalar));
}

/// Memory for n uninitialised values, in large pages where the system has them, touched first by the threads that fill
/// it.
template <class Value>
std::unique_ptr<Value[]> uninitialised(std::size_t n)
{
    auto values = std::make_unique_for_overwrite<Value[]>(n);
    prefer_large_pages(values.get(), n * sizeof(Value));
    return values;
}

}  // namespace seamflow
