mesoslip_test(unit multigrid LIBS mesoslip_body)
target_sources(unit_multigrid PRIVATE ${CMAKE_CURRENT_LIST_DIR}/multigrid_definiteness.cc)
