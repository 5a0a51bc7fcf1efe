#include "engine/state/checksum.h"

#include <new>

#include <xxhash.h>

namespace seamflow {

void Checksum::FreeState::operator()(XXH3_state_s* state) const
{
    XXH3_freeState(state);
}

Checksum::Checksum()
    : state_(XXH3_createState())
{
    if (state_ == nullptr)
        throw std::bad_alloc();
    XXH3_64bits_reset(state_.get());
}

void Checksum::add(std::span<const std::byte> bytes)
{
    XXH3_64bits_update(state_.get(), bytes.data(), bytes.size());
}

std::uint64_t Checksum::value() const
{
    return XXH3_64bits_digest(state_.get());
}

}  // namespace seamflow
