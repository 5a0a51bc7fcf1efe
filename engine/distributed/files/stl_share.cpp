#include "engine/distributed/files/stl_share.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/distributed/parts/element_ranges.h"
#include "engine/distributed/parts/whole_mesh.h"
#include "partition/errors.h"
#include "partition/formats/stl.h"
#include "partition/io/slices.h"

namespace seamflow {

namespace {

class BinaryStlShare final : public StlShare {
  public:
    BinaryStlShare(Communicator& comm, const std::filesystem::path& path, std::string_view content)
    {
        comm.look_together([&] { stl_.emplace(path, content); });
        begin_ = static_cast<Index>(begin_of_range(stl_->n_facets(), comm.rank(), comm.size(), 1));
        end_ = static_cast<Index>(begin_of_range(stl_->n_facets(), comm.rank() + 1, comm.size(), 1));
    }

    [[nodiscard]] std::string_view bytes() const override { return stl_->bytes(begin_, end_); }

    Points read(Communicator& comm, PolygonMesh& faces, FaultLog& faults) const override
    {
        Points points(0, 3);
        comm.look_together([&] { points = stl_->facets(begin_, end_, faces, faults); });
        comm.look_together([&] { stl_->require_end(); });
        return points;
    }

    void refuse_empty(Communicator& comm) const override
    {
        comm.look_together([&] { stl_->refuse_empty(); });
    }

  private:
    std::optional<StlRanges> stl_;
    Index begin_ = 0;
    Index end_ = 0;
};

class TextStlShare final : public StlShare {
  public:
    TextStlShare(const Communicator& comm, const std::filesystem::path& path, std::string_view content, Executor exec)
        : text_(path, content)
        , exec_(std::move(exec))
        , own_(text_.all().substr(text_.all().size()))
    {
        const std::vector<std::string_view> shares = text_.shares(static_cast<std::size_t>(comm.size()));
        if (static_cast<std::size_t>(comm.rank()) < shares.size())
            own_ = shares[static_cast<std::size_t>(comm.rank())];
    }

    [[nodiscard]] std::string_view bytes() const override { return own_; }

    Points read(Communicator& comm, PolygonMesh& faces, FaultLog& faults) const override
    {
        Points points(0, 3);
        std::uint8_t is_faultless = 1;
        try {
            points = text_.facets(own_, faces, {exec_});
        } catch (const InputError&) {
            is_faultless = 0;
        }
        const auto all = comm.gather_all(std::vector<std::uint8_t>{is_faultless});
        return std::ranges::find(all, 0) == all.end() ? std::move(points) : check(comm, faces, faults);
    }

    void refuse_empty(Communicator& comm) const override
    {
        const auto lines = gather_bounds_of(comm, static_cast<std::int64_t>(text_.lines_of(own_)));
        comm.look_together([&] {
            throw InputError(text_.position_of(static_cast<std::size_t>(lines.back())) +
                             ": the file has no vertices; export the mesh again");
        });
    }

  private:
    /// Reads as if each share except for the first began within a solid. If that turns out to be wrong, after a share
    /// without fault, the next one begins with a fault.
    Points check(Communicator& comm, PolygonMesh& faces, FaultLog& faults) const
    {
        const auto lines = gather_bounds_of(comm, static_cast<std::int64_t>(text_.lines_of(own_)));
        const auto lines_before = static_cast<std::size_t>(lines[comm.rank()]);
        const bool begins_in_solid = comm.rank() > 0;
        bool in_solid = begins_in_solid;
        Points points(0, 3);
        std::string fault;
        try {
            faces = {};
            if (!own_.empty())
                points = text_.check(own_, lines_before, in_solid, faces, faults);
        } catch (const InputError& error) {
            fault = error.what();
        }
        const auto ends = comm.gather_all(std::vector<std::uint8_t>{static_cast<std::uint8_t>(in_solid ? 1 : 0)});
        const bool is_in_solid = comm.rank() > 0 && ends[static_cast<std::size_t>(comm.rank()) - 1] != 0;
        comm.look_together([&] {
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
    Executor exec_;
    /// May be empty.
    std::string_view own_;
};

}  // namespace

std::unique_ptr<StlShare> share_stl(Communicator& comm, const std::filesystem::path& path, std::string_view content,
                                    Encoding encoding, const Executor& exec)
{
    if (encoding == Encoding::Ascii)
        return std::make_unique<TextStlShare>(comm, path, content, exec);
    return std::make_unique<BinaryStlShare>(comm, path, content);
}

}  // namespace seamflow
