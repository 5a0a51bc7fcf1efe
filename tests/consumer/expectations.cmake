# What holds in a project that has taken in seamflow: nothing of how it is compiled itself shows, no test and no program
# of it came along.

function(expect_nothing what)
    if(ARGN)
        message(SEND_ERROR "${what}: ${ARGN}")
    endif()
endfunction()

foreach(component IN ITEMS partition solvers engine)
    if(NOT TARGET seamflow::${component})
        message(SEND_ERROR "there is no target seamflow::${component}")
    endif()
    foreach(property IN ITEMS INTERFACE_COMPILE_OPTIONS INTERFACE_COMPILE_DEFINITIONS INTERFACE_LINK_OPTIONS)
        get_target_property(value seamflow::${component} ${property})
        if(value)
            expect_nothing("seamflow::${component} brings ${property}" ${value})
        endif()
    endforeach()
endforeach()

foreach(property IN ITEMS COMPILE_OPTIONS COMPILE_DEFINITIONS INCLUDE_DIRECTORIES LINK_OPTIONS TESTS)
    get_directory_property(value ${property})
    expect_nothing("the directory has ${property}" ${value})
endforeach()
foreach(variable IN ITEMS CMAKE_BUILD_TYPE CMAKE_RUNTIME_OUTPUT_DIRECTORY CMAKE_MODULE_PATH CMAKE_CXX_STANDARD BUILD_TESTING)
    if(NOT "${${variable}}" STREQUAL "${EXPECTED_${variable}}")
        message(SEND_ERROR "${variable} is \"${${variable}}\", not \"${EXPECTED_${variable}}\"")
    endif()
endforeach()

if(SEAMFLOW_SOURCE)
    get_directory_property(tests DIRECTORY "${SEAMFLOW_SOURCE}" TESTS)
    expect_nothing("tests came along" ${tests})
    foreach(target IN ITEMS smooth generate seamflow_sample_meshes partition_tests doc)
        if(TARGET ${target})
            message(SEND_ERROR "the target ${target} came along")
        endif()
    endforeach()
    return()
endif()

# Of packages that do not fit find_package says why.
foreach(version IN ITEMS 0.2 1.0)
    find_package(seamflow ${version} QUIET)
    if(seamflow_FOUND)
        message(SEND_ERROR "0.1 was taken for ${version}")
    endif()
endforeach()
find_package(seamflow QUIET COMPONENTS partition OPTIONAL_COMPONENTS gui)
if(NOT seamflow_FOUND OR NOT seamflow_partition_FOUND OR seamflow_gui_FOUND)
    message(SEND_ERROR "an optional component that there is not")
endif()
find_package(seamflow QUIET COMPONENTS gui)
if(seamflow_FOUND OR NOT seamflow_NOT_FOUND_MESSAGE MATCHES "no component \"gui\"")
    message(SEND_ERROR "a component that there is not: ${seamflow_NOT_FOUND_MESSAGE}")
endif()
# Who has not the language C can do without ranks (shared libraries know their MPI); who has it gets them where they are.
find_package(seamflow QUIET COMPONENTS engine OPTIONAL_COMPONENTS distributed)
if(NOT seamflow_FOUND)
    message(SEND_ERROR "no engine without ranks: ${seamflow_NOT_FOUND_MESSAGE}")
else()
    get_target_property(kind seamflow::engine TYPE)
    if(seamflow_distributed_FOUND AND NOT kind STREQUAL "SHARED_LIBRARY")
        message(SEND_ERROR "ranks without MPI")
    endif()
endif()
if(EXISTS "${seamflow_DIR}/seamflow-distributed-targets.cmake")
    enable_language(C)
    find_package(seamflow REQUIRED COMPONENTS distributed)
    file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/ranks.cpp" [[
#include <atomic>
#include <seamflow/engine/ranks/rank_group.h>
#include <seamflow/engine/ranks/transport.h>
int main(int argc, char**)
{
    std::atomic<int> n = 0;
    seamflow::run_on_threads(3, [&](seamflow::Transport& ranks) { n += ranks.size(); });
    return argc > 9 ? seamflow::make_mpi_transport()->rank() : n == 9 ? 0 : 1;
}
]])
    add_executable(ranks "${CMAKE_CURRENT_BINARY_DIR}/ranks.cpp")
    target_link_libraries(ranks PRIVATE seamflow::distributed)
    add_custom_command(TARGET ranks POST_BUILD COMMAND ranks)
endif()
