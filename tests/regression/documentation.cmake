# The guide by the letter, links. The function is in chain.cmake.
if(MESOSLIP_PYTHON)
  mesoslip_python_test(regression first_steps PROCESSORS 2)
  mesoslip_python_test(regression links)
endif()
