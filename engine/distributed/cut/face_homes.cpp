#include "engine/distributed/cut/face_homes.h"

#include <utility>

namespace seamflow {

std::vector<Index> fetch_labels(Communicator& comm, std::span<const Index> labels, const SliceBounds& bounds,
                                std::span<const std::int64_t> faces)
{
    std::vector<std::vector<std::int64_t>> questions(comm.size());
    for (const std::int64_t face : faces)
        questions[range_of(bounds.faces, face)].push_back(face);
    std::vector<Bytes> asked;
    for (const auto& of_home : questions)
        asked.push_back(packed(of_home));
    std::vector<Bytes> answers;
    for (const Bytes& question : comm.exchange(std::move(asked))) {
        std::vector<Index> found;
        for (const std::int64_t face : unpacked<std::int64_t>(question))
            found.push_back(labels[static_cast<std::size_t>(face - bounds.faces[comm.rank()])]);
        answers.push_back(packed(found));
    }
    // Homes ascend, and so do the faces.
    std::vector<Index> all;
    for (const Bytes& answer : comm.exchange(std::move(answers))) {
        const auto of_home = unpacked<Index>(answer);
        all.insert(all.end(), of_home.begin(), of_home.end());
    }
    return all;
}

void send_home(Communicator& comm, const SliceBounds& bounds, std::span<const MeshPart* const> parts,
               const std::function<bool(std::size_t, Index)>& has_twin, RankSlice& slice,
               std::vector<std::uint8_t>& twins_of_slice)
{
    std::vector<Packer> to_homes(comm.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const MeshPart& part = *parts[i];
        const PolygonMesh& mesh = part.mesh;
        for (Index f = 0; f < mesh.n_faces(); ++f) {
            Packer& packer = to_homes[range_of(bounds.faces, part.face_numbers[f])];
            packer.put(part.face_numbers[f]);
            packer.put(part.labels[f]);
            for (Index h = mesh.face_offsets[f]; h < mesh.face_offsets[f + 1]; ++h)
                packer.put(has_twin(i, h) ? std::uint8_t{1} : std::uint8_t{0});
        }
    }
    std::vector<Bytes> sent;
    for (Packer& packer : to_homes)
        sent.push_back(packer.take());
    slice.labels.assign(at(slice.n_faces()), 0);
    twins_of_slice.assign(slice.corners.size(), 0);
    for (const Bytes& bytes : comm.exchange(std::move(sent)))
        for (Unpacker unpacker(bytes); !unpacker.is_at_end();) {
            const auto f = static_cast<Index>(unpacker.get<std::int64_t>() - bounds.faces[comm.rank()]);
            slice.labels[f] = unpacker.get<Index>();
            for (Index h = slice.face_offsets[f]; h < slice.face_offsets[f + 1]; ++h)
                twins_of_slice[h] = unpacker.get<std::uint8_t>();
        }
}

}  // namespace seamflow
