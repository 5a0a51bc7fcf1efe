#include <optional>
#include <string>
#include <vector>

#include "partition/formats/moved_normals.h"
#include "partition/formats/off.h"
#include "partition/formats/off_binary.h"
#include "partition/formats/off_header.h"
#include "partition/formats/splicer.h"

namespace seamflow {

namespace {

void rewrite_text(Splicer& splicer, TextScanner& scanner, const PolygonMesh& mesh,
                  const std::optional<MovedNormals>& normals)
{
    for (Index v = 0; v < mesh.n_vertices(); ++v) {
        scanner.next_line();
        exchange_position(scanner, splicer, mesh.vertices.row(v));
        if (!normals)
            continue;
        const WrittenNormal given = read_normal(scanner);
        if (const auto now = normals->around_vertex(v, given.value))
            exchange_normal(splicer, given, *now);
    }
    splicer.finish();
}

}  // namespace

std::vector<std::string> rewrite_off(OutputFile& file, const std::filesystem::path& path, std::string_view content,
                                     const PolygonMesh& mesh)
{
    if (const auto data = start_of_binary_off(content)) {
        if (rewrite_binary_off(file, content, *data, mesh))
            return {rounding_remark(path)};
        return {};
    }
    TextScanner scanner(path, content);
    std::optional<MovedNormals> normals;
    if (read_off_header(scanner).has_normals())
        normals.emplace(mesh, read_off(path, content).vertices);
    Splicer splicer(file, content);
    rewrite_text(splicer, scanner, mesh, normals);
    return {};
}

}  // namespace seamflow
