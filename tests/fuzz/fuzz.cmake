# Fuzzers of what is read byte by byte (CSV, images, the frame of checkpoints): fuzz_<target> [libFuzzer's options]
# [folders of inputs]. They need clang and MESOSLIP_SANITIZE. Inputs once found to matter are in fuzz/corpus/<target>;
# each test replays them and looks for new ones for some seconds. For longer: ./test.sh --fuzz SECONDS.
if(MESOSLIP_SANITIZE AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  # mesoslip_fuzzer(<target> LIBS <library>...)
  function(mesoslip_fuzzer target)
    cmake_parse_arguments(ARG "" "" "LIBS" ${ARGN})
    add_executable(fuzz_${target} ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/${target}.cc)
    deal_ii_setup_target(fuzz_${target})
    mesoslip_warnings(fuzz_${target})
    target_link_libraries(fuzz_${target} ${ARG_LIBS})
    target_link_options(fuzz_${target} PRIVATE -fsanitize=fuzzer)
    add_test(NAME fuzz/${target}
             COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/run.sh $<TARGET_FILE:fuzz_${target}> 5)
    set_tests_properties(fuzz/${target} PROPERTIES LABELS fuzz TIMEOUT 120)
    add_dependencies(fuzzers fuzz_${target})
  endfunction()

  add_custom_target(fuzzers)
  mesoslip_fuzzer(table LIBS mesoslip_microstructure)
  mesoslip_fuzzer(image LIBS mesoslip_microstructure)
  mesoslip_fuzzer(checkpoint LIBS mesoslip_io)
endif()
