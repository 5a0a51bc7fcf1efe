#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "partition/io/fault_log.h"

namespace seamflow {

/// A reader's position in its file; every complaint about the file begins with it.
class InputPosition {
  public:
    virtual ~InputPosition() = default;

    /// @param complaint what is wrong, a semicolon, and what to do about it.
    /// @throws InputError "path:line: complaint" for text, "path: element, byte: complaint" for binary data.
    [[noreturn]] void fail(const std::string& complaint) const;

    /// Reports a fault that does not end reading.
    /// @throws InputError as `fail` does, unless faults are noted.
    void fault(const std::string& complaint) const;
    /// The same for a fault of a face or a row that leaves no doubt about the rest (see FaultLog::of_faces_alone).
    void harmless_fault(const std::string& complaint) const;
    /// Notes that a face is left out.
    /// @param f its number in the file.
    void leave_out_face(Index f) const;

    /// Notes faults in `log` from now on; it must outlive the reading.
    void note_faults_in(FaultLog* log) { log_ = log; }
    [[nodiscard]] bool notes_faults() const { return log_ != nullptr && !log_->of_faces_alone; }

  protected:
    InputPosition() = default;
    InputPosition(const InputPosition&) = default;
    InputPosition& operator=(const InputPosition&) = default;

  private:
    [[nodiscard]] virtual std::string position() const = 0;

    FaultLog* log_ = nullptr;
};

/// A part of a file for a message: shortened, and with '?' for unprintable bytes.
std::string printable(std::string_view text);

/// The same in quotation marks.
std::string in_quotes(std::string_view text);

/// "1 vertex", "3 vertices": a count and the word for what is counted.
std::string counted(std::uint64_t count, const std::string& singular, const std::string& plural);

/// With a to z for A to Z.
std::string lower_case(std::string_view text);

/// Appends `what` unless it is there.
void add_once(std::vector<std::string>& list, std::string_view what);

}  // namespace seamflow
