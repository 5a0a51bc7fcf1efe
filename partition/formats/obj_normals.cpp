#include "partition/formats/obj_normals.h"

#include <charconv>
#include <numeric>

#include "partition/formats/obj.h"

namespace seamflow {

namespace {

constexpr Index none = -1;

/// The normal that a corner such as 7//2 or 7/1/-2 names, counted from 0; it need not be there.
/// @param n number of normals before this line.
Index normal_of(std::string_view corner, Index n)
{
    const auto first = corner.find('/');
    const auto second = first == std::string_view::npos ? first : corner.find('/', first + 1);
    if (second == std::string_view::npos)
        return none;
    corner.remove_prefix(second + 1);
    if (corner.starts_with('+'))
        corner.remove_prefix(1);
    Index number = 0;
    std::from_chars(corner.data(), corner.data() + corner.size(), number);
    return number > 0 ? number - 1 : number < 0 ? number + n : none;
}

/// Lists the corners of each normal.
/// @param normals one per corner; out of range: none.
ObjNormals sorted_by_normal(const std::vector<Index>& normals, Index n)
{
    const auto exists = [n](Index normal) { return normal >= 0 && normal < n; };
    ObjNormals result;
    result.offsets.assign(at(n) + 1, 0);
    for (const Index normal : normals)
        if (exists(normal))
            ++result.offsets[normal + 1];
    std::partial_sum(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
    result.corners.resize(result.offsets.back());
    std::vector<Index> next(result.offsets.begin(), result.offsets.end() - 1);
    for (std::size_t corner = 0; corner < normals.size(); ++corner)
        if (exists(normals[corner]))
            result.corners[next[normals[corner]]++] = static_cast<Index>(corner);
    return result;
}

}  // namespace

ObjNormals read_obj_normals(const std::filesystem::path& path, std::string_view text)
{
    TextScanner scanner(path, text, obj_syntax);
    std::vector<Index> normal_of_corner;
    Index n = 0;
    while (scanner.next_line()) {
        const std::string_view keyword = scanner.token();
        n += keyword == "vn" ? 1 : 0;
        if (is_obj_face(keyword))
            while (scanner.has_token())
                normal_of_corner.push_back(normal_of(scanner.token(), n));
    }
    return n > 0 ? sorted_by_normal(normal_of_corner, n) : ObjNormals{};
}

}  // namespace seamflow
