#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "partition/polygon_mesh.h"

namespace seamflow {

/// A set of integers, and their places in ascending order. It takes three bits for every number between the least and
/// the largest of them.
template <class Number>
class NumberSet {
  public:
    /// @param numbers in any order, possibly repeated.
    explicit NumberSet(const std::vector<Number>& numbers)
    {
        if (numbers.empty())
            return;
        const auto [least, largest] = std::ranges::minmax(numbers);
        least_ = least;
        words_.resize(static_cast<std::size_t>((largest - least) / bits) + 1, 0);
        for (const Number number : numbers)
            words_[word_of(number)] |= bit_of(number);
        for (const std::uint64_t word : words_) {
            n_before_.push_back(size_);
            size_ += std::popcount(word);
        }
    }

    [[nodiscard]] Index size() const { return size_; }

    /// Ascending.
    [[nodiscard]] std::vector<Number> numbers() const
    {
        std::vector<Number> all;
        all.reserve(static_cast<std::size_t>(size_));
        for (std::size_t w = 0; w < words_.size(); ++w)
            for (std::uint64_t left = words_[w]; left != 0; left &= left - 1)
                all.push_back(least_ + static_cast<Number>(w) * bits + std::countr_zero(left));
        return all;
    }

    /// @param number one of the set.
    [[nodiscard]] Index place_of(Number number) const
    {
        const std::size_t w = word_of(number);
        return n_before_[w] + std::popcount(words_[w] & (bit_of(number) - 1));
    }

  private:
    static constexpr int bits = 64;

    [[nodiscard]] std::size_t word_of(Number number) const { return static_cast<std::size_t>(number - least_) / bits; }
    [[nodiscard]] std::uint64_t bit_of(Number number) const
    {
        return std::uint64_t{1} << static_cast<std::size_t>(number - least_) % bits;
    }

    Number least_ = 0;
    std::vector<std::uint64_t> words_;
    /// The count of numbers in lower words.
    std::vector<Index> n_before_;
    Index size_ = 0;
};

}  // namespace seamflow
