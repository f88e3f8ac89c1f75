# SPDX-License-Identifier: Apache-2.0
# Builds the page in PAGE, a copy of SOURCE, and writes GENERATED, its files as C++. What npm installs stays as long as
# package-lock.json does. Run by CMakeLists.txt beside it.
foreach(folder src public tools tests)
  file(REMOVE_RECURSE ${PAGE}/${folder})
endforeach()
file(COPY ${SOURCE}/ DESTINATION ${PAGE}
     PATTERN node_modules EXCLUDE PATTERN dist EXCLUDE PATTERN screenshots EXCLUDE)

function(run_in_page what)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${PAGE} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message("${output}")
    message(FATAL_ERROR "${what} failed. With -DLATSCH_PAGE=OFF latsch is built without the page of latsch serve.")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(ENV{PATH} "${PAGE}/node_modules/.bin:$ENV{PATH}")
set(ENV{LATSCH_WEB_OUT} "${PAGE}/dist")
file(SHA256 ${PAGE}/package-lock.json lock)
set(installed ${PAGE}/installed_${WITH_TESTS}_${lock})
if(NOT EXISTS ${installed})
  if(WITH_TESTS)
    set(which --include=dev)
  else()
    set(which --omit=dev)
  endif()
  execute_process(COMMAND ${NPM} ci ${which} --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1
                  WORKING_DIRECTORY ${PAGE} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output TIMEOUT 600)
  if(NOT result EQUAL 0)  # no network: not a fault of the tree, and everything but the page can be built
    message("${output}")
    message(WARNING "No page: what it is built with could not be installed (npm ci). latsch is built without the page of "
                    "latsch serve; touch apps/web/package.json to try again.")
    file(WRITE ${GENERATED} "#include \"web/web_assets.h\"\n\n"
         "std::vector<latsch::studio::Asset> latsch::studio::web_assets() { return {}; }\n")
    return()
  endif()
  file(GLOB old ${PAGE}/installed_*)
  if(old)
    file(REMOVE ${old})
  endif()
  file(TOUCH ${installed})
endif()
run_in_page("Building the page (npm run build)" ${NPM} run build)
string(REGEX MATCHALL "[^\n]*(first script|report\\.js [0-9])[^\n]*" sizes "${output}")
foreach(line ${sizes})
  message(STATUS "${line}")
endforeach()
run_in_page("Embedding the page" ${NODE} tools/embed.mjs ${PAGE}/dist ${GENERATED})
