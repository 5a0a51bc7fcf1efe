#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "partition/io/fault_log.h"

namespace seamflow {

/// A reader's position in its file, with which every message about the file begins.
class InputPosition {
  public:
    virtual ~InputPosition() = default;

    /// @param complaint the fault, a semicolon, and a remedy.
    /// @throws InputError "path:line: complaint" for text, "path: element, byte: complaint" for binary data.
    [[noreturn]] void fail(const std::string& complaint) const;
    /// @param complaint with {} for each of `parts`.
    template <class... Parts>
    [[noreturn]] void fail(fmt::format_string<const Parts&...> complaint, const Parts&... parts) const
    {
        fail(fmt::format(complaint, parts...));
    }

    /// Reports a fault after which reading can continue: collects it, or throws.
    /// @throws InputError as `fail` does, unless faults are collected.
    void fault(const std::string& complaint) const;
    /// Reports a fault of a face or a row that leaves no doubt about the rest (see FaultLog::of_faces_alone).
    /// @throws InputError as `fail` does, unless such faults are collected.
    void harmless_fault(const std::string& complaint) const;
    /// Records that a face is left out.
    /// @param f its number in the file.
    void leave_out_face(Index f) const;

    /// Collects faults in `log` from now on; it must outlive the reading.
    void note_faults_in(FaultLog* log) { log_ = log; }
    /// Whether all faults are collected, not only harmless ones.
    [[nodiscard]] bool notes_faults() const { return log_ != nullptr && !log_->of_faces_alone; }

  protected:
    InputPosition() = default;
    InputPosition(const InputPosition&) = default;
    InputPosition& operator=(const InputPosition&) = default;

  private:
    [[nodiscard]] virtual std::string position() const = 0;

    FaultLog* log_ = nullptr;
};

/// A piece of a file for a message: shortened, and with '?' for unprintable bytes.
std::string printable(std::string_view text);

/// A piece of a file for a message, as `printable` gives it, in quotation marks.
std::string in_quotes(std::string_view text);

}  // namespace seamflow
