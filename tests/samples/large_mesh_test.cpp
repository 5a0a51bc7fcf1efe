#include "tests/samples/workshop.h"

using namespace seamflow::test;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// What sanitizers keep about memory would not fit, and they are slow.
constexpr const char* vertices = "20000";
constexpr const char* address_space = "unlimited";
#else
constexpr const char* vertices = "1000000";
constexpr const char* address_space = "1100000";
#endif

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
