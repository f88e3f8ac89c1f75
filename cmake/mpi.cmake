# Where MPI is installed (Debian: libopenmpi-dev), the program also runs its trials on the ranks of an MPI job.
# Only the program: whoever links the libraries needs no MPI.
set(MPI_CXX_SKIP_MPICXX ON)
find_package(MPI COMPONENTS CXX QUIET)
if(MPI_CXX_FOUND)
  add_library(latsch_mpi STATIC ${CMAKE_SOURCE_DIR}/src/evaluation/executors/mpi/mpi_executor.cpp)
  target_link_libraries(latsch_mpi PUBLIC latsch::evaluation MPI::MPI_CXX)
  target_link_libraries(latsch_cli PUBLIC latsch_mpi)
  set_source_files_properties(${CMAKE_SOURCE_DIR}/apps/cli/run/workers.cpp
                              PROPERTIES COMPILE_DEFINITIONS LATSCH_MPI)
  if(LATSCH_TESTS)
    add_executable(mpi_executor_test ${CMAKE_SOURCE_DIR}/src/evaluation/executors/mpi/mpi_executor_test.cpp)
    target_link_libraries(mpi_executor_test PRIVATE latsch_mpi GTest::gtest)
    latsch_optimize_little(mpi_executor_test)
    add_test(NAME mpi_executor COMMAND ${MPIEXEC_EXECUTABLE} --oversubscribe --allow-run-as-root -n 3
                                       $<TARGET_FILE:mpi_executor_test>)
    set_tests_properties(mpi_executor PROPERTIES TIMEOUT 60)
  endif()
endif()
