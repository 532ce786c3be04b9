# Static analysis of library and programs; without cppcheck there is no such test. All checks but those about unused
# functions (the library has more functions than its own programs use) and about headers that are missing: only ours are read.
find_program(MESOSLIP_CPPCHECK cppcheck)
if(MESOSLIP_CPPCHECK)
  add_test(NAME lint/cppcheck
           COMMAND ${MESOSLIP_CPPCHECK} --quiet --std=c++17 --language=c++ --error-exitcode=1
                   --enable=warning,performance,portability,style --suppress=missingIncludeSystem
                   --suppressions-list=${CMAKE_CURRENT_LIST_DIR}/cppcheck_suppressions.txt
                   -I ${CMAKE_SOURCE_DIR}/lib ${CMAKE_SOURCE_DIR}/lib ${CMAKE_SOURCE_DIR}/applications)
  set_tests_properties(lint/cppcheck PROPERTIES LABELS lint TIMEOUT 900)
endif()
