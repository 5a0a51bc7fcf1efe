# SuiteSparse::UMFPACK, CHOLMOD, AMD and CAMD. SuiteSparse before version 7, as in Debian 12, brings no files by which
# CMake would find it.
find_path(SUITESPARSE_INCLUDE_DIR umfpack.h PATH_SUFFIXES suitesparse)
set(SuiteSparse_LIBRARIES_NEEDED UMFPACK_LIBRARY CHOLMOD_LIBRARY AMD_LIBRARY CAMD_LIBRARY)
foreach(variable IN LISTS SuiteSparse_LIBRARIES_NEEDED)
    string(REPLACE "_LIBRARY" "" library ${variable})
    string(TOLOWER ${library} name)
    find_library(${variable} ${name})
endforeach()
mark_as_advanced(SUITESPARSE_INCLUDE_DIR ${SuiteSparse_LIBRARIES_NEEDED})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS ${SuiteSparse_LIBRARIES_NEEDED} SUITESPARSE_INCLUDE_DIR)

foreach(variable IN LISTS SuiteSparse_LIBRARIES_NEEDED)
    string(REPLACE "_LIBRARY" "" library ${variable})
    if(SuiteSparse_FOUND AND NOT TARGET SuiteSparse::${library})
        add_library(SuiteSparse::${library} UNKNOWN IMPORTED)
        set_target_properties(SuiteSparse::${library} PROPERTIES
            IMPORTED_LOCATION "${${variable}}"
            INTERFACE_INCLUDE_DIRECTORIES "${SUITESPARSE_INCLUDE_DIR}")
    endif()
endforeach()
unset(SuiteSparse_LIBRARIES_NEEDED)
