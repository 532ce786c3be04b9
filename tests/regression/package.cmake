# mesoslip as another project uses it, and the shell completion. The function is in chain.cmake.
if(MESOSLIP_PYTHON)
  mesoslip_python_test(regression package PROCESSORS 2)
  mesoslip_python_test(regression completion)
endif()
