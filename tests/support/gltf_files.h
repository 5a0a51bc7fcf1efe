#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace seamflow::test {

/// The bytes of numbers, little-endian.
template <class Number>
std::string bytes_of(const std::vector<Number>& numbers)
{
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

/// Puts together a glTF file of one buffer, with a view for each accessor unless told.
class GltfMaker {
  public:
    /// Bytes of a view of their own.
    /// @param others of its members, such as "\"byteStride\":24".
    /// @returns its number.
    int view(std::string_view bytes, const std::string& others = "");

    /// @param view -1: none. @param others of its members, such as "\"min\":[0]".
    /// @returns its number.
    int accessor(int view, int component, int count, const std::string& type, const std::string& others = "");

    /// Vectors of three floats, with their bounds.
    int vectors(const std::vector<float>& numbers);

    int indices(const std::vector<unsigned char>& numbers) { return scalars(numbers, 5121); }
    int indices(const std::vector<unsigned short>& numbers) { return scalars(numbers, 5123); }
    int indices(const std::vector<unsigned int>& numbers) { return scalars(numbers, 5125); }

    /// The member of an accessor that replaces some of its elements.
    /// @param indices of these. @param values by which.
    template <class Number>
    std::string sparse(const std::vector<Number>& indices, const std::vector<float>& values)
    {
        const int first = view(bytes_of(indices));
        return sparse(first, sizeof(Number), indices.size(), view(bytes_of(values)));
    }

    /// Begins a mesh of these primitives, each an object in JSON.
    void mesh(std::initializer_list<std::string> primitives);

    /// Members of the whole text besides the meshes and what they need, such as "\"nodes\":[]".
    std::string more = {};

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

    /// The JSON text.
    /// @param uri of the buffer; empty: it is the binary chunk.
    [[nodiscard]] std::string text(const std::string& uri = "") const;
    [[nodiscard]] std::string glb() const { return glb(text(), bytes_); }

    /// A binary file of a text and bytes.
    static std::string glb(std::string text, std::string bytes);

  private:
    template <class Number>
    int scalars(const std::vector<Number>& numbers, int component)
    {
        return accessor(view(bytes_of(numbers)), component, static_cast<int>(numbers.size()), "SCALAR");
    }

    static std::string sparse(int indices, std::size_t width, std::size_t count, int values);

    std::string bytes_;
    std::string views_;
    std::string accessors_;
    std::string meshes_;
    int n_views_ = 0;
    int n_accessors_ = 0;
};

}  // namespace seamflow::test
