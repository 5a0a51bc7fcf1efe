#include "samples/runs/begin_page.h"

#include <memory>

#include "samples/page/read_file_colours.h"
#include "samples/page/shown_steps.h"

namespace seamflow {

std::optional<PageFlow> begin_page(const SmoothCommand& command, const MeshFile& file,
                                   const std::vector<Index>& left_out, Workers& workers)
{
    std::optional<PageFlow> page;
    if (command.html.empty())
        return page;
    require_showable(file.mesh, command.html);
    workers.execute([&] {
        page.emplace(std::make_shared<const PageMesh>(file.mesh, read_file_colours(command.input, file, left_out)),
                     command.output.filename().string(), command.options.laplacian, command.options.steps,
                     command.options.report.reference);
    });
    return page;
}

}  // namespace seamflow
