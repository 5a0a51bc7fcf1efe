#include <string>
#include <utility>
#include <vector>

#include <CLI/App.hpp>
#include <doctest/doctest.h>

#include "engine/setup/presets.h"
#include "partition/errors.h"
#include "samples/command/smooth_options.h"
#include "samples/options/smooth_request.h"
#include "tests/support/messages.h"

using namespace seamflow;

namespace {

using Texts = std::vector<std::pair<std::string, std::string>>;

/// The same options as on a command line.
SmoothCommand command_of(const Texts& texts)
{
    CLI::App app;
    SmoothCommand command;
    add_options(app, command);
    std::vector<std::string> words;
    // CLI11 expects reverse order.
    for (auto text = texts.rbegin(); text != texts.rend(); ++text)
        words.push_back(text->second.empty() ? text->first : text->first + "=" + text->second);
    app.parse(std::move(words));
    command.given = given_options(app);
    settle(command);
    return command;
}

bool are_same(const SmoothRequest& a, const SmoothRequest& b)
{
    bool same = a.preset == b.preset && a.chosen == b.chosen && a.chooses_amount == b.chooses_amount &&
                a.noise == b.noise && a.remarks == b.remarks && a.given.size() == b.given.size();
    for_each_pair(all_option_table(a.options), all_option_table(b.options),
                  [&](const auto& of_a, const auto& of_b) { same = same && *of_a.value == *of_b.value; });
    return same;
}

}  // namespace

TEST_CASE("keywords mean what the options of the command line mean")
{
    const std::vector<Texts> requests{{},
                                      {{"--radius", "2%"}, {"--steps", "3"}},
                                      {{"--time-step", "0.25"}, {"--laplacian", "uniform"}, {"--boundary", "free"}},
                                      {{"--time-step-edges", "4"}, {"--converge", "never"}, {"--subdomains", "5"}},
                                      {{"--time-step-edges", "4"}, {"--converge", "1e-6"}, {"--weld", "never"}},
                                      {{"--preset", "terrain"}, {"--weld", "1%"}, {"--within", "0.5"}},
                                      {{"--preset", "fair"}, {"--laplacian", "ptackova-velho"}},
                                      {{"--preset", "scan"}, {"--noise", "0.1"}, {"--order", "2"}},
                                      {{"--keep-edges", "40"}},
                                      {{"--keep-edges", "40"}, {"--radius", "1%"}, {"--direction", "0,1,1"}},
                                      {{"--plain", ""}, {"--time-step", "1"}, {"--no-correction", ""}},
                                      {{"--paper", ""}, {"--time-step", "1"}, {"--conditions", "adapted-robin"}},
                                      {{"--time-step", "1"}, {"--p", "2"}, {"--memory-limit", "3GiB"}},
                                      {{"--time-step", "1"}, {"--attach", "3%"}, {"--strict", ""}},
                                      {{"--boundary", "smooth"}, {"--radius", "1%"}, {"--self-intersections", ""}},
                                      {{"--approach", "cg"}, {"--time-step", "1"}, {"--threads", "2"}}};
    for (const Texts& texts : requests) {
        CAPTURE(texts.empty() ? "none" : texts.front().first);
        const SmoothRequest request = request_of(texts, {});
        CHECK(are_same(request, command_of(texts)));
        CHECK(are_same(request, request_of({}, {})) == texts.empty());
        // Options take effect in the order of their table.
        CHECK(are_same(request, request_of(Texts(texts.rbegin(), texts.rend()), {})));
    }
}

TEST_CASE("texts that cannot be read, and options that exclude each other, are refused by name")
{
    const auto refusal = [](const Texts& texts, const std::vector<std::string>& arrays) {
        return test::message_of([&] { request_of(texts, arrays); });
    };
    CHECK(refusal({{"--radius", "wide"}}, {}).starts_with("--radius: \"wide\" is neither a positive length"));
    CHECK(refusal({{"--steps", "1.5"}}, {}).starts_with("--steps: \"1.5\" is not a whole number"));
    CHECK(refusal({{"--laplacian", "best"}}, {}).starts_with("--laplacian: \"best\" is not one of fujiwara|"));
    CHECK(refusal({{"--subdomains", "3"}, {"--radius", "1%"}}, {"--labels"}) == "--labels excludes --subdomains");
    CHECK(refusal({{"--attach", "3"}, {"--radius", "1%"}}, {"--attach-weights"}) ==
          "--attach-weights excludes --attach");
    CHECK(refusal({{"--subdomains", "3"}, {"--radius", "1%"}}, {}).empty());
    CHECK(refusal({{"--radius", "1%"}, {"--time-step", "1"}}, {})
              .starts_with("--time-step, --time-step-edges and --radius all say"));
}

TEST_CASE("no preset chooses for fields, and arrays count as given")
{
    CHECK(request_of({}, {}).chooses_amount);
    CHECK_FALSE(request_of({}, {}, true).chooses_amount);
    CHECK(request_of({}, {}, true).preset == nullptr);
    CHECK(request_of({{"--radius", "1%"}}, {"--labels"}).options.accuracy.approach == Approach::Decomposed);
    CHECK(request_of({{"--radius", "1%"}}, {}).options.accuracy.approach == Approach::Automatic);
    CHECK(request_of({}, {"--edges"}).preset->name == "cad");
}
