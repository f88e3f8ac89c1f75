# Debian packages of components, by tools/package.sh: latsch (program, units for other programs, manual, completion),
# latsch-mpi (one small library that calls MPI), python3-latsch, and latsch-units-windows (libraries of units for Windows, for
# which LATSCH_WINDOWS_UNITS names the build). What they depend on is read from the files themselves by dpkg-shlibdeps, but for these:
#   libopenblas0-serial  the build without threads, found by its own path (dependencies.cmake); others would do for the tool
#   python3              of the version whose extension module it is
set(LATSCH_WINDOWS_UNITS "" CACHE PATH "Build folder of the preset units-windows, whose libraries are packaged")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "Latsch")
set(CPACK_PACKAGE_CONTACT "The authors of Latsch <latsch@latsch.invalid>")
set(CPACK_PACKAGE_HOMEPAGE_URL "")
set(CPACK_COMPONENTS_ALL program)
if(TARGET latsch_mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
endif()
if(TARGET latsch_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
if(LATSCH_WINDOWS_UNITS)
  list(APPEND CPACK_COMPONENTS_ALL windows)
  foreach(standard fmi2 fmi3 sti)
    install(FILES ${LATSCH_WINDOWS_UNITS}/lib/latsch/latsch_${standard}.dll DESTINATION lib/latsch COMPONENT windows)
  endforeach()
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE gzip)  # tools/repack.sh compresses them better afterwards
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # each component is built by its own targets, without the
                                           # tests

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME latsch)
set(CPACK_DEBIAN_PROGRAM_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS libopenblas0-serial)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "identifies tire and suspension models from rig measurements\nDrives models through virtual tests, compares with what a laboratory\nmeasured, finds their parameters and says how far to trust them. Models are\nfinite-element and flexible-ring tires, Magic Formula, suspensions, cars.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS
    "python3-latsch, latsch-mpi, latsch-units-windows, chromium | firefox-esr | www-browser")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-latsch)
set(CPACK_DEBIAN_PYTHON_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "optimizers, models and studies of latsch from Python\nAsk/tell optimizers, designs of experiments and identifiability; models\nthrough virtual tests with their derivatives; studies and their journals as\nNumPy arrays.")
if(TARGET latsch_python)
  string(REGEX MATCH "^3\\.([0-9]+)" python "${LATSCH_PYTHON_VERSION}")
  math(EXPR next "${CMAKE_MATCH_1} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "latsch (= ${PROJECT_VERSION}), python3 (>= ${python}), python3 (<< 3.${next}), python3-numpy, libopenblas0-serial")
endif()

set(CPACK_DEBIAN_MPI_PACKAGE_NAME latsch-mpi)
set(CPACK_DEBIAN_MPI_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "latsch (= ${PROJECT_VERSION}), openmpi-bin")
set(CPACK_COMPONENT_MPI_DESCRIPTION
    "runs of latsch on the ranks of an MPI job\nThe library by which latsch calls Open MPI if mpirun or srun starts it as\nseveral tasks.")

set(CPACK_DEBIAN_WINDOWS_PACKAGE_NAME latsch-units-windows)
set(CPACK_DEBIAN_WINDOWS_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_WINDOWS_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_WINDOWS_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_WINDOWS_PACKAGE_DEPENDS "latsch (= ${PROJECT_VERSION})")
set(CPACK_COMPONENT_WINDOWS_DESCRIPTION
    "libraries of latsch's exported units for Windows\nIf they are installed, latsch export writes tires and cars for FMI and the\nStandard Tyre Interface that run on Linux and on Windows, x86-64. They are\nloaded by programs on Windows, never by Debian.")

# Documents of every package, as the policy of Debian wants them; the licenses of what the program contains in itself.
set(texts ${CMAKE_BINARY_DIR}/package)
file(MAKE_DIRECTORY ${texts})
find_program(GZIP_PROGRAM gzip)
if(GZIP_PROGRAM)
  foreach(text changelog:${CMAKE_SOURCE_DIR}/cmake/package/changelog CHANGELOG.md:${CMAKE_SOURCE_DIR}/CHANGELOG.md)
    string(REGEX MATCH "^([^:]+):(.*)$" none ${text})
    execute_process(COMMAND ${GZIP_PROGRAM} -9nc ${CMAKE_MATCH_2} OUTPUT_FILE ${texts}/${CMAKE_MATCH_1}.gz COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
endif()
foreach(component program mpi python windows)
  string(TOUPPER ${component} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES ${CMAKE_SOURCE_DIR}/cmake/package/copyright ${texts}/changelog.gz DESTINATION share/doc/${name}
          COMPONENT ${component})
endforeach()
install(FILES ${texts}/CHANGELOG.md.gz DESTINATION share/doc/latsch COMPONENT program)
foreach(component program python)
  string(TOUPPER ${component} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES ${CMAKE_SOURCE_DIR}/cmake/package/${name}.lintian-overrides DESTINATION share/lintian/overrides
          RENAME ${name} COMPONENT ${component})
endforeach()
foreach(package libmatio-dev libhdf5-dev libaec-dev libsqlitecpp-dev nlohmann-json3-dev libcli11-dev libfmt-dev libtomlplusplus-dev)
  install(FILES /usr/share/doc/${package}/copyright DESTINATION share/doc/latsch/licenses RENAME ${package}
          COMPONENT program OPTIONAL)
endforeach()
set(modules ${CMAKE_BINARY_DIR}/apps/web/page/node_modules)
install(FILES ${modules}/uplot/LICENSE DESTINATION share/doc/latsch/licenses RENAME uplot COMPONENT program OPTIONAL)
install(FILES ${modules}/svelte/LICENSE.md DESTINATION share/doc/latsch/licenses RENAME svelte COMPONENT program OPTIONAL)
include(CPack)

add_custom_target(latsch_packaged DEPENDS latsch latsch_manual latsch_fmi2 latsch_fmi3 latsch_sti latsch_all)
if(TARGET latsch_python)
  add_dependencies(latsch_packaged latsch_python)
endif()
if(TARGET latsch_mpi)
  add_dependencies(latsch_packaged latsch_mpi)
endif()
