# What `cmake --install` puts where, and how programs find it there: find_package(seamflow), pkg-config seamflow.
# Headers keep their folders, under include/seamflow: #include <seamflow/engine/mean_curvature_flow.h>.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/seamflow)
foreach(header IN LISTS SEAMFLOW_HEADERS)
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${PROJECT_BINARY_DIR}/include/seamflow/${header}
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/seamflow/${folder})
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
set(used_libraries ${SEAMFLOW_SUITESPARSE} METIS XXHASH)
list(TRANSFORM used_libraries APPEND _LIBRARY)
set(known_folders ${CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES})
foreach(library IN LISTS ${used_libraries})
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
    set(installed_programs smooth compare generate inspect figures)
    if(TARGET benchmark)
        list(APPEND installed_programs benchmark)
    endif()
    if(TARGET smooth-distributed)
        list(APPEND installed_programs smooth-distributed)
    endif()
    set_target_properties(${installed_programs} PROPERTIES INSTALL_RPATH $ORIGIN/${to_libraries})
    install(TARGETS ${installed_programs})
    install(DIRECTORY ${PROJECT_BINARY_DIR}/share/man/ DESTINATION ${CMAKE_INSTALL_MANDIR})
    install(DIRECTORY ${PROJECT_BINARY_DIR}/share/bash-completion ${PROJECT_BINARY_DIR}/share/zsh
        DESTINATION ${CMAKE_INSTALL_DATAROOTDIR})
endif()

# Documents keep their folders, so that their links lead somewhere, and programs to copy from lie among them.
file(GLOB documents RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS LICENSE *.md engine/*.md samples/*.md samples/*/*.md
    samples/*/pictures/*.png samples/library/*.cpp samples/figures/draw.py samples/gallery/make_gallery.py
    samples/python/example.py)
foreach(document IN LISTS documents)
    cmake_path(GET document PARENT_PATH folder)
    install(FILES ${PROJECT_SOURCE_DIR}/${document} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder})
endforeach()
