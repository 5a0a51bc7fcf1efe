#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

struct XXH3_state_s;

namespace seamflow {

/// A checksum of a sequence of bytes (XXH3 of xxHash, 64 bits). Two different sequences have the same checksum with
/// probability 2⁻⁶⁴. The division of the bytes into calls does not matter. No protection against tampering.
class Checksum {
  public:
    /// @throws std::bad_alloc
    Checksum();

    void add(std::span<const std::byte> bytes);

    [[nodiscard]] std::uint64_t value() const;

  private:
    struct FreeState {
        void operator()(XXH3_state_s* state) const;
    };
    std::unique_ptr<XXH3_state_s, FreeState> state_;
};

}  // namespace seamflow
