#include "solvers/laplacian/alexa_wardetzky.h"

#include "solvers/laplacian/vertex_areas.h"

namespace seamflow {

namespace {

class AlexaWardetzkyAssembler final : public LaplacianAssembler {
  public:
    explicit AlexaWardetzkyAssembler(const FaceView& faces)
        : faces_(faces)
        , face_areas_(at(faces.n_faces()))
        , vertex_areas_(at(faces.n_vertices))
    {
    }

    [[nodiscard]] std::vector<MatrixEntry> entries() const override
    {
        std::vector<MatrixEntry> entries;
        for (Index f = 0; f < faces_.n_faces(); ++f)
            for (const Index row : faces_.face(f))
                for (const Index column : faces_.face(f))
                    entries.push_back({column, row});
        return entries;
    }

    void add(const Points& positions, double factor, std::span<const Index> slots, std::span<double> values) override
    {
        measure_areas(faces_, positions, face_areas_, vertex_areas_);
        const Index* slot = slots.data();
        for (Index f = 0; f < faces_.n_faces(); ++f) {
            const auto corners = faces_.face(f);
            bisectors_.resize(corners.size());
            for (std::size_t k = 0; k < corners.size(); ++k)
                bisectors_[k] = corner_bisector(corners, k, positions);
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const Point row = factor / (vertex_areas_[at(corners[i])] * face_areas_[at(f)]) * bisectors_[i];
                for (std::size_t k = 0; k < corners.size(); ++k)
                    values[at(*slot++)] += row.dot(bisectors_[k]);
            }
        }
    }

  private:
    FaceView faces_;
    std::vector<double> face_areas_;
    std::vector<double> vertex_areas_;
    std::vector<Point> bisectors_;
};

}  // namespace

std::unique_ptr<LaplacianAssembler> make_alexa_wardetzky_assembler(const FaceView& faces)
{
    return std::make_unique<AlexaWardetzkyAssembler>(faces);
}

}  // namespace seamflow
