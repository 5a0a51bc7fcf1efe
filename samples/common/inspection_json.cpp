#include "samples/common/inspection_json.h"

#include <nlohmann/json.hpp>

namespace seamflow {

std::string inspection_json(const std::string& file, const FaultLog& faults, const MeshInspection& found)
{
    using Json = nlohmann::ordered_json;
    const auto& sides = found.counts.faces_by_sides;
    const MeshDefects& defects = found.defects;
    const Json json{
        {"file", file},
        {"vertices", found.counts.vertices},
        {"edges", found.counts.edges},
        {"faces", found.counts.faces},
        {"faces_by_sides", {{"3", sides[0]}, {"4", sides[1]}, {"5", sides[2]}, {"6", sides[3]}, {"more", sides[4]}}},
        {"components", found.counts.components},
        {"boundary_edges", found.counts.boundary_edges},
        {"shortest_edge", found.edge_lengths.shortest},
        {"mean_edge", found.edge_lengths.mean},
        {"longest_edge", found.edge_lengths.longest},
        {"middle", found.box.middle},
        {"diagonal", found.box.diagonal},
        {"bits_for_detail", found.bits_for_detail},
        {"orientable", found.orientable},
        {"faults", faults.count},
        {"fault_messages", faults.messages},
        {"vertices_not_finite", defects.vertices_not_finite},
        {"non_manifold_edges", defects.non_manifold_edges},
        {"non_manifold_vertices", defects.non_manifold_vertices},
        {"inconsistent_edges", defects.inconsistent_edges},
        {"duplicate_faces", defects.duplicate_faces},
        {"faces_without_area", defects.faces_without_area},
        {"edges_without_length", defects.edges_without_length},
        {"coincident_vertices", defects.coincident_vertices},
        {"isolated_vertices", defects.isolated_vertices},
    };
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace seamflow
