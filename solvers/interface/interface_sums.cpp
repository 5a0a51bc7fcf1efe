#include "solvers/interface/interface_sums.h"

#include <algorithm>

namespace seamflow {

void add_along_tree(std::vector<double>& rows, std::size_t width)
{
    const std::size_t n = width > 0 ? rows.size() / width : 0;
    for (std::size_t stride = 1; stride < n; stride *= 2)
        for (std::size_t s = 0; s + stride < n; s += 2 * stride)
            for (std::size_t i = 0; i < width; ++i)
                rows[s * width + i] += rows[(s + stride) * width + i];
}

InterfaceSums::InterfaceSums(const InterfaceCopies& copies)
    : copies_(&copies)
{
}

std::vector<Point> InterfaceSums::products(std::initializer_list<VectorPair> pairs, const Loop& loop)
{
    const std::size_t width = 3 * pairs.size();
    rows_.resize(at(copies_->n_sub_meshes()) * width);
    for_each(loop, copies_->n_sub_meshes(), [&](Index s) {
        double* row = rows_.data() + at(s) * width;
        for (const auto& [a, b] : pairs) {
            Point sum = Point::Zero();
            for (Index v = copies_->first_vertex[s]; v < copies_->first_vertex[s + 1]; ++v)
                sum += a.row(v).cwiseProduct(b.row(v));
            std::copy(sum.data(), sum.data() + 3, row);
            row += 3;
        }
    });
    if (rows_.empty())
        rows_.assign(width, 0.0);
    add_along_tree(rows_, width);
    std::vector<Point> sums;
    for (std::size_t i = 0; i < width; i += 3)
        sums.emplace_back(rows_[i], rows_[i + 1], rows_[i + 2]);
    return sums;
}

}  // namespace seamflow
