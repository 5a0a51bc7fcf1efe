#include "engine/tasks/schedule.h"

namespace seamflow {

std::string_view name_of(TaskKind kind)
{
    switch (kind) {
    case TaskKind::AssembleAndFactorise:
        return "assemble and factorise";
    case TaskKind::Predict:
        return "predict";
    case TaskKind::UsePredictions:
        return "use predictions";
    case TaskKind::Solve:
        return "solve";
    case TaskKind::Accept:
        return "accept";
    case TaskKind::Condense:
        return "condense";
    case TaskKind::SolveInterface:
        return "solve on the interface";
    case TaskKind::BackSubstitute:
        return "back-substitute";
    }
    return "";
}

bool has_priority(TaskKind kind)
{
    return kind == TaskKind::Predict || kind == TaskKind::UsePredictions || kind == TaskKind::Solve ||
           kind == TaskKind::Accept;
}

}  // namespace seamflow
