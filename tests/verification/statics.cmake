mesoslip_test(verification statics LIBS mesoslip_sliding)
target_sources(verification_statics PRIVATE
  ${CMAKE_CURRENT_LIST_DIR}/statics_modes.cc)
