# `cpack` in the build folder: an archive that runs wherever it is unpacked, and a package for Debian, which needs what
# its programs are linked with. Names of programs are short, and others have them, too: the package keeps to
# /opt/seamflow.
set(CPACK_GENERATOR TGZ DEB)
set(CPACK_PACKAGE_NAME seamflow)
set(CPACK_PACKAGE_VENDOR seamflow)
set(CPACK_PACKAGE_CONTACT "the seamflow project <seamflow@localhost>")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# For the pictures of figures.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS python3-matplotlib)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_BINARY_DIR}/package_of_generator.cmake)
file(CONFIGURE OUTPUT ${CPACK_PROJECT_CONFIG_FILE} CONTENT [[
if(CPACK_GENERATOR STREQUAL DEB)
    set(CPACK_PACKAGING_INSTALL_PREFIX /opt/seamflow)
endif()
]] @ONLY)
include(CPack)
