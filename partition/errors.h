#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "partition/remark.h"

namespace seamflow {

/// An error whose message may name options. what() has the library's names of them.
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

    /// For callers that have other names.
    [[nodiscard]] const Wording& wording() const { return wording_; }

  private:
    Wording wording_;
};

/// A mesh, a label file or any other data that cannot be used as it is. The message names the file and the line,
/// or the element, and says what to do. The programs answer it with exit status 3.
class InputError : public ErrorOnOptions<std::runtime_error> {
  public:
    using ErrorOnOptions::ErrorOnOptions;
};

/// An option outside its limits (a time step of zero, say). The programs answer it with exit status 2.
class OptionError : public ErrorOnOptions<std::invalid_argument> {
  public:
    using ErrorOnOptions::ErrorOnOptions;
};

/// What a flow needs at once does not fit into its memory limit.
class MemoryLimitError : public OptionError {
  public:
    using OptionError::OptionError;
};

/// The work itself failed: a singular system, a result that is not finite, not enough memory. The message names the
/// sub-mesh, or the file.
/// The programs answer it with exit status 4.
class ComputationError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The work was stopped on request before its end; not a failure.
class Cancelled : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A result could not be written. The message names the file. The programs answer it with exit status 5.
class OutputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace seamflow
