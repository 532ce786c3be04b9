# Fuzzers of everything that is read. With clang and MESOSLIP_SANITIZE, fuzz_<target> [libFuzzer's options] [folders of
# inputs] looks for new inputs; each test does for some seconds, ./test.sh --fuzz SECONDS for longer. With any other
# compiler it replays those in fuzz/corpus/<target> and some thousand changed ones (replay.cc).
if(MESOSLIP_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  set(has_libfuzzer TRUE)
endif()

if(NOT has_libfuzzer)
  add_library(fuzz_replay STATIC ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/replay.cc)
  deal_ii_setup_target(fuzz_replay)
  mesoslip_warnings(fuzz_replay)
  target_link_libraries(fuzz_replay mesoslip_program)
endif()

# mesoslip_fuzzer(<target> MUTATIONS <n> LIBS <library>...): so many in the test without libFuzzer
function(mesoslip_fuzzer target)
  cmake_parse_arguments(ARG "" "MUTATIONS" "LIBS" ${ARGN})
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/fuzz)
  set(program fuzz_${target})
  add_executable(${program} ${folder}/${target}.cc)
  deal_ii_setup_target(${program})
  mesoslip_warnings(${program})
  if(has_libfuzzer)
    # clang gives some templates of deal.II's Trilinos classes other names than GCC, which has built that library. They are of
    # bodies on meshes, which no fuzzer calls.
    target_link_options(${program} PRIVATE -fsanitize=fuzzer -Wl,--unresolved-symbols=ignore-all)
    target_link_libraries(${program} ${ARG_LIBS})
    add_test(NAME fuzz/${target} COMMAND ${folder}/run.sh $<TARGET_FILE:${program}> 5)
  else()
    target_link_libraries(${program} fuzz_replay ${ARG_LIBS})
    add_test(NAME fuzz/${target} COMMAND ${program} ${folder}/corpus/${target} ${ARG_MUTATIONS}
             ${CMAKE_CURRENT_BINARY_DIR}/fuzz_${target}.last)
  endif()
  set_tests_properties(fuzz/${target} PROPERTIES LABELS system TIMEOUT 120 ENVIRONMENT "ASAN_OPTIONS=detect_leaks=0")
  add_dependencies(fuzzers ${program})
endfunction()

add_custom_target(fuzzers)
mesoslip_fuzzer(table MUTATIONS 5000 LIBS mesoslip_morphology)
mesoslip_fuzzer(image MUTATIONS 5000 LIBS mesoslip_morphology)
mesoslip_fuzzer(voxels MUTATIONS 5000 LIBS mesoslip_io)
mesoslip_fuzzer(expression MUTATIONS 5000 LIBS mesoslip_contact)
mesoslip_fuzzer(summary MUTATIONS 5000 LIBS mesoslip_sliding)
mesoslip_fuzzer(parameters MUTATIONS 500 LIBS mesoslip_sliding mesoslip_localization)
