#include "tests/samples/workshop.h"
#include "tests/support/sanitizers.h"

using namespace seamflow::test;

namespace {

/// What sanitizers keep about memory would not fit, and they are slow.
constexpr const char* vertices = under_sanitizers ? "20000" : "1000000";
constexpr const char* address_space = under_sanitizers ? "unlimited" : "1100000";

}  // namespace

TEST_CASE("a million vertices are smoothed in little more than a gigabyte, with what is in it but factorisations")
{
    const Workshop shop;
    REQUIRE(shop.run(std::string(GENERATE " mixed million.ply --vertices ") + vertices) == 0);
    const std::string within = std::string("ulimit -v ") + address_space + " && ";
    const std::string arguments = " million.ply smooth.ply --time-step-edges 5 --converge never --threads 2";
    REQUIRE(shop.run(within + SMOOTH + arguments + " --memory-limit 32MiB --report report.json") == 0);
    CHECK(shop.json("report.json").at("factor_memory_bytes") <= 32 * 1024 * 1024);
}
