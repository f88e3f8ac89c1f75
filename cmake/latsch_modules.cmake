# Builds one static library for each module of src/ from every .cpp in its folder and in its rooms,
# with their *_test.cpp files as one test program.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
include(GNUInstallDirs)
include(GoogleTest)

set(LATSCH_TESTS AUTO CACHE STRING "Build the tests: ON, OFF, or AUTO, which builds them if GoogleTest is installed")
option(LATSCH_SANITIZE "Address and undefined-behavior sanitizers" OFF)
option(LATSCH_WERROR "Warnings of the compiler are errors: for our own builds, not for other compilers" OFF)
option(LATSCH_UNITY "Compile small files in groups; OFF finds files that lack an include of their own" ON)

find_program(LATSCH_CCACHE ccache)
if(LATSCH_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${LATSCH_CCACHE})
endif()

add_compile_options(-Wall -Wextra -Wno-psabi -ffp-contract=off)
if(LATSCH_WERROR)
  # GCC 12 also warns of "x" + std::string, inside of its own header, where nothing overlaps, and of the inside of an
  # optional that it has not proved to be empty.
  add_compile_options(-Werror $<$<COMPILE_LANGUAGE:C,CXX>:-Wno-restrict> $<$<COMPILE_LANGUAGE:C,CXX>:-Wno-maybe-uninitialized>)
endif()

# GCC copies structs of registers in pieces of sixteen bytes; reading them back in pieces of 32 then
# waits for the stores.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag("-mmove-max=256 -mstore-max=256 --param=sra-max-scalarization-size-Ospeed=2048" LATSCH_HAS_MOVE_MAX)
if(LATSCH_HAS_MOVE_MAX)
  set(LATSCH_LANES_IN_REGISTERS -mmove-max=256 -mstore-max=256 --param=sra-max-scalarization-size-Ospeed=2048)
endif()
if(LATSCH_SANITIZE)
  # For a group of eight files the compiler takes 40 s with all checks of undefined behavior and a way on after each finding,
  # 28 s if a finding ends the program, and 20 s without the four checks named last, which stand at every access to a member;
  # without sanitizers 14 s. The address sanitizer ends a program at a null pointer and beyond an object, too. Misaligned
  # numbers harm no processor that Latsch runs on. Objects of a wrong class would come from static_cast to a class, of which
  # the program has few, mostly for handles of co-simulation.
  add_compile_options(-fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all
                      -fno-sanitize=null,alignment,object-size,vptr -fno-omit-frame-pointer)
  # Without _GLIBCXX_SANITIZE_VECTOR: GoogleTest, which is not instrumented, shares vectors with tests.
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
  add_link_options(-fsanitize=address,undefined)
endif()

# Sets `limit` to the seconds after which a test is ended that takes less than `seconds` in an optimized build.
function(latsch_limit seconds)
  if(LATSCH_SANITIZE)
    math(EXPR seconds "5 * ${seconds}")
  endif()
  set(limit ${seconds} PARENT_SCOPE)
endfunction()

