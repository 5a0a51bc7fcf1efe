#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/flow_report.h"
#include "partition/topology.h"
#include "samples/page/file_colours.h"
#include "samples/page/packed_state.h"
#include "solvers/laplacian/laplacian.h"

namespace seamflow {

/// The mesh of a page, as it was before any flow.
struct PageMesh {
    explicit PageMesh(const PolygonMesh& input, FileColours own_colours = {});

    /// @param positions #V by 3. Vertices without faces, which are not seen, are packed at one that has some, so that
    /// the
    ///        box is that of the surface.
    [[nodiscard]] PackedPoints pack(Points positions) const;

    PolygonMesh mesh;
    Topology topology;
    double mean_edge = 0.0;
    /// The colours of its file, if they are known.
    FileColours colours;
};

/// A surface after some step, and its mean curvature ‖ΔV‖ at each vertex, in 1/length (see measure_curvature).
struct PageSurface {
    PackedPoints positions;
    PackedValues curvature;
};

/// One step as a page shows it.
struct PageState {
    /// 0: the input.
    int step = 0;
    PageSurface surface;
    std::optional<PageSurface> undecomposed;
    /// Distance of each vertex to the undecomposed flow, in mean edge lengths of that flow's mesh (like V_mean);
    /// without that flow, to its position in the input, in mean edge lengths of the input.
    PackedValues distance;
};

/// One flow on the mesh of a page: takes each state as it arrives, and stores it in a few bytes per vertex.
class PageFlow {
  public:
    /// @param name for the user, where a page has several flows.
    /// @param steps the number of states to come. @param undecomposed whether they include the undecomposed flow.
    PageFlow(std::shared_ptr<const PageMesh> mesh, std::string name, Laplacian laplacian, int steps, bool undecomposed);

    /// @param positions, undecomposed #V by 3; the latter null without that flow.
    void add_step(int step, const Points& positions, const Points* undecomposed);

    /// Adds the data that are only known at the end. @param report_json see smooth_report_json.
    void finish(const FlowReport& report, std::string report_json);

    /// After the last step: a sentence for the user if not all steps are shown, else empty.
    [[nodiscard]] std::string remark() const;

    [[nodiscard]] const PageMesh& mesh() const { return *mesh_; }
    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] Laplacian laplacian() const { return laplacian_; }
    [[nodiscard]] bool has_undecomposed() const { return undecomposed_; }
    [[nodiscard]] const std::vector<PageState>& states() const { return states_; }
    [[nodiscard]] const std::string& report_json() const { return report_json_; }
    /// Sub-mesh of every face.
    [[nodiscard]] const std::vector<Index>& labels() const { return labels_; }
    /// The same as text (see packed()).
    [[nodiscard]] const std::string& packed_labels() const { return packed_labels_; }

  private:
    [[nodiscard]] PageSurface pack_surface(const Points& positions) const;

    std::shared_ptr<const PageMesh> mesh_;
    std::string name_;
    Laplacian laplacian_;
    int steps_;
    bool undecomposed_;
    std::vector<int> shown_;
    std::vector<PageState> states_;
    std::string report_json_;
    std::vector<Index> labels_;
    std::string packed_labels_;
};

}  // namespace seamflow
