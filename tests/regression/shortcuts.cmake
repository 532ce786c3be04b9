if(MESOSLIP_PYTHON)
  mesoslip_python_test(regression shortcuts)
  mesoslip_python_test(regression profile_rows)
endif()
