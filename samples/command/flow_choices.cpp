#include "samples/command/flow_choices.h"

#include <type_traits>

#include <CLI/Error.hpp>

#include "engine/options/option_table.h"
#include "partition/errors.h"
#include "samples/command/command_line.h"

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

CLI::Option* add_field(CLI::App& app, FlowOptions& options, const std::string& name, const std::string& description)
{
    CLI::Option* added = nullptr;
    for_each_option(options, [&]<class Value>(const OptionRow<Value>& row) {
        if (row.option != name)
            return;
        Value& field = *row.value;
        if constexpr (std::is_same_v<Value, Laplacian>)
            added = add_choice(app, name, field, laplacian_choices(), description);
        else if constexpr (std::is_enum_v<Value>)
            added = add_choice(app, name, field, description);
        else if constexpr (std::is_same_v<Value, bool>)
            added = app.add_flag(name, field, description);
        else if constexpr (requires { add_bytes(app, name, field, description); })
            added = add_bytes(app, name, field, description);
        else if constexpr (requires { add_real(app, name, field, row.limits, description); })
            added = add_real(app, name, field, row.limits, description);
        else if constexpr (requires { add_integer(app, name, field, 0, description); })
            added = add_integer(app, name, field, static_cast<int>(row.limits.least), description);
    });
    return added;
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
