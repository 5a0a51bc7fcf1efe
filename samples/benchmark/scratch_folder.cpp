#include "samples/benchmark/scratch_folder.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <system_error>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "partition/errors.h"
#include "samples/benchmark/method_json.h"
#include "samples/files/output_files.h"

namespace seamflow {

namespace {

namespace fs = std::filesystem;

constexpr const char* mesh_file = "mesh.bin";
constexpr const char* task_file = "task.json";
constexpr const char* result_file = "result.json";
constexpr const char* positions_file = "positions.bin";
constexpr std::array all_files{mesh_file,    task_file,    result_file,  positions_file, "input.obj",  "input.ply",
                               "output.obj", "output.off", "output.ply", "output.stl",   "report.json"};

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

/// Arrays of numbers in one file, each after its length.
class ArrayWriter {
  public:
    explicit ArrayWriter(const fs::path& path)
        : path_(path)
        , file_(path, std::ios::binary)
    {
    }

    template <class Number>
    void write(const Number* values, std::size_t n)
    {
        file_.write(reinterpret_cast<const char*>(&n), sizeof n);
        file_.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(n * sizeof(Number)));
    }

    void close()
    {
        file_.close();
        if (!file_)
            throw OutputError(path_.string() + ": cannot be written; is there room for temporary files?");
    }

  private:
    fs::path path_;
    std::ofstream file_;
};

class ArrayReader {
  public:
    explicit ArrayReader(const fs::path& path)
        : path_(path)
        , file_(path, std::ios::binary)
    {
    }

    std::size_t read_length()
    {
        std::size_t n = 0;
        file_.read(reinterpret_cast<char*>(&n), sizeof n);
        require_good();
        return n;
    }

    template <class Number>
    void read(Number* values, std::size_t n)
    {
        file_.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(n * sizeof(Number)));
        require_good();
    }

    template <class Number>
    void read(std::vector<Number>& values)
    {
        values.resize(read_length());
        read(values.data(), values.size());
    }

    void read(Points& points)
    {
        points.resize(static_cast<Eigen::Index>(read_length() / 3), 3);
        read(points.data(), static_cast<std::size_t>(points.size()));
    }

  private:
    void require_good() const
    {
        if (!file_)
            throw InputError(path_.string() + ": cannot be read");
    }

    fs::path path_;
    std::ifstream file_;
};

nlohmann::json read_json(const fs::path& path)
{
    std::ifstream file(path);
    nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
    if (json.is_discarded())
        throw InputError(path.string() + ": cannot be read");
    return json;
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

void write_mesh_for_methods(const fs::path& folder, const PolygonMesh& mesh)
{
    ArrayWriter file(folder / mesh_file);
    file.write(mesh.vertices.data(), static_cast<std::size_t>(mesh.vertices.size()));
    file.write(mesh.face_offsets.data(), mesh.face_offsets.size());
    file.write(mesh.face_vertices.data(), mesh.face_vertices.size());
    file.close();
}

PolygonMesh read_mesh_for_methods(const fs::path& folder)
{
    PolygonMesh mesh;
    ArrayReader file(folder / mesh_file);
    file.read(mesh.vertices);
    file.read(mesh.face_offsets);
    file.read(mesh.face_vertices);
    return mesh;
}

void write_task(const fs::path& folder, const MethodTask& task)
{
    write_text(folder / task_file, task_json(task).dump());
}

MethodTask read_task(const fs::path& folder)
{
    return task_of(read_json(folder / task_file));
}

void write_result(const fs::path& folder, const MethodResult& result)
{
    ArrayWriter file(folder / positions_file);
    file.write(result.positions.data(), static_cast<std::size_t>(result.positions.size()));
    file.close();
    write_text(folder / result_file, result_json(result).dump());
}

MethodResult read_result(const fs::path& folder)
{
    MethodResult result = result_of(read_json(folder / result_file));
    ArrayReader(folder / positions_file).read(result.positions);
    return result;
}

}  // namespace seamflow
