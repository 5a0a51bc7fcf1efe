#include <cstddef>
#include <fstream>
#include <vector>

#include <dlfcn.h>
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "solvers/platform/blas_work_area.h"

using namespace seamflow;

namespace {

std::size_t bytes_of_address_space()
{
    std::ifstream file("/proc/self/statm");
    std::size_t pages = 0;
    file >> pages;
    REQUIRE(pages > 0);
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// While it lives, this process can take only so much more.
class AddressSpaceLimit {
  public:
    explicit AddressSpaceLimit(std::size_t more)
    {
        REQUIRE(getrlimit(RLIMIT_AS, &before_) == 0);
        rlimit limit = before_;
        limit.rlim_cur = bytes_of_address_space() + more;
        REQUIRE(setrlimit(RLIMIT_AS, &limit) == 0);
    }
    ~AddressSpaceLimit() { setrlimit(RLIMIT_AS, &before_); }
    AddressSpaceLimit(const AddressSpaceLimit&) = delete;
    AddressSpaceLimit& operator=(const AddressSpaceLimit&) = delete;

  private:
    rlimit before_{};
};

/// A triangular solve that needs a work area of BLAS.
void solve_by_blas()
{
    using Trsv =
        void(const char*, const char*, const char*, const int*, const double*, const int*, double*, const int*);
    void* const found = dlsym(RTLD_DEFAULT, "dtrsv_");
    REQUIRE(found != nullptr);
    auto* const trsv = reinterpret_cast<Trsv*>(found);
    constexpr int n = 300;
    constexpr int one = 1;
    std::vector<double> identity(std::size_t{n} * n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
        identity[i * n + i] = 1.0;
    std::vector<double> x(n, 2.0);
    trsv("L", "N", "N", &n, identity.data(), &n, x.data(), &one);
    CHECK(x == std::vector<double>(n, 2.0));
}

}  // namespace

// OpenBLAS would ask for its area again and again: the alarm ends that. Which products do without an area depends on
// the processor, so this finds more on one with AVX-512.
TEST_CASE("who has a turn finds the work area of BLAS there, however full the address space has become since")
{
    alarm(20);
    const AddressSpaceLimit limit(std::size_t{2} << 30);
    const BlasWorkArea turn;
    const AddressSpaceLimit hardly_any(std::size_t{16} << 20);
    solve_by_blas();
    alarm(0);
}
