mesoslip_test(unit elasticity RANKS 2 LIBS mesoslip_contact)
target_sources(unit_elasticity PRIVATE
  ${CMAKE_CURRENT_LIST_DIR}/elasticity_stepper.cc
  ${CMAKE_CURRENT_LIST_DIR}/elasticity_time_step.cc
  ${CMAKE_CURRENT_LIST_DIR}/elasticity_mesh.cc)
