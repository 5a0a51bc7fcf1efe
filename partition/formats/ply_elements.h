#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "partition/formats/ply_header.h"
#include "partition/formats/ply_plain.h"
#include "partition/formats/ply_source.h"
#include "partition/io/mesh_builder.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

/// Reads the elements that follow the header, or those of a slice, in their order.
template <class Source>
class ElementReader {
  public:
    ElementReader(Source& source, const PlyHeader& header)
        : source_(source)
        , builder_(source.position())
        , n_vertices_(static_cast<std::int64_t>(header.element("vertex")->count))
    {
        const PlyElement* const faces = header.element("face");
        builder_.reserve(static_cast<std::uint64_t>(n_vertices_), faces != nullptr ? faces->count : 0);
    }

    /// Of a slice.
    /// @param n_vertices of the whole file.
    ElementReader(Source& source, Index n_vertices, const MeshSlice& slice)
        : source_(source)
        , builder_(source.position(), 0, slice)
        , n_vertices_(n_vertices)
    {
    }

    /// Reads the elements begin to end - 1 of a kind.
    void read(const PlyElement& element, std::uint64_t begin, std::uint64_t end);

    PolygonMesh finish()
    {
        source_.finish();
        return builder_.finish();
    }

  private:
    void read_property(const PlyProperty& property, PlyRole role);
    void read_corners(const PlyProperty& property);
    void add_strips();

    Source& source_;
    MeshBuilder builder_;
    std::int64_t n_vertices_;
    std::array<double, 3> point_{};
    std::vector<Index> corners_;
    /// In place of a corner.
    static constexpr Index end_of_strip = -2;
    bool ends_strips_ = false;
};

template <class Source>
void ElementReader<Source>::read(const PlyElement& element, std::uint64_t begin, std::uint64_t end)
{
    const std::vector<PlyRole> roles = roles_of(element);
    const bool is_vertex = element.name == "vertex";
    const bool is_face = element.name == "face";
    const bool are_strips = element.name == "tristrips";
    ends_strips_ = are_strips;
    for (std::uint64_t i = begin; i < end; ++i) {
        source_.begin_element(element, i);
        for (std::size_t p = 0; p < roles.size(); ++p)
            read_property(element.properties[p], roles[p]);
        source_.end_element();
        if (is_vertex)
            builder_.add_vertex(point_);
        else if (is_face)
            builder_.add_face(corners_);
        else if (are_strips)
            add_strips();
    }
}

template <class Source>
void ElementReader<Source>::read_property(const PlyProperty& property, PlyRole role)
{
    switch (role) {
    case PlyRole::X:
    case PlyRole::Y:
    case PlyRole::Z:
        point_[static_cast<std::size_t>(role)] = source_.real(property.type);
        break;
    case PlyRole::Corners:
        read_corners(property);
        break;
    case PlyRole::Other:
        pass_over(source_, property);
        break;
    }
}

template <class Source>
void ElementReader<Source>::read_corners(const PlyProperty& property)
{
    corners_.clear();
    for (std::int64_t n = read_length(source_, property); n > 0; --n)
        if (const std::int64_t v = source_.integer(property.type); ends_strips_ && v == -1)
            corners_.push_back(end_of_strip);
        else
            corners_.push_back(builder_.vertex(v, n_vertices_));
}

/// Every vertex of a strip except the first two forms a triangle with the two before it, every other one reversed.
/// Those that name a vertex twice join strips, and are skipped.
template <class Source>
void ElementReader<Source>::add_strips()
{
    std::size_t begin = 0;
    for (std::size_t k = 0; k < corners_.size(); ++k) {
        if (corners_[k] == end_of_strip)
            begin = k + 1;
        if (k < begin + 2)
            continue;
        std::array<Index, 3> triangle{corners_[k - 2], corners_[k - 1], corners_[k]};
        if ((k - begin) % 2 == 1)
            std::swap(triangle[0], triangle[1]);
        if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
            builder_.add_face(triangle);
    }
}

/// Checks that the elements of a file are a surface that can be read.
/// @param scanner stands at the last line of the header.
/// @throws InputError naming the line.
void require_surface(const TextScanner& scanner, const PlyHeader& header);

}  // namespace seamflow
