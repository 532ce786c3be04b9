# mesoslip as another project uses it, the shell completion, the Python module. The function is in chain.cmake.
if(MESOSLIP_PYTHON)
  mesoslip_python_test(regression package PROCESSORS 2)
  mesoslip_python_test(regression completion)
  mesoslip_python_test(regression python_module)
endif()
