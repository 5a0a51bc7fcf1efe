#include "tests/support/writings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "engine/options/option_table.h"

namespace seamflow::test {

namespace {

/// The power of length in the unit of an option.
int power_of_length(std::string_view field)
{
    static const std::map<std::string_view, int> powers{{"time_step", 2},     {"radius", 1},
                                                        {"uniform_edge", 1},  {"p", -1},
                                                        {"weld", 1},          {"within", 1},
                                                        {"feather", 1},       {"attachment_radius", 1},
                                                        {"attachment", -2},   {"attachment_weights", -2},
                                                        {"limit_of_move", 1}, {"limit_of_slide", 1},
                                                        {"rounded", 1}};
    const auto found = powers.find(field);
    return found == powers.end() ? 0 : found->second;
}

/// The options of one writing, row by row of the table.
struct Translation {
    const Writing& w;
    double factor = 1.0;
    std::string_view field = {};

    void operator()(double& value) const { value *= factor; }
    void operator()(std::optional<double>& value) const
    {
        if (value)
            *value *= factor;
    }
    void operator()(std::optional<LengthOnMesh>& length) const
    {
        if (length && !length->of_diagonal)
            length->value *= factor;
    }
    void operator()(std::optional<MotionBound>& bound) const
    {
        if (bound)
            for (LengthOnMesh& length : bound->lengths)
                length.value *= length.of_diagonal ? 1.0 : factor;
    }
    void operator()(Rounding& rounding) const { rounding.steps *= factor; }
    void operator()(MotionDirection& direction) const { direction.vector *= w.turn.transpose(); }
    void operator()(std::vector<double>& of_vertices) const
    {
        if (of_vertices.empty())
            return;
        const std::vector<double> values = std::exchange(of_vertices, {});
        for (const Index v : w.vertex_from)
            of_vertices.push_back(v < 0 ? 0.0 : factor * values[v]);
    }
    void operator()(std::vector<Index>& list) const
    {
        if (field == "fixed_vertices") {
            list = w.vertices(list);
            return;
        }
        // A body of its own has a label of its own.
        const std::vector<Index> labels = std::exchange(list, {});
        const Index further = labels.empty() ? 0 : *std::ranges::max_element(labels) + 1;
        for (const Index f : w.face_from)
            if (!labels.empty())
                list.push_back(f < 0 ? further : labels[f]);
    }
    /// Along seams every copy of an edge is as good as another: the last.
    void operator()(std::vector<Edge>& edges) const
    {
        std::map<Edge, Edge> written;
        for (Index f = 0; f < w.mesh.n_faces() && !edges.empty(); ++f) {
            const auto corners = w.mesh.face(f);
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const Edge here{corners[k], corners[(k + 1) % corners.size()]};
                written[{w.vertex_from[here[0]], w.vertex_from[here[1]]}] = here;
                written[{w.vertex_from[here[1]], w.vertex_from[here[0]]}] = {here[1], here[0]};
            }
        }
        for (Edge& edge : edges)
            edge = written.at(edge);
    }
};

}  // namespace

Points Writing::read_back(const Points& positions) const
{
    return (positions.rowwise() - shift) * turn / scale;
}

Points Writing::placed(const Points& positions) const
{
    return (scale * positions * turn.transpose()).rowwise() + shift;
}

std::vector<Index> Writing::vertices(const std::vector<Index>& of_original) const
{
    std::map<Index, Index> last;
    for (std::size_t v = 0; v < vertex_from.size(); ++v)
        last[vertex_from[v]] = static_cast<Index>(v);
    std::vector<Index> written;
    for (const Index v : of_original)
        written.push_back(last.at(v));
    return written;
}

Eigen::MatrixXd Writing::field(const Eigen::MatrixXd& of_original, double otherwise) const
{
    Eigen::MatrixXd written =
        Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(vertex_from.size()), of_original.cols(), otherwise);
    for (std::size_t v = 0; v < vertex_from.size(); ++v)
        if (vertex_from[v] >= 0)
            written.row(static_cast<Eigen::Index>(v)) = of_original.row(vertex_from[v]);
    return written;
}

AllOptions Writing::options(AllOptions of_original) const
{
    std::vector<Index>& fixed = of_original.motion.fixed_vertices;
    fixed.insert(fixed.end(), held.begin(), held.end());
    for_each_row(all_option_table(of_original), [&](const auto& row) {
        const Translation translate{*this, std::pow(scale, power_of_length(row.field)), row.field};
        if constexpr (requires { translate(*row.value); })
            translate(*row.value);
    });
    return of_original;
}

double Writing::difference(const Eigen::MatrixXd& here, const Eigen::MatrixXd& of_original) const
{
    double largest = 0.0;
    for (std::size_t v = 0; v < vertex_from.size(); ++v) {
        if (vertex_from[v] < 0)
            continue;
        const Eigen::RowVectorXd a = here.row(static_cast<Eigen::Index>(v));
        const Eigen::RowVectorXd b = of_original.row(vertex_from[v]);
        for (Eigen::Index c = 0; c < a.size(); ++c)
            if (a[c] != b[c] && !(std::isnan(a[c]) && std::isnan(b[c])))
                largest = std::max(largest, std::isfinite(a[c] - b[c]) ? std::abs(a[c] - b[c])
                                                                       : std::numeric_limits<double>::infinity());
    }
    return largest;
}

}  // namespace seamflow::test
