# Dispersion relation, sliding modes and mixtures of the prediction study.
find_program(MESOSLIP_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(MESOSLIP_PYTHON)
  execute_process(COMMAND ${MESOSLIP_PYTHON} -c "import h5py, numpy, scipy"
                  RESULT_VARIABLE MESOSLIP_PYTHON_MISSES ERROR_QUIET OUTPUT_QUIET)
  if(MESOSLIP_PYTHON_MISSES EQUAL 0)
    add_test(NAME regression/prediction
             COMMAND ${MESOSLIP_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/prediction.py)
    set_tests_properties(regression/prediction PROPERTIES LABELS regression TIMEOUT 300)
  else()
    message(STATUS "mesoslip: python3 lacks h5py, numpy or scipy; regression/prediction is left out")
  endif()
endif()
