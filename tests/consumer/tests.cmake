# The library as others get it: installed, found, linked and run. Folders have spaces in their names.
if(SEAMFLOW_SANITIZE OR NOT SEAMFLOW_INSTALL)
    return()
endif()

set(arguments "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}")
if(CMAKE_CXX_COMPILER_LAUNCHER)
    list(APPEND arguments "-DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}")
endif()
foreach(way IN ITEMS install headers documents package find_package pkg-config destdir add_subdirectory shared)
    # shared compiles the whole library once more: `tests/run.sh --all` runs it.
    set(configurations "")
    if(way STREQUAL shared)
        set(configurations CONFIGURATIONS All)
    endif()
    add_test(NAME consumer.${way} ${configurations} COMMAND
        ${CMAKE_CURRENT_LIST_DIR}/run.sh ${way} ${PROJECT_BINARY_DIR} "${CMAKE_CURRENT_BINARY_DIR}/the consumer" ${arguments})
    set_tests_properties(consumer.${way} PROPERTIES TIMEOUT 900 ENVIRONMENT "CXX=${CMAKE_CXX_COMPILER}")
endforeach()
set_tests_properties(consumer.install PROPERTIES FIXTURES_SETUP installed)
set_tests_properties(consumer.headers consumer.documents consumer.find_package consumer.pkg-config consumer.destdir PROPERTIES FIXTURES_REQUIRED installed)
# It compiles on all cores: better first and alone than beside tests that measure time or threads.
set_tests_properties(consumer.shared PROPERTIES COST 1000 RUN_SERIAL TRUE)
