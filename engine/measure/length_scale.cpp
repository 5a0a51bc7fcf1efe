#include "engine/measure/length_scale.h"

#include <utility>

#include "partition/metrics/bounding_box.h"
#include "partition/metrics/vertex_distance.h"

namespace seamflow {

LengthScale::LengthScale(const PolygonMesh& mesh, Executor exec)
    : mesh_(&mesh)
    , exec_(std::move(exec))
{
}

LengthScale::LengthScale(double mean_edge, double diagonal)
    : mean_edge_(mean_edge)
    , diagonal_(diagonal)
{
}

const PolygonMesh& LengthScale::mesh() const
{
    require_valid(*mesh_, exec_);
    return *mesh_;
}

double LengthScale::mean_edge()
{
    if (!mean_edge_)
        mean_edge_ = mean_edge_length(mesh(), mesh_->vertices, exec_);
    return *mean_edge_;
}

double LengthScale::diagonal()
{
    if (!diagonal_)
        diagonal_ = box_of_faces(mesh(), exec_).diagonal();
    return *diagonal_;
}

double LengthScale::length_of(const LengthOnMesh& length)
{
    return length.value * (length.of_diagonal ? diagonal() : 1.0);
}

}  // namespace seamflow
