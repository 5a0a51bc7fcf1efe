#include "samples/figures/drawing.h"

#include <cstdlib>
#include <sstream>

#include <unistd.h>

#include "partition/errors.h"
#include "samples/figures/embedded_files.h"
#include "samples/files/output_files.h"
#include "samples/process/process.h"

namespace seamflow {

namespace {

/// Ends with 1, and without words, where Matplotlib is missing, broken or older than 3.6.
constexpr const char* has_matplotlib = "try:\n"
                                       "    import matplotlib.layout_engine\n"
                                       "except Exception:\n"
                                       "    raise SystemExit(1)\n";

/// The first python3 on the PATH that has Matplotlib.
std::string find_python()
{
    const char* folders = std::getenv("PATH");
    std::istringstream path(folders == nullptr ? "" : folders);
    for (std::string folder; std::getline(path, folder, ':');) {
        const std::string python = folder + "/python3";
        if (access(python.c_str(), X_OK) == 0 && run_process(python, {python, "-c", has_matplotlib}, 1).failure.empty())
            return python;
    }
    return {};
}

}  // namespace

Drawing::Drawing(const std::filesystem::path& folder)
    : script_(folder / "draw.py")
    , python_(find_python())
{
    write_text(script_, std::string(draw_script()));
}

void Drawing::draw(const std::string& name) const
{
    if (python_.empty())
        return;
    const std::string script = std::filesystem::absolute(script_).string();
    const ProcessEnd end = run_process(python_, {python_, "-B", script, name}, 1);
    if (!end.failure.empty())
        throw OutputError(name + " cannot be drawn: " + python_ + " " + script_.string() + " " + end.failure);
}

std::string Drawing::remark() const
{
    if (!python_.empty())
        return {};
    const std::string command = "python3 " + script_.string();
    return "There are no pictures without Matplotlib: install it (Debian: apt-get install python3-matplotlib), then "
           "run " +
           command;
}

}  // namespace seamflow
