# The page of the paper on a coarse grid. The function is in chain.cmake, the check for the libraries in report.cmake.
if(MESOSLIP_PYTHON AND MESOSLIP_PYTHON_MISSES EQUAL 0)
  mesoslip_python_test(regression paper PROCESSORS 2)
endif()
