#pragma once

#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/distributed/ranks/transport.h"

/// Converts values to bytes and back. All ranks have the same byte order: one run uses one kind of machine.
namespace seamflow {

/// Appends values.
class Packer {
  public:
    template <class Value>
    requires std::is_trivially_copyable_v<Value>
    void put(const Value& value) { put_bytes(&value, sizeof(Value)); }

    /// Their number, then the values.
    template <class Value>
    requires std::is_trivially_copyable_v<Value>
    void put_all(std::span<const Value> values)
    {
        put(values.size());
        put_bytes(values.data(), values.size_bytes());
    }

    /// Three coordinates.
    void put_row(const double* coordinates) { put_bytes(coordinates, 3 * sizeof(double)); }

    /// Moves out what was put.
    [[nodiscard]] Bytes take() { return std::move(bytes_); }

    void reserve(std::size_t n_bytes) { bytes_.reserve(n_bytes); }

  private:
    void put_bytes(const void* values, std::size_t size)
    {
        const auto* const begin = static_cast<const std::byte*>(values);
        bytes_.insert(bytes_.end(), begin, begin + size);
    }

    Bytes bytes_;
};

/// Takes values in the order in which they were put.
class Unpacker {
  public:
    /// @param bytes must outlive this.
    explicit Unpacker(const Bytes& bytes)
        : left_(bytes)
    {
    }

    template <class Value>
    [[nodiscard]] Value get()
    {
        Value value;
        get_bytes(&value, sizeof(Value));
        return value;
    }

    template <class Value>
    [[nodiscard]] std::vector<Value> get_all()
    {
        std::vector<Value> values;
        append_all(values);
        return values;
    }

    template <class Value>
    void append_all(std::vector<Value>& values)
    {
        const auto n = get<std::size_t>();
        if (n > left_.size() / sizeof(Value))
            throw std::logic_error("a message is shorter than it says");
        values.resize(values.size() + n);
        get_bytes(values.data() + (values.size() - n), n * sizeof(Value));
    }

    [[nodiscard]] bool is_at_end() const { return left_.empty(); }

  private:
    void get_bytes(void* values, std::size_t size)
    {
        if (size > left_.size())
            throw std::logic_error("a message is shorter than it should be");
        if (size > 0)
            std::memcpy(values, left_.data(), size);
        left_ = left_.subspan(size);
    }

    std::span<const std::byte> left_;
};

/// Bytes of one list of values.
template <class Value>
Bytes packed(std::span<const Value> values)
{
    Packer packer;
    packer.reserve(sizeof(std::size_t) + values.size_bytes());
    packer.put_all(values);
    return packer.take();
}

template <class Value>
Bytes packed(const std::vector<Value>& values)
{
    return packed(std::span<const Value>(values));
}

/// The list of values that packed() was given.
template <class Value>
std::vector<Value> unpacked(const Bytes& bytes)
{
    return Unpacker(bytes).get_all<Value>();
}

}  // namespace seamflow