# Sets `out` to the files that include kernels, each of which is compiled once for every set of instructions.
function(latsch_files_of_kernels out)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/*.cpp)
  set(found "")
  foreach(source ${sources})
    file(STRINGS ${source} is_of_kernels REGEX "numerics/kernels/for_each_kernel_set.h")
    if(is_of_kernels)
      list(APPEND found ${source})
    endif()
  endforeach()
  set(${out} ${found} PARENT_SCOPE)
endfunction()

# Keeps files of kernels out of the groups of latsch_compile_together: for_each_kernel_set.h allows one in a compilation.
function(latsch_compile_kernels_alone)
  latsch_files_of_kernels(files)
  set_source_files_properties(${files} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# Limits the sanitizers for files of kernels. Checking each of their thousands of inlined vector
# operations would take the compiler a quarter of an hour for each file, so only memory beyond the
# stack is checked there. Must be called after all other options of files are set.
function(latsch_sanitize_kernels_lightly)
  if(LATSCH_SANITIZE)
    latsch_files_of_kernels(files)
    set_property(SOURCE ${files} APPEND PROPERTY COMPILE_OPTIONS -O1 -fno-sanitize=undefined --param=asan-stack=0)
  endif()
endfunction()

# Sets -O1 for targets that take longer to compile than their speed is worth.
function(latsch_optimize_little)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

# Compiles sixteen files at a time instead of eight where half of the time of a group is that of its includes.
function(latsch_in_large_groups)
  set_target_properties(${ARGN} PROPERTIES UNITY_BUILD_BATCH_SIZE 16)
endfunction()

# Compiles eight files at a time as one, so that their includes are read once. Names in their
# anonymous namespaces must differ from file to file. A file with options of its own, such as one of
# inner loops that run a million times, stays alone.
function(latsch_compile_together)
  if(NOT LATSCH_UNITY)
    return()
  endif()
  set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ON)
  foreach(target ${ARGN})  # a unit file is no header: members may have anonymous types
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endforeach()
endfunction()

function(latsch_sources out folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_test(ing)?\\.cpp$|/open_mpi\\.cpp$")  # mpi.cmake makes its library
  list(SORT sources COMPARE FILE_BASENAME)  # so a new room leaves the groups of files unchanged
  set(${out} ${sources} PARENT_SCOPE)
endfunction()

function(latsch_tests folder name library)
  file(GLOB_RECURSE tests CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*_test.cpp)
  list(FILTER tests EXCLUDE REGEX "/mpi/")
  list(SORT tests COMPARE FILE_BASENAME)
  if(LATSCH_TESTS AND tests)
    add_executable(${name}_test ${tests})
    target_link_libraries(${name}_test PRIVATE ${library} GTest::gtest_main GTest::gmock)
    target_compile_definitions(${name}_test PRIVATE LATSCH_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
    latsch_optimize_little(${name}_test)
    latsch_limit(600)
    gtest_discover_tests(${name}_test TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60
                         PROPERTIES TIMEOUT ${limit})
  endif()
endfunction()

# latsch_module(models/fe_tire LINK ...) makes latsch::fe_tire from src/models/fe_tire.
function(latsch_module folder)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  get_filename_component(name ${folder} NAME)
  latsch_sources(sources src/${folder})
  if(sources)
    add_library(latsch_${name} STATIC ${sources})
    set(scope PUBLIC)
  else()
    add_library(latsch_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(latsch::${name} ALIAS latsch_${name})
  target_include_directories(latsch_${name} ${scope}
    $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(latsch_${name} ${scope} ${ARG_LINK})
  target_compile_features(latsch_${name} ${scope} cxx_std_20)
  set_target_properties(latsch_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY LATSCH_LIBRARIES latsch_${name})
  latsch_tests(src/${folder} ${name} latsch::${name})
endfunction()

# Makes modules that are linked into shared libraries as well as programs: one set of object files
# for both. Functions are called and inlined as without this option, because no other library may
# replace them.
function(latsch_position_independent)
  foreach(name ${ARGN})
    get_target_property(type latsch_${name} TYPE)
    if(NOT type STREQUAL "INTERFACE_LIBRARY")
      set_target_properties(latsch_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
      target_compile_options(latsch_${name} PRIVATE -fno-semantic-interposition)
    endif()
  endforeach()
endfunction()

# Gives every function and every table of these modules a section of its own, so that the linker leaves out of a slim library
# (apps/exchange) whatever the library does not call, although the same objects serve the program.
function(latsch_in_sections)
  foreach(name ${ARGN})
    target_compile_options(latsch_${name} PRIVATE -ffunction-sections -fdata-sections)
  endforeach()
endfunction()

# latsch_program(apps/cli latsch LINK ...) makes bin/latsch from apps/cli/main.cpp and a library latsch_cli of all else,
# which is installed so that others can ship the program with models of their own (run_cli.h).
function(latsch_program folder program)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  get_filename_component(name ${folder} NAME)
  latsch_sources(sources ${folder})
  list(REMOVE_ITEM sources ${CMAKE_SOURCE_DIR}/${folder}/main.cpp)
  add_library(latsch_${name} STATIC ${sources})
  target_link_libraries(latsch_${name} PUBLIC ${ARG_LINK})
  target_include_directories(latsch_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/apps> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_target_properties(latsch_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY LATSCH_LIBRARIES latsch_${name})
  add_executable(${program} ${folder}/main.cpp)
  target_link_libraries(${program} PRIVATE latsch_${name})
  install(TARGETS ${program} COMPONENT program)
endfunction()

# Adds every subfolder that has a CMakeLists.txt.
function(latsch_subdirectories folder)
  file(GLOB lists CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*/CMakeLists.txt
                                    ${CMAKE_SOURCE_DIR}/${folder}/CMakeLists.txt)
  foreach(list ${lists})
    get_filename_component(directory ${list} DIRECTORY)
    add_subdirectory(${directory})
  endforeach()
endfunction()
