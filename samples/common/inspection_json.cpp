#include "samples/common/inspection_json.h"

#include <nlohmann/json.hpp>

namespace seamflow {

std::string inspection_json(const std::string& file, const FaultLog& faults, const MeshInspection& found)
{
    using Json = nlohmann::ordered_json;
    const auto& sides = found.faces_by_sides;
    const Json json{
        {"file", file},
        {"vertices", found.vertices},
        {"edges", found.edges},
        {"faces", found.faces},
        {"faces_by_sides", {{"3", sides[0]}, {"4", sides[1]}, {"5", sides[2]}, {"6", sides[3]}, {"more", sides[4]}}},
        {"components", found.components},
        {"boundary_edges", found.boundary_edges},
        {"shortest_edge", found.shortest_edge},
        {"mean_edge", found.mean_edge},
        {"longest_edge", found.longest_edge},
        {"middle", found.middle},
        {"diagonal", found.diagonal},
        {"bits_for_detail", found.bits_for_detail},
        {"orientable", found.orientable},
        {"faults", faults.count},
        {"fault_messages", faults.messages},
        {"vertices_not_finite", found.vertices_not_finite},
        {"non_manifold_edges", found.non_manifold_edges},
        {"non_manifold_vertices", found.non_manifold_vertices},
        {"inconsistent_edges", found.inconsistent_edges},
        {"duplicate_faces", found.duplicate_faces},
        {"faces_without_area", found.faces_without_area},
        {"edges_without_length", found.edges_without_length},
        {"coincident_vertices", found.coincident_vertices},
        {"isolated_vertices", found.isolated_vertices},
    };
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace seamflow
