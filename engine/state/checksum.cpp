#include "engine/state/checksum.h"

#include <algorithm>
#include <cstring>

namespace seamflow {

/// Each part of it is a bijection, of the word and of the state.
void Checksum::mix(std::uint64_t word)
{
    state_ = (state_ ^ word) * 0xd6e8feb86659fd93;
    state_ ^= state_ >> 32;
}

void Checksum::add(std::span<const std::byte> bytes)
{
    n_bytes_ += bytes.size();
    while (!bytes.empty()) {
        if (n_rest_ == 0) {
            for (; bytes.size() >= sizeof rest_; bytes = bytes.subspan(sizeof rest_)) {
                std::uint64_t word = 0;
                std::memcpy(&word, bytes.data(), sizeof word);
                mix(word);
            }
        }
        const std::size_t n = std::min(sizeof rest_ - n_rest_, bytes.size());
        std::copy_n(bytes.data(), n, rest_ + n_rest_);
        n_rest_ += n;
        bytes = bytes.subspan(n);
        if (n_rest_ == sizeof rest_) {
            std::uint64_t word = 0;
            std::memcpy(&word, rest_, sizeof word);
            mix(word);
            n_rest_ = 0;
        }
    }
}

std::uint64_t Checksum::value() const
{
    Checksum end = *this;
    std::uint64_t word = 0;
    std::memcpy(&word, rest_, n_rest_);
    end.mix(word);
    end.mix(n_bytes_);
    end.mix(0);
    return end.state_;
}

}  // namespace seamflow
