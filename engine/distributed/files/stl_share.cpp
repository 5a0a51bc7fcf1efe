#include "engine/distributed/files/stl_share.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/distributed/parts/stretches.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "partition/errors.h"
#include "partition/formats/stl.h"
#include "partition/io/slices.h"

namespace seamflow {

namespace {

class BinaryStlShare final : public StlShare {
  public:
    BinaryStlShare(Conversation& talk, const std::filesystem::path& path, std::string_view content)
    {
        talk.look_together([&] { stl_.emplace(path, content); });
        begin_ = static_cast<Index>(begin_of_stretch(stl_->n_facets(), talk.rank(), talk.size(), 1));
        end_ = static_cast<Index>(begin_of_stretch(stl_->n_facets(), talk.rank() + 1, talk.size(), 1));
    }

    [[nodiscard]] std::string_view bytes() const override { return stl_->bytes(begin_, end_); }

    PointNumbers read(Conversation& talk, PolygonMesh& faces, FaultLog& faults) const override
    {
        PointNumbers points;
        talk.look_together([&] { points = stl_->facets(begin_, end_, faces, faults); });
        talk.look_together([&] { stl_->require_end(); });
        return points;
    }

    void refuse_empty(Conversation& talk) const override
    {
        talk.look_together([&] { stl_->refuse_empty(); });
    }

  private:
    std::optional<StlStretches> stl_;
    Index begin_ = 0;
    Index end_ = 0;
};

class TextStlShare final : public StlShare {
  public:
    TextStlShare(const Conversation& talk, const std::filesystem::path& path, std::string_view content, Loop loop)
        : text_(path, content)
        , loop_(std::move(loop))
        , own_(text_.all().substr(text_.all().size()))
    {
        const std::vector<std::string_view> shares = text_.shares(static_cast<std::size_t>(talk.size()));
        if (static_cast<std::size_t>(talk.rank()) < shares.size())
            own_ = shares[static_cast<std::size_t>(talk.rank())];
    }

    [[nodiscard]] std::string_view bytes() const override { return own_; }

    PointNumbers read(Conversation& talk, PolygonMesh& faces, FaultLog& faults) const override
    {
        PointNumbers points;
        std::uint8_t is_faultless = 1;
        try {
            points = text_.facets(own_, faces, {loop_});
        } catch (const InputError&) {
            is_faultless = 0;
        }
        const auto all = talk.gather_all(std::vector<std::uint8_t>{is_faultless});
        return std::ranges::find(all, 0) == all.end() ? std::move(points) : check(talk, faces, faults);
    }

    void refuse_empty(Conversation& talk) const override
    {
        const auto lines = gather_bounds_of(talk, static_cast<std::int64_t>(text_.lines_of(own_)));
        talk.look_together([&] {
            throw InputError(text_.position_of(static_cast<std::size_t>(lines.back())) +
                             ": the file has no vertices; export the mesh again");
        });
    }

  private:
    /// Reads as if each share began within a solid, but the first. Where that is not so in the end, after a share
    /// without fault, the next one begins with a fault.
    PointNumbers check(Conversation& talk, PolygonMesh& faces, FaultLog& faults) const
    {
        const auto lines = gather_bounds_of(talk, static_cast<std::int64_t>(text_.lines_of(own_)));
        const auto lines_before = static_cast<std::size_t>(lines[talk.rank()]);
        const bool begins_in_solid = talk.rank() > 0;
        bool in_solid = begins_in_solid;
        PointNumbers points;
        std::string fault;
        try {
            faces = {};
            if (!own_.empty())
                points = text_.check(own_, lines_before, in_solid, faces, faults);
        } catch (const InputError& error) {
            fault = error.what();
        }
        const auto ends = talk.gather_all(std::vector<std::uint8_t>{static_cast<std::uint8_t>(in_solid ? 1 : 0)});
        const bool is_in_solid = talk.rank() > 0 && ends[static_cast<std::size_t>(talk.rank()) - 1] != 0;
        talk.look_together([&] {
            if (is_in_solid != begins_in_solid && !own_.empty()) {
                bool before = is_in_solid;
                PolygonMesh unused;
                FaultLog unused_faults{.of_faces_alone = true};
                static_cast<void>(text_.check(own_, lines_before, before, unused, unused_faults));
            }
            if (!fault.empty())
                throw InputError(fault);
        });
        return points;
    }

    StlText text_;
    Loop loop_;
    /// Perhaps empty.
    std::string_view own_;
};

}  // namespace

std::unique_ptr<StlShare> share_stl(Conversation& talk, const std::filesystem::path& path, std::string_view content,
                                    Encoding encoding, const Loop& loop)
{
    if (encoding == Encoding::Ascii)
        return std::make_unique<TextStlShare>(talk, path, content, loop);
    return std::make_unique<BinaryStlShare>(talk, path, content);
}

}  // namespace seamflow
