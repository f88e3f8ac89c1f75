# Installs the program, the libraries and their headers, so that find_package(latsch) gives latsch::cli and
# everything below it. The dependencies are found again on the other machine by the same file as here.
# Components: program (with its manual and completion), python, development.
include(CMakePackageConfigHelpers)

get_property(libraries GLOBAL PROPERTY LATSCH_LIBRARIES)
set(package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/latsch)
install(TARGETS ${libraries} EXPORT latsch_targets COMPONENT development)
install(EXPORT latsch_targets NAMESPACE latsch:: DESTINATION ${package_directory} COMPONENT development)
# The headers that docs/headers.md lists, and those that they include. Installed headers include each other as <latsch/...>
# says, so that "base/file.h" of another project is never taken for one of them.
install(CODE "
execute_process(COMMAND python3 ${CMAKE_SOURCE_DIR}/tools/public_headers.py --install
                        \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/latsch\"
                COMMAND_ERROR_IS_FATAL ANY)" COMPONENT development)

write_basic_package_version_file(${CMAKE_BINARY_DIR}/latsch-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_SOURCE_DIR}/cmake/latsch-config.cmake
              ${CMAKE_SOURCE_DIR}/cmake/dependencies.cmake
              ${CMAKE_BINARY_DIR}/latsch-config-version.cmake
        DESTINATION ${package_directory} COMPONENT development)

# Makes `man latsch` from the program's own help.
set(manual ${CMAKE_BINARY_DIR}/latsch.1)
add_custom_command(OUTPUT ${manual}
                   COMMAND python3 ${CMAKE_SOURCE_DIR}/tools/man_page.py $<TARGET_FILE:latsch> ${manual}
                   DEPENDS latsch ${CMAKE_SOURCE_DIR}/tools/man_page.py VERBATIM)
# Neither name nor time is stored, so equal texts give equal bytes.
add_custom_command(OUTPUT ${manual}.gz COMMAND gzip -9nkf ${manual} DEPENDS ${manual} VERBATIM)
add_custom_target(latsch_manual ALL DEPENDS ${manual}.gz)
install(FILES ${manual}.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${CMAKE_SOURCE_DIR}/cmake/package/latsch.bash DESTINATION share/bash-completion/completions RENAME latsch
        COMPONENT program)
# The schemas of the program's files, for editors.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/schemas/ DESTINATION share/latsch/schemas COMPONENT program
        FILES_MATCHING PATTERN "latsch-*.json")
include(cmake/latsch_packages.cmake)

add_test(NAME public_headers COMMAND python3 ${CMAKE_SOURCE_DIR}/tools/public_headers.py)
add_test(NAME public_headers_tool COMMAND python3 ${CMAKE_SOURCE_DIR}/tools/public_headers_test.py)
add_test(NAME api_pages COMMAND sh ${CMAKE_SOURCE_DIR}/tools/api_pages.sh --if-installed ${CMAKE_BINARY_DIR}/api)
set_tests_properties(api_pages PROPERTIES SKIP_RETURN_CODE 77)
if(LATSCH_TESTS AND NOT LATSCH_SANITIZE)
  add_test(NAME install_and_find_package
           COMMAND ${CMAKE_COMMAND} -D BUILD=${CMAKE_BINARY_DIR} -D SOURCE=${CMAKE_SOURCE_DIR}
                   -D GENERATOR=${CMAKE_GENERATOR} -P ${CMAKE_SOURCE_DIR}/examples/check.cmake)
  set_tests_properties(install_and_find_package PROPERTIES TIMEOUT 900 COST 9)
endif()
