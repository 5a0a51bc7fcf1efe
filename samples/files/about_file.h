#pragma once

#include <filesystem>

#include "partition/errors.h"

namespace seamflow {

/// Errors in a mesh are reported with the name of its file.
template <class Action>
auto about_file(const std::filesystem::path& path, Action&& action)
{
    try {
        return action();
    } catch (const InputError& error) {
        throw InputError(Wording{unmarked(path.string() + ": ").text + error.wording().text});
    }
}

}  // namespace seamflow
