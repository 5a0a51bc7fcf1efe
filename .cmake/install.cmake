# What `cmake --install` puts where, and how programs find it there: find_package(seamflow), pkg-config seamflow.
# Headers keep their folders, under include/seamflow: #include "engine/mean_curvature_flow.h" is the same everywhere.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/seamflow)
# Installed are the headers of the library call and what they include; the test consumer.headers checks that none of
# these is missing.
set(distributed_headers "")
if(TARGET seamflow_distributed)
    list(APPEND distributed_headers
        engine/distributed/communicator.h
        engine/distributed/conversation.h
        engine/distributed/deal.h
        engine/distributed/distributed_cut.h
        engine/distributed/distributed_flow.h
        engine/distributed/mesh_part.h
        engine/distributed/mpi_communicator.h
        engine/distributed/packing.h
        engine/distributed/shared_mesh_file.h
        engine/distributed/slice_measures.h
        engine/distributed/thread_communicator.h
        engine/distributed/whole_mesh.h)
endif()
foreach(header IN ITEMS
        ${distributed_headers}
        engine/eigen.h
        engine/mean_curvature_flow.h
        engine/measure/displacement_meter.h
        engine/openmesh.h
        engine/options/flow_control.h
        engine/options/flow_options.h
        engine/options/flow_report.h
        engine/options/schedule.h
        engine/state/checkpoint.h
        engine/state/flow_identity.h
        engine/state/flow_state.h
        engine/tasks/parallel_loop.h
        partition/eigen.h
        partition/errors.h
        partition/formats/mesh_io.h
        partition/formats/palette.h
        partition/index.h
        partition/io/fault_log.h
        partition/loop.h
        partition/metrics/displacement.h
        partition/metrics/length_statistics.h
        partition/metrics/roughness.h
        partition/metrics/surface_distance.h
        partition/metrics/vertex_distance.h
        partition/metrics/vertex_normals.h
        partition/openmesh.h
        partition/polygon_mesh.h
        partition/topology.h
        partition/vector_area.h
        partition/version.h
        solvers/conditions/robin_parameter.h
        solvers/direct/factorisation.h
        solvers/laplacian/laplacian.h)
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${PROJECT_SOURCE_DIR}/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/seamflow/${folder})
endforeach()
set(installed_libraries partition solvers engine)
if(TARGET seamflow_distributed)
    list(APPEND installed_libraries distributed)
endif()
foreach(folder IN LISTS installed_libraries)
    set_target_properties(seamflow_${folder} PROPERTIES INSTALL_RPATH $ORIGIN)
    install(TARGETS seamflow_${folder} EXPORT seamflow-${folder})
    install(EXPORT seamflow-${folder} DESTINATION ${package_dir} NAMESPACE seamflow::
        FILE seamflow-${folder}-targets.cmake)
endforeach()

if(BUILD_SHARED_LIBS)
    set(SEAMFLOW_IS_SHARED TRUE)
else()
    set(SEAMFLOW_IS_SHARED FALSE)
endif()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/seamflowConfig.cmake.in
    ${PROJECT_BINARY_DIR}/seamflowConfig.cmake INSTALL_DESTINATION ${package_dir}
    NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# Before 1.0.0 a new minor version may break what worked; the patch may not.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/seamflowConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
        ${PROJECT_BINARY_DIR}/seamflowConfig.cmake
        ${PROJECT_BINARY_DIR}/seamflowConfigVersion.cmake
        ${CMAKE_CURRENT_LIST_DIR}/FindMETIS.cmake
        ${CMAKE_CURRENT_LIST_DIR}/FindSuiteSparse.cmake
        ${CMAKE_CURRENT_LIST_DIR}/FindxxHash.cmake
    DESTINATION ${package_dir})

# The file for pkg-config finds its prefix from where it lies. Whoever links static libraries links what they use, with
# `pkg-config --static` or without; what shared libraries use is theirs alone.
set(used "")
set(known_folders ${CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES})
foreach(library IN LISTS UMFPACK_LIBRARY CHOLMOD_LIBRARY AMD_LIBRARY CAMD_LIBRARY METIS_LIBRARY XXHASH_LIBRARY)
    cmake_path(GET library PARENT_PATH folder)
    if(NOT folder IN_LIST known_folders)
        string(APPEND used " -L${folder}")
        list(APPEND known_folders ${folder})
    endif()
    cmake_path(GET library STEM name)
    string(REGEX REPLACE "^lib" " -l" name ${name})
    string(APPEND used ${name})
endforeach()
foreach(library IN LISTS CMAKE_DL_LIBS)
    string(APPEND used " -l${library}")
endforeach()
if(BUILD_SHARED_LIBS)
    set(SEAMFLOW_PC_REQUIRES_PRIVATE " tbb >= 2021, fmt >= 9, zlib")
    set(SEAMFLOW_PC_LIBS_PRIVATE "${used}")
else()
    set(SEAMFLOW_PC_REQUIRES ", tbb >= 2021, fmt >= 9, zlib")
    set(SEAMFLOW_PC_LIBS "${used}")
endif()
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/pkgconfig
    OUTPUT_VARIABLE SEAMFLOW_PC_PREFIX)
configure_file(${CMAKE_CURRENT_LIST_DIR}/seamflow.pc.in ${PROJECT_BINARY_DIR}/seamflow.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/seamflow.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(SEAMFLOW_BUILD_SAMPLES)
    cmake_path(RELATIVE_PATH CMAKE_INSTALL_LIBDIR BASE_DIRECTORY ${CMAKE_INSTALL_BINDIR} OUTPUT_VARIABLE to_libraries)
    set(installed_programs smooth compare generate inspect)
    if(TARGET smooth-distributed)
        list(APPEND installed_programs smooth-distributed)
    endif()
    set_target_properties(${installed_programs} PROPERTIES INSTALL_RPATH $ORIGIN/${to_libraries})
    install(TARGETS ${installed_programs})
endif()
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
