# Installs Latsch into a fresh folder, then configures, builds and runs a project that only knows that folder.
set(work ${BUILD}/consumer)
file(REMOVE_RECURSE ${work})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(result)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
endfunction()

# The page holds the only copy of its program and of the program's output.
file(READ ${SOURCE}/docs/optimization_api.md page)
string(FIND "${page}" "```cpp\n" begin)
math(EXPR begin "${begin} + 7")
string(SUBSTRING "${page}" ${begin} -1 program)
string(FIND "${program}" "```" end)
string(SUBSTRING "${program}" 0 ${end} program)
file(WRITE ${work}/build/decay.cpp "${program}")

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/install)
run(${CMAKE_COMMAND} -S ${SOURCE}/cmake/consumer -B ${work}/build -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${work}/install -D CMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${work}/build)
run(${work}/build/consumer)

execute_process(COMMAND ${work}/build/decay RESULT_VARIABLE result OUTPUT_VARIABLE printed)
string(STRIP "${printed}" printed)
string(REPLACE "\n" "\n    " printed "    ${printed}")
string(FIND "${page}" "${printed}" found)
if(result OR found EQUAL -1)
  message(FATAL_ERROR "docs/optimization_api.md does not say what its program prints:\n${printed}")
endif()
