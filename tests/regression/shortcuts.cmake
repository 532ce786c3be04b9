if(MESOSLIP_PYTHON)
  mesoslip_python_test(regression shortcuts)
endif()
