#pragma once

#include <string>

#include "partition/errors.h"

namespace seamflow {

/// Calls body(); a ComputationError from it gets a name before its message.
template <class Body>
void named(const std::string& name, Body&& body)
{
    try {
        body();
    } catch (const ComputationError& error) {
        throw ComputationError(name + ", " + error.what());
    }
}

}  // namespace seamflow
