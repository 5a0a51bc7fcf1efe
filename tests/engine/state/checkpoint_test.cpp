#include <bit>
#include <random>
#include <string>

#include <doctest/doctest.h>

#include "engine/mean_curvature_flow.h"
#include "engine/state/checkpoint.h"
#include "engine/state/checksum.h"
#include "engine/state/flow_state.h"
#include "partition/errors.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/test_meshes.h"

using namespace seamflow;

namespace {

FlowState some_state()
{
    PolygonMesh mesh = test::quad_torus(8, 5);
    FlowOptions options;
    options.time_step = 0.01;
    options.cut.subdomains = 3;
    options.report.reference = true;
    options.steps = 2;
    FlowState state;
    mean_curvature_flow(mesh, options, [&](const StepState& now) { state = *now.capture(); });
    return state;
}

std::uint64_t checksum_of_text(std::string_view text, std::size_t portion)
{
    Checksum checksum;
    for (; !text.empty(); text.remove_prefix(std::min(portion, text.size())))
        checksum.add(std::as_bytes(std::span(text.substr(0, portion))));
    return checksum.value();
}

/// With the checksum that belongs to what it has become.
std::string with_right_checksum(std::string content)
{
    content.resize(content.size() - sizeof(std::uint64_t));
    const std::uint64_t checksum = checksum_of_text(content, content.size());
    return content.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
}

}  // namespace

TEST_CASE("a checkpoint is read as it was written, and written over itself")
{
    const test::TemporaryDirectory directory;
    const FlowState state = some_state();
    for (int i = 0; i < 2; ++i) {
        write_checkpoint(directory / "state", state);
        const FlowState read = *read_checkpoint(directory / "state");
        CHECK(read.identity == state.identity);
        CHECK(read.cut == state.cut);
        CHECK(read.positions() == state.positions());
        REQUIRE(read.steps.size() == 2);
        CHECK(read.steps[1].distance->max == state.steps[1].distance->max);
        CHECK(read.seconds.factorise == state.seconds.factorise);
        CHECK(read.displacement.tangential == state.displacement.tangential);
        CHECK(read.flow.arrays == state.flow.arrays);
        CHECK(read.reference->numbers == state.reference->numbers);
    }
    CHECK(directory.n_files() == 1);
}

TEST_CASE("a checkpoint that is cut off or changed anywhere is refused")
{
    const test::TemporaryDirectory directory;
    write_checkpoint(directory / "state", some_state());
    const std::string content = test::content_of(directory / "state");
    const auto refused = [&](const std::string& changed) {
        try {
            read_checkpoint(directory.with("changed", changed));
        } catch (const InputError& error) {
            return std::string(error.what()).find("changed: ") != std::string::npos;
        }
        return false;
    };
    std::mt19937 random(3);
    for (int i = 0; i < 300; ++i) {
        const std::size_t place = i < 40 ? static_cast<std::size_t>(i) : random() % content.size();
        CHECK(refused(content.substr(0, place)));
        std::string changed = content;
        changed[place] = static_cast<char>(changed[place] ^ (1 << random() % 8));
        CHECK(refused(changed));
    }
    CHECK(refused(content + '\0'));
    CHECK(refused("v 0 0 0\n"));
    CHECK_THROWS_AS(read_checkpoint(directory / "nothing"), InputError);
    CHECK_THROWS_AS(read_checkpoint(directory.path()), InputError);
}

TEST_CASE("sizes that a file cannot have are refused, even if the checksum is right")
{
    const test::TemporaryDirectory directory;
    write_checkpoint(directory / "state", some_state());
    const std::string content = test::content_of(directory / "state");
    int n_refused = 0;
    // Any word may be a size: none makes the program take memory that the file does not fill.
    for (std::size_t place = 24; place + 16 < content.size(); place += 4) {
        std::string changed = content;
        changed.replace(place, 8, std::string("\xff\xff\xff\xff\xff\xff\xff\x7f", 8));
        try {
            read_checkpoint(directory.with("changed", with_right_checksum(changed)));
        } catch (const InputError&) {
            ++n_refused;
        }
    }
    CHECK(n_refused > 20);
}

TEST_CASE("a checksum does not depend on portions, but on every byte and the length")
{
    const std::string text = "what a checksum is made of, 1234567";
    const std::uint64_t expected = checksum_of_text(text, text.size());
    for (const std::size_t portion : {1U, 2U, 3U, 7U, 8U, 9U, 16U, 20U})
        CHECK(checksum_of_text(text, portion) == expected);
    CHECK(checksum_of_text(text + '\0', 8) != expected);
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::string changed = text;
        changed[i] = static_cast<char>(changed[i] + 1);
        CHECK(checksum_of_text(changed, 8) != expected);
    }
}
