# The report on synthetic result folders: complete, partial, broken.
find_program(MESOSLIP_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(MESOSLIP_PYTHON)
  execute_process(COMMAND ${MESOSLIP_PYTHON} -c "import h5py, numpy, matplotlib"
                  RESULT_VARIABLE MESOSLIP_PYTHON_MISSES ERROR_QUIET OUTPUT_QUIET)
  if(MESOSLIP_PYTHON_MISSES EQUAL 0)
    add_test(NAME regression/report
             COMMAND ${MESOSLIP_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/report.py
                     ${CMAKE_SOURCE_DIR}/applications/tools/report/make_report.py)
    set_tests_properties(regression/report PROPERTIES LABELS regression TIMEOUT 300)
  else()
    message(STATUS "mesoslip: python3 lacks h5py, numpy or matplotlib; regression/report is left out")
  endif()
endif()
