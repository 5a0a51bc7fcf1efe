#include "samples/common/flow_choices.h"

#include <CLI/Error.hpp>

#include "partition/errors.h"
#include "samples/common/command_line.h"

namespace seamflow {

const std::vector<std::pair<std::string, Laplacian>>& laplacian_choices()
{
    static const auto choices = [] {
        std::vector<std::pair<std::string, Laplacian>> named;
        for (const LaplacianTraits& traits : all_laplacian_traits())
            named.emplace_back(traits.name, traits.laplacian);
        return named;
    }();
    return choices;
}

CLI::Option* add_converge(CLI::App& app, FlowOptions& options, const std::string& description)
{
    const auto store = [&options](const std::string& text) {
        options.accuracy.approach = text == "never" ? Approach::Sweep : Approach::Automatic;
        options.accuracy.tolerance.reset();
        if (text == "auto" || text == "never")
            return;
        try {
            options.accuracy.tolerance = parse_real(text, positive());
        } catch (const OptionError& error) {
            throw CLI::ValidationError("--converge", std::string(error.what()) + ", \"auto\" or \"never\"");
        }
    };
    return app.add_option_function<std::string>("--converge", store, description)->type_name("auto|never|NUMBER");
}

}  // namespace seamflow
