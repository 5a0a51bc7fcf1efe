#include "samples/benchmark/methods/method.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace seamflow {

bool is_ours(Method method)
{
    return method <= Method::Undecomposed;
}

bool is_iterative(Method method)
{
    return method == Method::Krylov || method == Method::KrylovIncomplete || method == Method::Amg;
}

std::string why_not(Method method, Laplacian laplacian)
{
    const bool needs_symmetry = method == Method::Cholmod || method == Method::Amg || method == Method::OurCg;
    if (laplacian == Laplacian::PtackovaVelho && needs_symmetry)
        return "left out: Ptáčková-Velho is not symmetric";
    return {};
}

std::string_view title_of(Method method, Laplacian laplacian)
{
    const bool symmetric = laplacian != Laplacian::PtackovaVelho;
    switch (method) {
    case Method::Ours:
        return "ours";
    case Method::OurSweep:
        return "sweep";
    case Method::OurConverged:
        return "converged";
    case Method::OurCg:
        return "our-cg";
    case Method::Undecomposed:
        return "undecomposed";
    case Method::Cholmod:
        return "cholmod";
    case Method::Umfpack:
        return "umfpack";
    case Method::Krylov:
        return symmetric ? "cg" : "bicgstab";
    case Method::KrylovIncomplete:
        return symmetric ? "cg-ic" : "bicgstab-ilut";
    case Method::Amg:
        return "amg";
    case Method::SmoothShape:
        return "cgal";
    }
    return {};
}

double MethodResult::step_seconds() const
{
    return steps.empty() ? 0.0 : steps[median_step(steps)].total;
}

double MethodResult::total_seconds() const
{
    return std::accumulate(steps.begin(), steps.end(), setup_seconds,
                           [](double sum, const StepSeconds& step) { return sum + step.total; });
}

MethodResult failed(std::string error)
{
    MethodResult result;
    result.error = std::move(error);
    return result;
}

std::size_t median_step(const std::vector<StepSeconds>& steps)
{
    std::vector<std::size_t> numbers(steps.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    const auto first = steps.size() > 1 ? numbers.begin() + 1 : numbers.begin();
    const auto middle = first + (numbers.end() - first) / 2;
    std::nth_element(first, middle, numbers.end(),
                     [&](std::size_t a, std::size_t b) { return steps[a].total < steps[b].total; });
    return *middle;
}

}  // namespace seamflow
