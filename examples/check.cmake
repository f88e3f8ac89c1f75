# Installs Latsch into an empty folder, builds the examples against that folder alone, and runs each of them. An example whose
# head shows what it prints has to print that.
set(work ${BUILD}/examples)
file(REMOVE_RECURSE ${work})
set(program ${work}/build)

function(run out)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE error WORKING_DIRECTORY ${work})
  if(result)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${output}${error}")
  endif()
  set(${out} "${output}" PARENT_SCOPE)
endfunction()

function(expect text regex)
  if(NOT text MATCHES "${regex}")
    message(FATAL_ERROR "expected ${regex} in\n${text}")
  endif()
endfunction()

# The lines "//   TEXT" below the sample command in the head of an example.
function(expect_as_shown example text)
  file(STRINGS ${SOURCE}/examples/${example}.cpp lines REGEX "^//   ")
  set(shown FALSE)
  foreach(line ${lines})
    string(REGEX REPLACE "^//   " "" line "${line}")
    if(shown AND NOT line MATCHES "^\\$ ")
      string(FIND "${text}" "${line}" found)
      if(found EQUAL -1)
        message(FATAL_ERROR "${example} does not print \"${line}\":\n${text}")
      endif()
    endif()
    if(line MATCHES "^\\$ ${example}")
      set(shown TRUE)
    endif()
  endforeach()
  if(NOT shown)
    message(FATAL_ERROR "the head of ${example}.cpp shows no sample run")
  endif()
endfunction()

file(MAKE_DIRECTORY ${work})
run(out ${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/install)
run(out ${CMAKE_COMMAND} -S ${SOURCE}/examples -B ${program} -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${work}/install -D CMAKE_BUILD_TYPE=Release)
run(out ${CMAKE_COMMAND} --build ${program})

run(out ${program}/1_fit_a_decay)
expect_as_shown(1_fit_a_decay "${out}")

set(study ${SOURCE}/studies/compliance/study.toml)
run(out ${program}/2_run_a_study ${study} ${work}/study.latsch)
expect("${out}" "The search ended .*= [0-9]")
run(again ${program}/2_run_a_study ${study} ${work}/study.latsch)  # from the journal
if(NOT out STREQUAL again)
  message(FATAL_ERROR "a second run on the journal differs:\n${out}\n${again}")
endif()
run(out ${program}/6_read_a_journal ${study} ${work}/study.latsch)
expect("${out}" "target\n[-0-9.e,]+\n")

file(WRITE ${work}/spring.toml "kind = \"spring\"\nstiffness = \"20 N/mm\"\ndamping = \"300 N s/m\"\n")
run(out ${program}/3_a_model_of_ones_own test spring.toml
    "{kind = \"pull\", speed = \"0.4 m/s\", travels = [\"2 mm\", \"5 mm\"]}")
expect_as_shown(3_a_model_of_ones_own "${out}")

run(out ${program}/4_press_a_finite_element_tire ${SOURCE}/studies/tires/passenger_205_55R16.toml)
expect("${out}" "inflated at 2\\..* bar.*20 mm: +[0-9]+ N, footprint [0-9]+ x [0-9]+ mm.*Hz  ")
run(out ${program}/5_roll_a_ring_tire ${SOURCE}/studies/ring_tires/passenger_205_55R16.toml)
expect("${out}" "at rest: Fz = [0-9]+ N\n.*0\\.100 ")
