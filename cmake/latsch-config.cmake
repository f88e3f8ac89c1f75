# find_package(latsch)
include(${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake)
set(MPI_CXX_SKIP_MPICXX ON)  # latsch::cli runs on the ranks of an MPI job if it was built where MPI is installed
find_package(MPI COMPONENTS CXX QUIET)
include(${CMAKE_CURRENT_LIST_DIR}/latsch_targets.cmake)
