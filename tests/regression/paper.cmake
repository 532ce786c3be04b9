# The page of the paper: parts, settings, some of it on a coarse grid. The function is in chain.cmake.
if(MESOSLIP_PYTHON)
  execute_process(COMMAND ${MESOSLIP_PYTHON} -c "import h5py, numpy, matplotlib"
                  RESULT_VARIABLE MESOSLIP_PYTHON_MISSES ERROR_QUIET OUTPUT_QUIET)
  if(MESOSLIP_PYTHON_MISSES EQUAL 0)
    mesoslip_python_test(regression paper PROCESSORS 2)
  else()
    message(STATUS "mesoslip: python3 lacks h5py, numpy or matplotlib; regression/paper is left out")
  endif()
endif()
