# Terminals, full disks, the report in a browser, ParaView, another processor. Exit status 77: what the test needs is not there. The function is in chain.cmake.
if(MESOSLIP_PYTHON)
  mesoslip_python_test(regression terminal TIMEOUT 120)
  mesoslip_python_test(regression disk TIMEOUT 180)
  mesoslip_python_test(regression other_processors TIMEOUT 300 PROCESSORS 2)
  set_tests_properties(regression/other_processors PROPERTIES SKIP_RETURN_CODE 77)
  mesoslip_python_test(regression xdmf TIMEOUT 180 PROCESSORS 2)
  set_tests_properties(regression/xdmf PROPERTIES SKIP_RETURN_CODE 77)
  if(MESOSLIP_PYTHON_MISSES EQUAL 0)
    add_test(NAME regression/browser
             COMMAND ${MESOSLIP_PYTHON} -B ${CMAKE_CURRENT_LIST_DIR}/browser.py
                     ${CMAKE_SOURCE_DIR}/applications/tools/report/make_report.py)
    set_tests_properties(regression/browser PROPERTIES LABELS regression TIMEOUT 300 SKIP_RETURN_CODE 77)
  endif()
endif()
