mesoslip_test(verification statics LIBS mesoslip_simulation)
target_sources(verification_statics PRIVATE
  ${CMAKE_CURRENT_LIST_DIR}/statics_modes.cc)
