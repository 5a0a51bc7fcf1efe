# The headers for others: those of the library call and what they include. In the sources they include each other by
# their folders; copies in include/ of the build folder do so with seamflow/ before that, for programs that say
# #include <seamflow/engine/mean_curvature_flow.h>, with an installed library or one that is built along. The test
# consumer.headers checks that none is missing.
set(SEAMFLOW_HEADERS
    engine/denoise.h
    engine/denoise/denoise_options.h
    engine/denoise/denoise_report.h
    engine/diffuse.h
    engine/eigen.h
    engine/fields/field_options.h
    engine/fields/heat_equation.h
    engine/geodesic_distance.h
    engine/mean_curvature_flow.h
    engine/openmesh.h
    engine/options/approach.h
    engine/options/flow_control.h
    engine/options/flow_options.h
    engine/options/motion_options.h
    engine/measure/flow_report.h
    engine/measure/run_report.h
    engine/ranks/rank_group.h
    engine/ranks/transport.h
    engine/tasks/schedule.h
    engine/setup/presets.h
    engine/measure/smoothed_radius.h
    engine/state/checkpoint.h
    engine/tasks/parallel_executor.h
    partition/eigen.h
    partition/errors.h
    partition/formats/file_fields.h
    partition/formats/mesh_file.h
    partition/formats/mesh_io.h
    partition/formats/palette.h
    partition/index.h
    partition/io/fault_log.h
    partition/executor.h
    partition/metrics/length_statistics.h
    partition/metrics/surface_distance.h
    partition/metrics/vertex_distance.h
    partition/openmesh.h
    partition/polygon_mesh.h
    partition/remark.h
    partition/vector_area.h
    partition/version.h
    solvers/conditions/robin_edge.h
    solvers/direct/factorisation.h
    solvers/filters/step_filter.h
    solvers/laplacian/laplacian.h
    solvers/laplacian/laplacian_kind.h)

function(seamflow_copy_headers)
    foreach(header IN LISTS SEAMFLOW_HEADERS)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
        file(READ ${header} content)
        string(REGEX REPLACE "#include \"((partition|solvers|engine)/[^\"]+)\"" "#include <seamflow/\\1>"
            content "${content}")
        file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/include/seamflow/${header} CONTENT "${content}" @ONLY)
    endforeach()
endfunction()
seamflow_copy_headers()
