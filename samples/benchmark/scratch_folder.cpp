#include "samples/benchmark/scratch_folder.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <string>
#include <system_error>

#include <unistd.h>

#include "partition/errors.h"

namespace seamflow {

namespace {

namespace fs = std::filesystem;

constexpr std::array all_files{"task",       "result",     "report.json", "input.obj", "input.ply",
                               "output.obj", "output.off", "output.ply",  "output.stl"};

/// The files to remove when the program is told to stop. A signal handler can only use text that already exists.
struct Remains {
    std::array<std::string, all_files.size()> files;
    std::string folder;
};

Remains& remains()
{
    static Remains remains;
    return remains;
}

void remove_and_stop(int signal)
{
    for (const std::string& file : remains().files)
        unlink(file.c_str());
    rmdir(remains().folder.c_str());
    std::signal(signal, SIG_DFL);
    raise(signal);
}

/// @param folder empty: none any more.
void remove_when_stopped(const fs::path& folder)
{
    constexpr std::array signals{SIGHUP, SIGINT, SIGTERM};
    if (folder.empty()) {
        for (const int signal : signals)
            if (std::signal(signal, SIG_DFL) == SIG_IGN)
                std::signal(signal, SIG_IGN);
        return;
    }
    std::transform(all_files.begin(), all_files.end(), remains().files.begin(),
                   [&](const char* file) { return (folder / file).string(); });
    remains().folder = folder.string();
    for (const int signal : signals)
        if (std::signal(signal, remove_and_stop) == SIG_IGN)
            std::signal(signal, SIG_IGN);
}

}  // namespace

ScratchFolder::ScratchFolder()
{
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "benchmark-XXXXXX").string();
    if (error || mkdtemp(name.data()) == nullptr)
        throw OutputError(name + ": cannot create a folder for temporary files; set TMPDIR");
    path_ = name;
    remove_when_stopped(path_);
}

ScratchFolder::~ScratchFolder()
{
    remove_when_stopped({});
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace seamflow
