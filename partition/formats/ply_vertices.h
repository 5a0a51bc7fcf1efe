#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "partition/formats/ply_header.h"
#include "partition/formats/ply_slices.h"
#include "partition/formats/ply_source.h"
#include "partition/index.h"
#include "partition/io/fault_log.h"
#include "partition/io/slices.h"
#include "partition/io/text_scanner.h"

namespace seamflow {

/// Calls `act(v)` for each vertex of a slice, and passes over the other elements before it.
/// @param source stands at the beginning of the slice.
template <class Source>
void for_each_vertex(Source& source, const PlyHeader& header, const PlySlice& slice, const auto& act)
{
    const PlyElement* const vertices = header.element("vertex");
    for_each_kind(std::span(header.elements.data(), vertices + 1), slice,
                  [&](const PlyElement& element, std::uint64_t begin, std::uint64_t end) {
                      for (std::uint64_t i = begin; i < end; ++i)
                          if (&element != vertices)
                              pass_over(source, element, i);
                          else
                              act(static_cast<Index>(i));
                  });
}

/// A file that has been read without fault, cut into slices of elements up to its last vertex.
class PlyVertexSlices {
  public:
    /// @param path for messages only. @param content the whole file. @param after_header stands at the last line of the
    ///        header. All must outlive this object.
    PlyVertexSlices(const std::filesystem::path& path, std::string_view content, const PlyHeader& header,
                    const TextScanner& after_header, const Slicing& slicing)
        : path_(path)
        , content_(content)
        , header_(header)
        , after_header_(after_header)
        , slices_(slice_ply(content, after_header, header.encoding,
                            std::span(header.elements.data(), header.element("vertex") + 1), slicing))
        , crosses_lines_(header.encoding == Encoding::Ascii && slices_.back().end != header.n_elements())
    {
        if (crosses_lines_)
            slices_ = {{0, header.n_elements(), after_header.rest()}};
    }

    [[nodiscard]] Index count() const { return static_cast<Index>(slices_.size()); }
    [[nodiscard]] const PlySlice& operator[](Index i) const { return slices_[at(i)]; }

    /// What follows the last slice.
    [[nodiscard]] std::string_view rest() const
    {
        const std::string_view last = slices_.back().bytes;
        return content_.substr(static_cast<std::size_t>(last.data() - content_.data()) + last.size());
    }

    /// Calls `act` with the source of a slice, which passes over the faults that the reader has accepted. The lines in
    /// its messages are right if there is one slice.
    auto with_source(Index i, const auto& act) const
    {
        FaultLog known_faults{.of_faces_alone = true};
        const auto act_on = [&](auto source) {
            source.note_faults_in(&known_faults);
            return act(source);
        };
        const std::string_view bytes = slices_[at(i)].bytes;
        if (header_.encoding != Encoding::Ascii)
            return act_on(PlyBinarySource(path_, content_, static_cast<std::size_t>(bytes.data() - content_.data()),
                                          header_.encoding));
        TextScanner scanner(after_header_, bytes, after_header_.line());
        if (crosses_lines_)
            scanner.cross_lines();
        return act_on(PlyTextSource(scanner));
    }

  private:
    const std::filesystem::path& path_;
    std::string_view content_;
    const PlyHeader& header_;
    const TextScanner& after_header_;
    std::vector<PlySlice> slices_;
    bool crosses_lines_;
};

}  // namespace seamflow
