#pragma once

#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/ranks/transport.h"
#include "partition/polygon_mesh.h"
#include "partition/vector_area.h"

/// Converts values to bytes and back. All ranks have the same byte order: one run uses one kind of machine.
namespace seamflow {

/// Appends values to a message.
class Packer {
  public:
    template <class Value>
    requires std::is_trivially_copyable_v<Value>
    void put(const Value& value) { put_bytes(&value, sizeof(Value)); }

    /// Appends the number of some values, then the values.
    template <class Value>
    requires std::is_trivially_copyable_v<Value>
    void put_all(std::span<const Value> values)
    {
        put(values.size());
        put_bytes(values.data(), values.size_bytes());
    }

    /// Appends three coordinates.
    void put_row(const double* coordinates) { put_bytes(coordinates, 3 * sizeof(double)); }

    /// Appends the number of coordinates, three per row, then the coordinates of some rows.
    void put_rows(const Points& points, std::span<const Index> rows)
    {
        put(3 * rows.size());
        bytes_.reserve(bytes_.size() + 3 * rows.size() * sizeof(double));
        for (const Index row : rows)
            put_row(points.row(row).data());
    }
    /// Appends the number of coordinates, then the coordinates of all rows.
    void put_points(const Points& points)
    {
        put_all(std::span<const double>(points.data(), static_cast<std::size_t>(points.size())));
    }

    /// Moves the message out.
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

/// Reads values in the order in which they were appended.
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

    /// Reads a list of values, and appends them.
    template <class Value>
    void append_all(std::vector<Value>& values)
    {
        const std::size_t n = next_size(sizeof(Value));
        values.resize(values.size() + n);
        get_bytes(values.data() + (values.size() - n), n * sizeof(Value));
    }

    /// Reads the rows that put_rows or put_points has appended.
    [[nodiscard]] Points get_points()
    {
        Points points(static_cast<Eigen::Index>(next_size(sizeof(double)) / 3), 3);
        get_bytes(points.data(), static_cast<std::size_t>(points.size()) * sizeof(double));
        return points;
    }

    /// Reads rows into these rows of `points`; the message must have as many.
    void get_rows(Points& points, std::span<const Index> rows)
    {
        if (next_size(sizeof(double)) != 3 * rows.size())
            throw std::logic_error("a message has other rows than it should");
        for (const Index row : rows)
            get_bytes(points.row(row).data(), sizeof(Point));
    }

    [[nodiscard]] bool is_at_end() const { return left_.empty(); }

  private:
    /// Reads the number of the values that follow, and checks that the message is long enough.
    /// @param bytes_each the size of a value.
    std::size_t next_size(std::size_t bytes_each)
    {
        const auto n = get<std::size_t>();
        if (n > left_.size() / bytes_each)
            throw std::logic_error("a message is shorter than it says");
        return n;
    }

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

/// The bytes of one list of values.
template <class Value>
Bytes packed(const std::vector<Value>& values)
{
    Packer packer;
    packer.reserve(sizeof(std::size_t) + values.size() * sizeof(Value));
    packer.put_all(std::span<const Value>(values));
    return packer.take();
}

/// The list of values whose bytes packed() has returned.
template <class Value>
std::vector<Value> unpacked(const Bytes& bytes)
{
    return Unpacker(bytes).get_all<Value>();
}

}  // namespace seamflow
