#include "solvers/laplacian/laplacian_assembler.h"

#include <algorithm>

#include "partition/errors.h"
#include "solvers/laplacian/alexa_wardetzky.h"
#include "solvers/laplacian/fujiwara.h"
#include "solvers/laplacian/ptackova_velho.h"

namespace seamflow {

std::unique_ptr<LaplacianAssembler> make_assembler(Laplacian laplacian, const FaceView& faces)
{
    switch (laplacian) {
    case Laplacian::Fujiwara:
        return make_fujiwara_assembler(faces);
    case Laplacian::AlexaWardetzky:
        return make_alexa_wardetzky_assembler(faces);
    case Laplacian::PtackovaVelho:
        return make_ptackova_velho_assembler(faces);
    }
    throw OptionError("no such Laplacian");
}

LaplacianMatrix laplacian_matrix(Laplacian laplacian, const FaceView& faces, const Points& positions)
{
    const auto assembler = make_assembler(laplacian, faces);
    const auto entries = assembler->entries();
    LaplacianMatrix matrix;
    matrix.pattern = make_pattern(faces.n_vertices, entries);
    std::vector<Index> slots(entries.size());
    std::transform(entries.begin(), entries.end(), slots.begin(),
                   [&](const MatrixEntry& entry) { return matrix.pattern.slot(entry); });
    matrix.values.assign(at(matrix.pattern.n_entries()), 0.0);
    assembler->add(positions, 1.0, slots, matrix.values);
    return matrix;
}

}  // namespace seamflow
