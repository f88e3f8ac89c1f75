# Builds the slim libraries of apps/exchange alone (LATSCH_UNITS_ALONE, the preset units-windows): of every module only
# what they need, without the libraries of the program. The root's CMakeLists.txt is read as it is, so every file has the
# options that it has in the program; only latsch_module is another one here.
set(LATSCH_TESTS OFF)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
# fmt and toml++ are headers here. They are in a folder of their own, because /usr/include has those of another system.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/headers)
foreach(headers fmt toml++)
  find_path(place NAMES ${headers} PATHS /usr/include NO_DEFAULT_PATH NO_CACHE REQUIRED)
  file(CREATE_LINK ${place}/${headers} ${CMAKE_BINARY_DIR}/headers/${headers} SYMBOLIC)
endforeach()
add_compile_definitions(TOML_HEADER_ONLY=0)
if(WIN32)
  # Objects have more sections than the usual format counts. GCC may spill registers of 32 bytes as aligned although
  # Windows aligns stacks to 16 [GCC bug 54412]; the assembler then writes the instructions for unaligned memory.
  add_compile_options(-Wa,-mbig-obj -Wa,-muse-unaligned-vector-move)
  add_compile_definitions(_USE_MATH_DEFINES)
endif()

set(units_modules base numerics road tire magic_formula rigid_ring ring_tire multibody suspension car formats exchange)

function(latsch_module folder)
  get_filename_component(name ${folder} NAME)
  if(NOT name IN_LIST units_modules)
    return()
  endif()
  latsch_sources(sources src/${folder})
  if(name STREQUAL "base")  # their places take slim/si_units.cpp and slim/plain_files.cpp
    list(FILTER sources EXCLUDE REGEX "/base/(units|file|mapped_file|progress)\\.cpp$")
  elseif(name STREQUAL "numerics")
    list(FILTER sources INCLUDE REGEX "/kernels/|/dense/(lu|general_eigen)\\.cpp$")
  elseif(name STREQUAL "formats")
    list(FILTER sources INCLUDE REGEX "/formats/(road/|text/(file_marks|letter_case|teim_orbit|text_encoding)\\.cpp$)")
  elseif(name STREQUAL "ring_tire")  # the modes of a standing ring need the sparse part of numerics
    list(FILTER sources EXCLUDE REGEX "/standing_modes\\.cpp$")
  elseif(name STREQUAL "exchange")
    list(FILTER sources INCLUDE REGEX "/exchange/unit/")
  endif()
  add_library(latsch_${name} STATIC ${sources})
  target_include_directories(latsch_${name} PUBLIC ${CMAKE_SOURCE_DIR}/src)
  target_include_directories(latsch_${name} SYSTEM PUBLIC ${CMAKE_BINARY_DIR}/headers)
  target_link_libraries(latsch_${name} PUBLIC Eigen3::Eigen)
endfunction()

# Sets the options that the root's CMakeLists.txt sets behind the modules, and adds the libraries.
macro(latsch_units_alone)
  list(TRANSFORM units_modules PREPEND latsch_ OUTPUT_VARIABLE units_libraries)
  latsch_position_independent(${units_modules})
  latsch_in_sections(${units_modules})
  latsch_optimize_little(latsch_formats latsch_exchange)
  list(REMOVE_ITEM units_libraries latsch_exchange)
  latsch_compile_together(${units_libraries})
  latsch_compile_kernels_alone()
  add_subdirectory(apps/exchange)
  add_subdirectory(verification/fmi/caller)
  add_subdirectory(verification/sti/caller)
endmacro()
