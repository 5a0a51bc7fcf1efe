#include "engine/state/checkpoint.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/state/checksum.h"
#include "partition/errors.h"
#include "partition/io/output_file.h"

// A file is: the line below; the format, which reads differently on machines of another byte order; the parts of the
// state in the order of `transfer`, arrays after their sizes; the checksum of all that.

namespace seamflow {

namespace {

constexpr std::string_view first_line = "seamflow checkpoint\n";
/// To be raised whenever `transfer` or the checksum changes.
constexpr std::uint32_t format = 0x5ea30004;
constexpr std::size_t n_checksum_bytes = sizeof(std::uint64_t);

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason)
{
    throw InputError(file.string() + ": " + reason + "; remove it to begin anew");
}

/// Puts parts into a file.
class Writer {
  public:
    explicit Writer(const std::filesystem::path& path)
        : file_(path)
    {
    }

    template <class Number>
    void numbers(std::span<const Number> numbers)
    {
        const auto bytes = std::as_bytes(numbers);
        checksum_.add(bytes);
        file_.text({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }

    template <class Number>
    void number(const Number& number)
    {
        numbers(std::span<const Number>(&number, 1));
    }

    template <class Array>
    void size(const Array& array)
    {
        number(static_cast<std::uint64_t>(array.size()));
    }
    void size(const Points& points) { number(static_cast<std::uint64_t>(points.rows())); }
    template <class Value>
    void size(const std::optional<Value>& value)
    {
        number(static_cast<std::uint64_t>(value ? 1 : 0));
    }

    void commit()
    {
        number(checksum_.value());
        file_.commit();
    }

  private:
    OutputFile file_;
    Checksum checksum_;
};

/// Takes parts out of a file. An array takes no more memory than the length of the file allows, whatever size is
/// written there.
class Reader {
  public:
    /// @param n_bytes what there is except for the checksum.
    Reader(const std::filesystem::path& path, std::uint64_t n_bytes)
        : path_(path)
        , file_(path, std::ios::binary)
        , n_left_(n_bytes)
    {
    }

    template <class Number>
    void numbers(std::span<Number> numbers)
    {
        const auto bytes = std::as_writable_bytes(numbers);
        if (bytes.size() > n_left_)
            refuse(path_, "ends too early");
        n_left_ -= bytes.size();
        if (!file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
            refuse(path_, "cannot be read");
    }

    template <class Number>
    void number(Number& number)
    {
        numbers(std::span(&number, 1));
    }

    template <class Array>
    void size(Array& array)
    {
        using Value = typename Array::value_type;
        array.resize(read_size(std::is_arithmetic_v<Value> ? sizeof(Value) : least_bytes_of_struct));
    }
    void size(Points& points) { points.resize(static_cast<Eigen::Index>(read_size(3 * sizeof(double))), 3); }
    template <class Value>
    void size(std::optional<Value>& value)
    {
        if (read_size(1) > 0)
            value.emplace();
    }

    void require_end() const
    {
        if (n_left_ != 0)
            refuse(path_, "is longer than it should be");
    }

  private:
    static constexpr std::size_t least_bytes_of_struct = 16;

    std::size_t read_size(std::size_t bytes_each)
    {
        std::uint64_t n = 0;
        number(n);
        if (n > n_left_ / bytes_each)
            refuse(path_, "has an array that is longer than the file");
        return static_cast<std::size_t>(n);
    }

    std::filesystem::path path_;
    std::ifstream file_;
    std::uint64_t n_left_;
};

template <class Value, class Struct>
concept Is = std::is_same_v<std::remove_const_t<Value>, Struct>;

/// The fields of a struct: all of them, or the compiler complains. Of what is no struct of a state, nothing.
template <class Struct>
auto fields([[maybe_unused]] Struct& of)
{
    if constexpr (Is<Struct, FlowIdentity::Entry>) {
        auto& [name, value] = of;
        return std::tie(name, value);
    } else if constexpr (Is<Struct, FlowIdentity>) {
        auto& [entries] = of;
        return std::tie(entries);
    } else if constexpr (Is<Struct, LengthStatistics>) {
        auto& [mean, rms, max] = of;
        return std::tie(mean, rms, max);
    } else if constexpr (Is<Struct, DisplacementStatistics>) {
        auto& [tangential, normal] = of;
        return std::tie(tangential, normal);
    } else if constexpr (Is<Struct, VertexDistance>) {
        auto& [mean, rms, max, mean_edge] = of;
        return std::tie(mean, rms, max, mean_edge);
    } else if constexpr (Is<Struct, StepReport>) {
        auto& [seconds, curvature_before, curvature_after, displacement, gap, iterations, residual, estimated, distance,
               surface_distance, reference_seconds] = of;
        return std::tie(seconds, curvature_before, curvature_after, displacement, gap, iterations, residual, estimated,
                        distance, surface_distance, reference_seconds);
    } else if constexpr (Is<Struct, PhaseSeconds>) {
        auto& [cut, analyse, assemble, factorise, solve, correct, interface, step, total] = of;
        return std::tie(cut, analyse, assemble, factorise, solve, correct, interface, step, total);
    } else if constexpr (Is<Struct, DisplacementSums>) {
        auto& [drift, tangential, normal] = of;
        return std::tie(drift, tangential, normal);
    } else if constexpr (Is<Struct, StepMemory>) {
        auto& [positions, arrays, numbers] = of;
        return std::tie(positions, arrays, numbers);
    } else if constexpr (Is<Struct, FlowState>) {
        auto& [identity, approach, cut, steps, seconds, displacement, flow, reference] = of;
        return std::tie(identity, approach, cut, steps, seconds, displacement, flow, reference);
    }
}

template <class Value>
concept HasFields = !std::is_void_v<decltype(fields(std::declval<Value&>()))>;

template <class Value>
concept IsOptional = requires(Value& value)
{
    value.has_value();
};

template <class Value>
concept HasNumbers =
    Is<Value, Points> || Is<Value, std::string> || Is<Value, std::vector<double>> || Is<Value, std::vector<Index>>;

/// Both ways: values are const where they are written.
template <class Archive, class Value>
void transfer(Archive& archive, Value& value)
{
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
        archive.number(value);
    } else if constexpr (HasFields<Value>) {
        std::apply([&](auto&... field) { (transfer(archive, field), ...); }, fields(value));
    } else {
        archive.size(value);
        if constexpr (HasNumbers<Value>)
            archive.numbers(std::span(value.data(), static_cast<std::size_t>(value.size())));
        else if constexpr (IsOptional<Value>) {
            if (value)
                transfer(archive, *value);
        } else
            for (auto& element : value)
                transfer(archive, element);
    }
}

/// Checks the frame of a file.
/// @returns how many bytes there are before the checksum.
std::uint64_t require_whole(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file)
        throw InputError(path.string() + ": cannot be opened");
    const auto n_bytes = static_cast<std::uint64_t>(std::max<std::streamoff>(file.tellg(), 0));
    file.seekg(0);
    std::vector<char> portion(std::size_t{1} << 20);
    const auto read = [&](std::uint64_t n) {
        const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(n, portion.size()));
        if (!file.read(portion.data(), static_cast<std::streamsize>(wanted)))
            refuse(path, "cannot be read");
        return std::as_bytes(std::span(portion).first(wanted));
    };
    const std::uint64_t n_frame = first_line.size() + sizeof format + n_checksum_bytes;
    if (n_bytes < n_frame || std::string_view(portion.data(), read(first_line.size()).size()) != first_line)
        refuse(path, "is no checkpoint, or only the beginning of one");
    Checksum checksum;
    checksum.add(std::as_bytes(std::span(first_line)));
    const auto read_number = [&](auto& number) { std::memcpy(&number, read(sizeof number).data(), sizeof number); };
    std::uint32_t format_there = 0;
    read_number(format_there);
    if (format_there != format)
        refuse(path, "was written by another version of this program, or on a machine of another kind");
    checksum.add_numbers(std::span<const std::uint32_t>(&format_there, 1));
    for (std::uint64_t left = n_bytes - n_frame; left > 0;) {
        const auto bytes = read(left);
        checksum.add(bytes);
        left -= bytes.size();
    }
    std::uint64_t checksum_there = 0;
    read_number(checksum_there);
    if (checksum_there != checksum.value())
        refuse(path, "is damaged: it is not as it was written");
    return n_bytes - n_checksum_bytes;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const FlowState& state)
{
    Writer writer(file);
    writer.numbers(std::span(first_line));
    writer.number(format);
    transfer(writer, state);
    writer.commit();
}

FlowState read_checkpoint(const std::filesystem::path& file)
{
    Reader reader(file, require_whole(file));
    std::string line(first_line.size(), ' ');
    std::uint32_t format_there = 0;
    reader.numbers(std::span(line));
    reader.number(format_there);
    FlowState state;
    transfer(reader, state);
    reader.require_end();
    return state;
}

}  // namespace seamflow
