# Dependencies of Latsch: Debian 12 packages. tools/install_packages.sh installs the sets that it is given; a set is all
# lines of its name below. ./demo.sh needs the set `build` alone; what the other sets bring is left out, and named, where
# they are not installed.
# The compiler and the libraries of the program are the first set.
# apt build: g++ cmake ninja-build python3
# apt build: libfmt-dev libeigen3-dev nlohmann-json3-dev libcli11-dev libtomlplusplus-dev
# apt build: libsqlitecpp-dev libsqlite3-dev libudunits2-dev libopenblas-serial-dev libmetis-dev
# MAT files: version 5 needs zlib, version 7.3 is HDF5 and read by matio:
# apt build: zlib1g-dev libmatio-dev
# The studio's server: Boost.Beast and Asio, headers alone:
# apt build: libboost-dev
# The page of the studio is built by npm (apps/web). The packages are installed only if the commands are missing, because
# another Node than Debian's has packages that exclude Debian's npm:
# apt-command page: node nodejs
# apt-command page: npm npm
# The Python package:
# apt python: python3-dev pybind11-dev python3-numpy
# Runs on the ranks of an MPI job:
# apt mpi: libopenmpi-dev openmpi-bin
# Tests and benchmarks compare with these independent programs; the product does not use them:
# apt test: libgtest-dev libgmock-dev calculix-ccx python3-scipy python3-numpy python3-pandas libnlopt-dev libxml2-utils python3-jsonschema
# Packages of co-simulation units (FMI) are ZIP files, which this library reads again:
# apt test: libzip-dev
# The test oracle of mechanisms (verification/simbody), C++17 by itself; nothing else is linked with it:
# apt test: libsimbody-dev
# A file system in user space for the test of a journal on one:
# apt test: bindfs
# The tests of the page run in this browser:
# apt browser: chromium
# ./bench.sh slurm starts a Slurm of one node with these; no daemon of theirs has to run:
# apt slurm: slurmctld slurmd slurm-client munge
# ./test.sh --thorough runs these programs:
# apt thorough: clang-format clang-tidy
# tools/api_pages.sh makes the pages of the public headers with this program:
# apt api-pages: doxygen
# tools/package.sh --try and tools/bare_demo.sh make a bare Debian with this program:
# apt bare: mmdebstrap
# tools/archive.sh makes the archive with these programs:
# apt archive: patchelf xz-utils
# The preset units-windows builds exported units for Windows with this compiler, and their tests run under wine:
# apt windows: g++-mingw-w64-x86-64-posix wine64
# What ./test.sh and ./bench.sh need, as one name:
# apt-sets complete: build page python mpi test browser slurm
find_package(fmt REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(SQLiteCpp REQUIRED)
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_package(Boost 1.74 REQUIRED)
if(LATSCH_TESTS STREQUAL "AUTO")
  find_package(GTest QUIET)
  set(LATSCH_TESTS ${GTest_FOUND})
  if(NOT GTest_FOUND)
    message(STATUS "No tests: GoogleTest is not installed; tools/install_packages.sh test installs it")
  endif()
elseif(LATSCH_TESTS)
  find_package(GTest REQUIRED)
endif()

find_library(UDUNITS2_LIBRARY udunits2 REQUIRED)
find_path(UDUNITS2_INCLUDE udunits2.h REQUIRED)
add_library(udunits2 INTERFACE IMPORTED)
target_link_libraries(udunits2 INTERFACE ${UDUNITS2_LIBRARY})
target_include_directories(udunits2 INTERFACE ${UDUNITS2_INCLUDE})

# MAT files of version 7.3. Programs contain matio and HDF5, because Debian's shared HDF5 needs libcurl and what that needs:
# 5 MB of packages for reading files from the network, which Latsch does not do. The code of the archives is not
# position-independent enough for shared libraries: Python's module uses matio's own, and latsch_all, which reads no
# recordings, is linked without it (apps/exchange).
find_library(MATIO_LIBRARY matio REQUIRED)
find_path(MATIO_INCLUDE matio.h REQUIRED)
find_library(MATIO_ARCHIVE libmatio.a)
find_library(HDF5_ARCHIVE NAMES libhdf5_serial.a libhdf5.a)
find_library(SZIP_ARCHIVE libsz.a)
find_library(AEC_ARCHIVE libaec.a)
add_library(matio INTERFACE IMPORTED)
if(MATIO_ARCHIVE AND HDF5_ARCHIVE AND SZIP_ARCHIVE AND AEC_ARCHIVE)
  target_link_libraries(matio INTERFACE
    "$<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:${MATIO_ARCHIVE};${HDF5_ARCHIVE};${SZIP_ARCHIVE};${AEC_ARCHIVE};ZLIB::ZLIB;m;${CMAKE_DL_LIBS}>"
    "$<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,MODULE_LIBRARY>:${MATIO_LIBRARY}>")
else()
  message(STATUS "matio and HDF5 are shared libraries: their archives are not installed")
  target_link_libraries(matio INTERFACE ${MATIO_LIBRARY})
endif()
target_include_directories(matio INTERFACE ${MATIO_INCLUDE})

if(LATSCH_TESTS)
  find_library(LIBZIP_LIBRARY zip REQUIRED)
  find_path(LIBZIP_INCLUDE zip.h REQUIRED)
  add_library(libzip INTERFACE IMPORTED)
  target_link_libraries(libzip INTERFACE ${LIBZIP_LIBRARY})
  target_include_directories(libzip INTERFACE ${LIBZIP_INCLUDE})
endif()

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
