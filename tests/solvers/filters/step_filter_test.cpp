#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "solvers/filters/step_filter.h"
#include "tests/support/relative.h"

using namespace seamflow;

namespace {

std::vector<StepFilter> all_filters(double tolerance)
{
    std::vector<StepFilter> filters;
    for (const int order : {1, 2, 3})
        filters.push_back({Filter::Diffusion, order, tolerance});
    for (const int order : {2, 3, 5, 8})
        filters.push_back({Filter::LowPass, order, tolerance});
    return filters;
}

/// What a filter that is not plain leaves of modes with these λ, by solutions of a diagonal system.
std::vector<double> left_of_modes(const StepFilter& filter, const std::vector<double>& lambda, int& n_solutions)
{
    const auto n = static_cast<Index>(lambda.size());
    const auto solution = [&](Index i) { return 1.0 / (1.0 + lambda[i]); };
    PointBlocks rest(1, Points::Zero(n, 3));
    for (Index i = 0; i < n; ++i)
        rest[0].row(i).setConstant(1.0 - solution(i));
    PointBlocks solved = rest;
    n_solutions = 1;
    apply_filter(
        filter, rest,
        [&](const PointBlocks& data) -> const PointBlocks& {
            ++n_solutions;
            for (Index i = 0; i < n; ++i)
                solved[0].row(i) = solution(i) * data[0].row(i);
            return solved;
        },
        run_serially);
    std::vector<double> left;
    for (Index i = 0; i < n; ++i) {
        CHECK(rest[0](i, 0) == rest[0](i, 2));
        left.push_back(1.0 - rest[0](i, 1));
    }
    return left;
}

}  // namespace

TEST_CASE("the transfer function is what the filter says, and lambda its inverse")
{
    CHECK(transfer({Filter::Diffusion, 1}, 3.0) == test::relative(1.0 / 4.0, 1e-14));
    CHECK(transfer({Filter::Diffusion, 2}, 3.0) == test::relative(1.0 / 10.0, 1e-14));
    CHECK(transfer({Filter::Diffusion, 3}, 3.0) == test::relative(1.0 / 28.0, 1e-14));
    CHECK(transfer({Filter::LowPass, 2}, 3.0) == test::relative(7.0 / 16.0, 1e-14));
    CHECK(transfer({Filter::LowPass, 3}, 3.0) == test::relative(37.0 / 64.0, 1e-14));
    for (const StepFilter& filter : all_filters(1e-2))
        for (const double left : {0.999, 0.9, 0.5, 0.1, 1e-3})
            CHECK(std::abs(transfer(filter, lambda_of(filter, left)) / left - 1.0) < 1e-9);
}

TEST_CASE(
    "a step leaves of each mode what the transfer function says, to the tolerance, with as many solutions as said")
{
    std::vector<double> lambda{0.0, 1e-6, 1e-3};
    for (double l = 0.01; l < 1e5; l *= 1.3)
        lambda.push_back(l);
    for (const double tolerance : {1e-2, 1e-4, 1e-8})
        for (const StepFilter& filter : all_filters(tolerance)) {
            if (filter.is_plain())
                continue;
            CAPTURE(static_cast<int>(filter.kind));
            CAPTURE(filter.order);
            CAPTURE(tolerance);
            int solutions = 0;
            const std::vector<double> left = left_of_modes(filter, lambda, solutions);
            CHECK(solutions == n_solutions(filter));
            const bool is_exact = filter.kind == Filter::LowPass;
            for (std::size_t i = 0; i < lambda.size(); ++i)
                CHECK(std::abs(left[i] - transfer(filter, lambda[i])) <= (is_exact ? 1e-13 : tolerance));
            // Nothing is taken of what is constant, and next to nothing of what is large.
            CHECK(left[0] == 1.0);
            CHECK(1.0 - left[2] < 1e-5);
        }
}

TEST_CASE("a better tolerance takes more solutions, a hundredth eight and eleven")
{
    CHECK(n_solutions({Filter::Diffusion, 1}) == 1);
    CHECK(n_solutions({Filter::Diffusion, 2}) == 8);
    CHECK(n_solutions({Filter::Diffusion, 3}) == 11);
    CHECK(n_solutions({Filter::LowPass, 5}) == 5);
    CHECK(n_solutions({Filter::Diffusion, 3, 1e-6}) > n_solutions({Filter::Diffusion, 3, 1e-3}));
}
