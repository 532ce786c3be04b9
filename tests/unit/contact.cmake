mesoslip_test(unit contact LIBS mesoslip_contact)
target_sources(unit_contact PRIVATE
  ${CMAKE_CURRENT_LIST_DIR}/contact_block.cc
  ${CMAKE_CURRENT_LIST_DIR}/contact_kernel.cc)
