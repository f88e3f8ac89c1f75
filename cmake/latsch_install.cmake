# Installs the program, the libraries and their headers, so that find_package(latsch) gives latsch::correlation
# and everything below it. The dependencies are found again on the other machine by the same file as here.
include(CMakePackageConfigHelpers)

get_property(libraries GLOBAL PROPERTY LATSCH_LIBRARIES)
set(package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/latsch)
install(TARGETS ${libraries} EXPORT latsch_targets)
install(EXPORT latsch_targets NAMESPACE latsch:: DESTINATION ${package_directory})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/latsch
        FILES_MATCHING PATTERN "*.h" PATTERN "*_testing.h" EXCLUDE)

write_basic_package_version_file(${CMAKE_BINARY_DIR}/latsch-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_SOURCE_DIR}/cmake/latsch-config.cmake
              ${CMAKE_SOURCE_DIR}/cmake/dependencies.cmake
              ${CMAKE_BINARY_DIR}/latsch-config-version.cmake
        DESTINATION ${package_directory})

if(LATSCH_TESTS AND NOT LATSCH_SANITIZE)
  add_test(NAME install_and_find_package
           COMMAND ${CMAKE_COMMAND} -D BUILD=${CMAKE_BINARY_DIR} -D SOURCE=${CMAKE_SOURCE_DIR}
                   -D GENERATOR=${CMAKE_GENERATOR} -P ${CMAKE_SOURCE_DIR}/cmake/consumer/check.cmake)
endif()
