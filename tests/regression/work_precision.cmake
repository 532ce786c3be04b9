if(MESOSLIP_PYTHON)
  mesoslip_python_test(regression work_precision)
endif()
