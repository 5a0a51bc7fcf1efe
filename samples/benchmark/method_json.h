#pragma once

#include <nlohmann/json.hpp>

#include "samples/benchmark/methods/method.h"

namespace seamflow {

/// A task and a result in the form in which processes exchange them; the positions go another way.
nlohmann::json task_json(const MethodTask& task);
MethodTask task_of(const nlohmann::json& json);
nlohmann::json result_json(const MethodResult& result);
MethodResult result_of(const nlohmann::json& json);

}  // namespace seamflow
