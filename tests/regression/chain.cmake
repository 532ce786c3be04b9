# The three programs as a user runs them.
find_program(MESOSLIP_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)

# mesoslip_python_test(<label> <name> [TIMEOUT s] [PROCESSORS n]): tests/<label>/<name>.py <programs>
function(mesoslip_python_test label name)
  cmake_parse_arguments(ARG "" "TIMEOUT;PROCESSORS" "" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 600)
  endif()
  if(NOT ARG_PROCESSORS)
    set(ARG_PROCESSORS 1)
  endif()
  add_test(NAME ${label}/${name}
           COMMAND ${MESOSLIP_PYTHON} -B ${CMAKE_SOURCE_DIR}/tests/${label}/${name}.py
                   ${CMAKE_BINARY_DIR}/applications)
  set_tests_properties(${label}/${name} PROPERTIES LABELS ${label} TIMEOUT ${ARG_TIMEOUT}
                       PROCESSORS ${ARG_PROCESSORS})
endfunction()

if(MESOSLIP_PYTHON)
  mesoslip_python_test(regression chain PROCESSORS 2)
  mesoslip_python_test(regression chain_inputs)
  mesoslip_python_test(regression bad_input)
  mesoslip_python_test(regression earlier_results)
  mesoslip_python_test(regression files PROCESSORS 2)
  mesoslip_python_test(regression dependencies)
  mesoslip_python_test(regression resume PROCESSORS 2)
  mesoslip_python_test(regression ranks PROCESSORS 2)
  mesoslip_python_test(regression steady_part PROCESSORS 2)
  mesoslip_python_test(regression refused_statics)
  mesoslip_python_test(verification independent_finite_elements)
  mesoslip_python_test(verification independent_modes)
  mesoslip_python_test(verification large_strains PROCESSORS 2)
  mesoslip_python_test(verification static_localization)
  mesoslip_python_test(verification stability)
endif()
