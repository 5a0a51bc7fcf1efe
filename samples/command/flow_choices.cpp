#include "samples/command/flow_choices.h"

#include "engine/options/option_table.h"

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

void add_field(CLI::App& app, FlowOptions& options, const std::string& name, const std::string& description)
{
    for_each_option(options, [&]<class Value>(const OptionRow<Value>& row) {
        OptionTraits described = row;
        described.text = description;
        if constexpr (IsReadable<Value>)
            if (row.option == name)
                add_value(app, described, *row.value);
    });
}

CLI::Option* add_converge(CLI::App& app, FlowOptions& options, const std::string& description)
{
    const auto parse = [](AccuracyOptions accuracy, const std::string& text) {
        accuracy.approach = text == "never" ? Approach::Sweep : Approach::Automatic;
        accuracy.tolerance.reset();
        try {
            if (text != "auto" && text != "never")
                accuracy.tolerance = parse_real(text, positive());
        } catch (const OptionError& error) {
            throw OptionError(std::string(error.what()) + ", \"auto\" or \"never\"");
        }
        return accuracy;
    };
    return add_parsed(
        app, "--converge", options.accuracy,
        [&options, parse](const std::string& text) { return parse(options.accuracy, text); }, "auto|never|NUMBER",
        description);
}

}  // namespace seamflow
