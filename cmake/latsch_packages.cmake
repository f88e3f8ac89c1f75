# Debian packages of components, by tools/package.sh: latsch (program, units for other programs, manual, completion),
# latsch-mpi (one small library that calls MPI) and python3-latsch. What they depend on is read from the files themselves by dpkg-shlibdeps, but for these:
#   libopenblas0-serial  the build without threads, found by its own path (dependencies.cmake); others would do for the tool
#   python3              of the version whose extension module it is
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "Latsch")
set(CPACK_PACKAGE_CONTACT "The authors of Latsch <latsch@localhost>")
set(CPACK_PACKAGE_HOMEPAGE_URL "")
set(CPACK_COMPONENTS_ALL program)
if(TARGET latsch_mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
endif()
if(TARGET latsch_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # each component is built by its own targets, without the
                                           # tests

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME latsch)
set(CPACK_DEBIAN_PROGRAM_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS libopenblas0-serial)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "identifies tire and suspension models from rig measurements\nDrives models through virtual tests, compares with what a laboratory measured, finds their parameters and says\nhow far to trust them. Models are finite-element and flexible-ring tires, Magic Formula, suspensions, cars.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "python3-latsch, latsch-mpi, chromium | firefox-esr | www-browser")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-latsch)
set(CPACK_DEBIAN_PYTHON_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "optimizers, models and studies of latsch from Python\nAsk/tell optimizers, designs of experiments and identifiability; models through virtual tests with their\nderivatives; studies and their journals as NumPy arrays.")
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
    "runs of latsch on the ranks of an MPI job\nThe library by which latsch calls Open MPI if mpirun or srun starts it as several tasks.")

foreach(component program mpi python)
  string(TOUPPER ${component} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION share/doc/${name} RENAME copyright COMPONENT ${component})
endforeach()
include(CPack)

add_custom_target(latsch_packaged DEPENDS latsch latsch_manual latsch_fmi2 latsch_fmi3 latsch_sti latsch_all)
if(TARGET latsch_python)
  add_dependencies(latsch_packaged latsch_python)
endif()
if(TARGET latsch_mpi)
  add_dependencies(latsch_packaged latsch_mpi)
endif()
