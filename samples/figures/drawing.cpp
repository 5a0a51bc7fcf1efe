#include "samples/figures/drawing.h"

#include <cstdlib>
#include <sstream>
#include <system_error>
#include <vector>

#include <unistd.h>

#include "partition/errors.h"
#include "samples/figures/embedded_files.h"
#include "samples/files/output_files.h"
#include "samples/process/process.h"

namespace fs = std::filesystem;

namespace seamflow {

namespace {

/// The first python3 on the PATH with which a script can draw.
std::string find_python(const std::string& script)
{
    const char* folders = std::getenv("PATH");
    std::istringstream path(folders == nullptr ? "" : folders);
    for (std::string folder; std::getline(path, folder, ':');) {
        const std::string python = folder + "/python3";
        if (access(python.c_str(), X_OK) == 0 &&
            run_process(python, {python, "-B", script, "--check"}, 1).failure.empty())
            return python;
    }
    return {};
}

/// A word as a shell reads it, in quotation marks where it needs them.
std::string word_for_shell(const std::string& word)
{
    constexpr const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./-+,:@%";
    if (word.find_first_not_of(plain) == std::string::npos)
        return word;
    std::string quoted = "'";
    for (const char c : word)
        quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

/// Whether draw.py makes a file of that name for a table.
bool is_picture_of(const std::string& table, const fs::path& file)
{
    return file == table + "-curves.svg" || file == table + "-width.svg" ||
           (file.extension() == ".png" && file.string().starts_with(table + "-"));
}

}  // namespace

Drawing::Drawing(const fs::path& folder)
    : script_(folder / "draw.py")
{
    write_text(script_, std::string(draw_script()));
    python_ = find_python(fs::absolute(script_).string());
}

void Drawing::draw(const std::string& name) const
{
    if (python_.empty()) {
        remove_pictures(name);
        return;
    }
    const ProcessEnd end = run_process(python_, {python_, "-B", fs::absolute(script_).string(), name}, 1);
    if (!end.failure.empty())
        throw OutputError(name + " cannot be drawn: " + python_ + " " + script_.string() + " " + end.failure);
}

void Drawing::remove_pictures(const std::string& name) const
{
    std::vector<fs::path> old;
    for (const auto& entry : fs::directory_iterator(fs::absolute(script_).parent_path()))
        if (is_picture_of(name, entry.path().filename()))
            old.push_back(entry.path());
    for (const fs::path& picture : old) {
        std::error_code failure;
        fs::remove(picture, failure);
        if (failure)
            throw OutputError(picture.string() + ": cannot be removed: " + failure.message());
    }
}

std::string Drawing::remark() const
{
    return remark_with("python3 " + word_for_shell(script_.string()));
}

std::string Drawing::remark_on_page() const
{
    return remark_with("python3 " + script_.filename().string() + ", run in the folder of this page,");
}

std::string Drawing::remark_with(const std::string& command) const
{
    if (!python_.empty())
        return {};
    return "The pictures were not drawn, for lack of Matplotlib: install it (Debian: apt-get install "
           "python3-matplotlib); " +
           command + " draws them";
}

}  // namespace seamflow
