#pragma once

#include "partition/errors.h"

namespace seamflow {

/// Refuses work after a failure, which leaves nothing to continue from.
class FailureGuard {
  public:
    /// Calls work(). After an exception from it, further work is refused.
    /// @throws ComputationError after a failure.
    template <class Work>
    void run(Work&& work)
    {
        require_sound();
        has_failed_ = true;
        work();
        has_failed_ = false;
    }

    /// The same for work that refuses its input before it changes anything: an OptionError or InputError is no failure.
    template <class Work>
    void run_checked(Work&& work)
    {
        require_sound();
        has_failed_ = true;
        try {
            work();
        } catch (const OptionError&) {
            has_failed_ = false;
            throw;
        } catch (const InputError&) {
            has_failed_ = false;
            throw;
        }
        has_failed_ = false;
    }

  private:
    void require_sound() const
    {
        if (has_failed_)
            throw ComputationError(
                "an earlier step has failed, which leaves nothing to continue from: begin a new flow");
    }

    bool has_failed_ = false;
};

}  // namespace seamflow
