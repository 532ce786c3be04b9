# Dispersion relation, sliding modes and mixtures of the prediction study. The function is in chain.cmake.
if(MESOSLIP_PYTHON)
  execute_process(COMMAND ${MESOSLIP_PYTHON} -c "import h5py, numpy, scipy"
                  RESULT_VARIABLE MESOSLIP_PYTHON_MISSES ERROR_QUIET OUTPUT_QUIET)
  if(MESOSLIP_PYTHON_MISSES EQUAL 0)
    mesoslip_python_test(regression prediction)
  else()
    message(STATUS "mesoslip: python3 lacks h5py, numpy or scipy; regression/prediction is left out")
  endif()
endif()
