# The pages of parameters and the shipped .prm files. The function is in chain.cmake.
if(MESOSLIP_PYTHON)
  mesoslip_python_test(regression parameter_reference)
endif()
