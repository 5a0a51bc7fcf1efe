#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "samples/figures/drawing.h"
#include "samples/figures/experiment.h"

namespace seamflow {

/// The pictures of an experiment. The heights (z) of its input are a texture on all its surfaces, as in the paper: blue
/// where the input was lowest, red where it was highest, with lines of equal height. Where vertices are dragged along
/// the surface, so are the lines.
class Pictures {
  public:
    /// Writes FIGURE-input.ply, and where the mesh is cut in two FIGURE-cut.txt, the label of each face.
    /// @param folder for all files. @throws OutputError.
    Pictures(const Experiment& experiment, std::filesystem::path folder, const FigureMesh& input);

    /// Writes a state of the mesh: FIGURE-TITLE.ply, each vertex with the colour of its height in the input and that
    /// height as the property `height`, and FIGURE-TITLE.png.
    /// @throws OutputError.
    void write(const std::string& title, const Points& positions) const;

    /// Writes the pictures of the input: as it is, and where it is cut in two each sub-mesh in a colour, and the one
    /// that solves first alone.
    /// @throws OutputError.
    void write_inputs(Index leading) const;

  private:
    [[nodiscard]] std::filesystem::path path(std::string_view title, std::string_view ending) const;
    void write_ply(std::string_view title, const Points& positions) const;
    void draw_textured(std::string_view title, const PolygonMesh& mesh, const Points& positions) const;
    void draw_cut(Index leading) const;

    std::string figure_;
    std::filesystem::path folder_;
    const FigureMesh& input_;
    bool is_cut_ = false;
    bool overlaps_ = false;
    Viewpoint viewpoint_;
    /// #V: from 0 to 1.
    std::vector<double> heights_;
};

}  // namespace seamflow
