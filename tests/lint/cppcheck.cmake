# Static analysis of library and programs by the cppcheck of Debian 12; others find other things, and then there is no such test. All checks but those about unused
# functions (the library has more functions than its own programs use) and about headers that are missing: only ours are read.
find_program(MESOSLIP_CPPCHECK cppcheck)
if(MESOSLIP_CPPCHECK)
  execute_process(COMMAND ${MESOSLIP_CPPCHECK} --version OUTPUT_VARIABLE cppcheck_version)
endif()
if(cppcheck_version MATCHES " 2[.]10")
  # What it found in a file is kept until the file or its headers change, also for other clones: paths are relative.
  set(kept $ENV{HOME}/.cache/mesoslip/cppcheck)
  file(MAKE_DIRECTORY ${kept})
  add_test(NAME lint/cppcheck WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
           COMMAND ${MESOSLIP_CPPCHECK} --cppcheck-build-dir=${kept} --quiet --std=c++17 --language=c++ --error-exitcode=1
                   --enable=warning,performance,portability,style --suppress=missingIncludeSystem
                   --suppressions-list=${CMAKE_CURRENT_LIST_DIR}/cppcheck_suppressions.txt
                   -I lib lib applications)
  set_tests_properties(lint/cppcheck PROPERTIES LABELS lint TIMEOUT 900 COST 500)
endif()
