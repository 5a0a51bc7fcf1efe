#include "samples/benchmark/methods/method.h"

#include <numeric>
#include <utility>

#include "samples/benchmark/methods/median.h"

namespace seamflow {

bool is_iterative(Method method)
{
    return method == Method::Gradients || method == Method::Amg;
}

std::string_view name_of(Method method)
{
    switch (method) {
    case Method::Ours:
        return "ours";
    case Method::Cholmod:
        return "cholmod";
    case Method::Gradients:
        return "cg";
    case Method::Amg:
        return "amg";
    }
    return {};
}

double MethodResult::step_seconds() const
{
    return median(steps.size() > 1 ? std::vector(steps.begin() + 1, steps.end()) : steps);
}

double MethodResult::total_seconds() const
{
    return std::accumulate(steps.begin(), steps.end(), setup_seconds);
}

MethodResult failed(std::string error)
{
    MethodResult result;
    result.error = std::move(error);
    return result;
}

}  // namespace seamflow
