#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "samples/figures/experiment.h"
#include "samples/page/page_flow.h"

namespace seamflow {

/// The page of a figure, with all its flows.
class FigurePage {
  public:
    explicit FigurePage(const FigureMesh& input);

    /// Begins a flow. @param compared whether its states come with those of the undecomposed flow.
    [[nodiscard]] PageFlow begin(const std::string& title, Laplacian laplacian, int steps, bool compared) const;

    /// Adds a flow that has finished.
    /// @param command see command_of.
    void add(PageFlow flow, const FlowReport& report, const std::string& command);

    /// Writes the page, unless there are no flows.
    /// @throws OutputError.
    void write(const std::filesystem::path& path, const Experiment& experiment) const;

  private:
    std::string mesh_name_;
    std::shared_ptr<const PageMesh> mesh_;
    std::vector<PageFlow> flows_;
};

}  // namespace seamflow
