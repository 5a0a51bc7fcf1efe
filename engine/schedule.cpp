#include "engine/schedule.h"

namespace seamflow {

std::string_view name_of(Phase phase)
{
    switch (phase) {
    case Phase::AssembleAndFactorise:
        return "assemble and factorise";
    case Phase::Predict:
        return "predict";
    case Phase::UsePredictions:
        return "use predictions";
    case Phase::Solve:
        return "solve";
    case Phase::Accept:
        return "accept";
    case Phase::Eliminate:
        return "eliminate";
    case Phase::SolveInterface:
        return "solve on the interface";
    case Phase::FillIn:
        return "fill in";
    }
    return "";
}

}  // namespace seamflow
