# Dependencies of Latsch: Debian 12 packages, which tools/install_packages.sh installs from these lines.
# apt: g++ cmake ninja-build python3
# apt: libfmt-dev libeigen3-dev nlohmann-json3-dev libcli11-dev libtomlplusplus-dev
# apt: libsqlitecpp-dev libsqlite3-dev libudunits2-dev libopenblas-serial-dev libmetis-dev
# MAT files: version 5 needs zlib, version 7.3 is HDF5 and read by matio:
# apt: zlib1g-dev libmatio-dev
# Packages of co-simulation units (FMI) are ZIP files:
# apt: libzip-dev
# The studio's server: Boost.Beast and Asio, headers alone:
# apt: libboost-dev
# The Python package needs these; without them the program is built without it:
# apt: python3-dev pybind11-dev python3-numpy
# Runs on the ranks of an MPI job need these; without them the program is built without MPI:
# apt: libopenmpi-dev openmpi-bin
# Tests and benchmarks compare with these independent programs; the product does not use them:
# apt: libgtest-dev libgmock-dev calculix-ccx python3-scipy python3-numpy libnlopt-dev libxml2-utils
# The test oracle of mechanisms (verification/simbody), C++17 by itself; nothing else is linked with it:
# apt: libsimbody-dev
# ./bench.sh slurm starts a Slurm of one node with these (7 MB; no daemon of theirs has to run):
# apt: slurmctld slurmd slurm-client munge
# The page of the studio is built by npm (apps/web). They are installed only if the commands are missing, because another Node
# than Debian's has packages that exclude Debian's npm. Without npm, Latsch is built without the page.
# apt-command: node nodejs
# apt-command: npm npm
# The tests of the page run in this browser:
# apt: chromium
# tools/api_pages.sh makes the pages of the public headers with this program and installs it; nothing else needs it:
# apt-for-api-pages: doxygen
# ./test.sh --thorough runs these programs and installs them:
# apt-for-thorough: clang-format clang-tidy
# The preset units-windows builds exported units for Windows with this compiler, and their tests run under wine:
# apt-for-windows: g++-mingw-w64-x86-64-posix wine64
# A file system in user space for the test of a journal on one:
# apt: bindfs
find_package(fmt REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(SQLiteCpp REQUIRED)
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_package(Boost 1.74 REQUIRED)
if(LATSCH_TESTS)
  find_package(GTest REQUIRED)
endif()

find_library(UDUNITS2_LIBRARY udunits2 REQUIRED)
find_path(UDUNITS2_INCLUDE udunits2.h REQUIRED)
add_library(udunits2 INTERFACE IMPORTED)
target_link_libraries(udunits2 INTERFACE ${UDUNITS2_LIBRARY})
target_include_directories(udunits2 INTERFACE ${UDUNITS2_INCLUDE})

find_library(MATIO_LIBRARY matio REQUIRED)
find_path(MATIO_INCLUDE matio.h REQUIRED)
add_library(matio INTERFACE IMPORTED)
target_link_libraries(matio INTERFACE ${MATIO_LIBRARY})
target_include_directories(matio INTERFACE ${MATIO_INCLUDE})

find_library(LIBZIP_LIBRARY zip REQUIRED)
find_path(LIBZIP_INCLUDE zip.h REQUIRED)
add_library(libzip INTERFACE IMPORTED)
target_link_libraries(libzip INTERFACE ${LIBZIP_LIBRARY})
target_include_directories(libzip INTERFACE ${LIBZIP_INCLUDE})

# BLAS and LAPACK come from OpenBLAS in the build without threads, because a trial is one thread.
find_library(OPENBLAS_LIBRARY openblas REQUIRED
             PATHS /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/openblas-serial NO_DEFAULT_PATH)
add_library(lapack_blas INTERFACE IMPORTED)
# Always a direct dependency of the program and found by its own path: so it comes before whatever the system's
# alternatives of libblas.so.3 and libopenblas.so.0 point to.
target_link_libraries(lapack_blas INTERFACE
  -Wl,--push-state,--no-as-needed ${OPENBLAS_LIBRARY} -Wl,--pop-state ${CMAKE_DL_LIBS})
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)

# METIS orders sparse matrices by nested dissection.
find_library(METIS_LIBRARY metis REQUIRED)
find_path(METIS_INCLUDE metis.h REQUIRED)
add_library(metis INTERFACE IMPORTED)
target_link_libraries(metis INTERFACE ${METIS_LIBRARY})
target_include_directories(metis INTERFACE ${METIS_INCLUDE})
