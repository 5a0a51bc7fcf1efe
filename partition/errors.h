#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "partition/remark.h"

namespace seamflow {

/// An error whose message may name options. what() names them as the library does.
template <class Standard>
class ErrorOnOptions : public Standard {
  public:
    explicit ErrorOnOptions(const std::string& text)
        : ErrorOnOptions(unmarked(text))
    {
    }

    explicit ErrorOnOptions(Wording wording)
        : Standard(sentence(wording))
        , wording_(std::move(wording))
    {
    }

    /// The message with marked options, for callers that have other names for the options.
    [[nodiscard]] const Wording& wording() const { return wording_; }

  private:
    Wording wording_;
};

/// Thrown for a mesh, a label file or any other data that cannot be used as it is. The message names the file and the
/// line, or the element, and a remedy. The programs end with exit status 3.
class InputError : public ErrorOnOptions<std::runtime_error> {
  public:
    using ErrorOnOptions::ErrorOnOptions;
};

/// Thrown for an option outside its limits (such as a time step of zero). The programs end with exit status 2.
class OptionError : public ErrorOnOptions<std::invalid_argument> {
  public:
    using ErrorOnOptions::ErrorOnOptions;
};

/// Thrown if the data that a flow needs at once do not fit into its memory limit.
class MemoryLimitError : public OptionError {
  public:
    using OptionError::OptionError;
};

/// Thrown if the computation fails: a singular system, a result that is not finite, not enough memory. The message
/// names the sub-mesh, or the file. The programs end with exit status 4.
class ComputationError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Thrown if the work was stopped on request before its end; not a failure.
class Cancelled : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Thrown if a result could not be written. The message names the file. The programs end with exit status 5.
class OutputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace seamflow
