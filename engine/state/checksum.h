#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

struct XXH3_state_s;

namespace seamflow {

/// A checksum of a sequence of bytes (XXH3 of xxHash, 64 bits). Different sequences agree once in 2⁶⁴. The portions in
/// which bytes are added do not matter. It does not protect against tampering.
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
