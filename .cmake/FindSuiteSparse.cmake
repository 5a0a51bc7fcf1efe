# SuiteSparse::AMD and so on for the COMPONENTS that are asked for; SuiteSparse_TARGETS lists them. SuiteSparse before
# version 7, as in Debian 12, brings no files by which CMake would find it.
find_path(SUITESPARSE_INCLUDE_DIR amd.h PATH_SUFFIXES suitesparse)
set(SuiteSparse_LIBRARIES_NEEDED ${SuiteSparse_FIND_COMPONENTS})
list(TRANSFORM SuiteSparse_LIBRARIES_NEEDED APPEND _LIBRARY)
foreach(library IN LISTS SuiteSparse_FIND_COMPONENTS)
    string(TOLOWER ${library} name)
    find_library(${library}_LIBRARY ${name})
endforeach()
mark_as_advanced(SUITESPARSE_INCLUDE_DIR ${SuiteSparse_LIBRARIES_NEEDED})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS ${SuiteSparse_LIBRARIES_NEEDED} SUITESPARSE_INCLUDE_DIR)

set(SuiteSparse_TARGETS ${SuiteSparse_FIND_COMPONENTS})
list(TRANSFORM SuiteSparse_TARGETS PREPEND SuiteSparse::)
foreach(library IN LISTS SuiteSparse_FIND_COMPONENTS)
    if(SuiteSparse_FOUND AND NOT TARGET SuiteSparse::${library})
        add_library(SuiteSparse::${library} UNKNOWN IMPORTED)
        set_target_properties(SuiteSparse::${library} PROPERTIES
            IMPORTED_LOCATION "${${library}_LIBRARY}"
            INTERFACE_INCLUDE_DIRECTORIES "${SUITESPARSE_INCLUDE_DIR}")
    endif()
endforeach()
unset(SuiteSparse_LIBRARIES_NEEDED)
