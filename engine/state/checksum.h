#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace seamflow {

/// A checksum of a sequence of bytes. Sequences that differ in eight successive bytes alone always have different
/// checksums; others have equal ones once in 2⁶⁴. The portions in which bytes are added do not matter. It does not
/// protect against intent.
class Checksum {
  public:
    void add(std::span<const std::byte> bytes);

    /// The bytes of an array of numbers.
    template <class Number>
    void add_numbers(std::span<const Number> numbers)
    {
        add(std::as_bytes(numbers));
    }

    [[nodiscard]] std::uint64_t value() const;

  private:
    void mix(std::uint64_t word);

    std::uint64_t state_ = 0x9e3779b97f4a7c15;
    std::uint64_t n_bytes_ = 0;
    /// Fewer bytes than a word that have been added last.
    std::byte rest_[8] = {};
    std::size_t n_rest_ = 0;
};

}  // namespace seamflow
