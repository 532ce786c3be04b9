mesoslip_test(verification dynamics LIBS mesoslip_sliding)
target_sources(verification_dynamics PRIVATE
  ${CMAKE_CURRENT_LIST_DIR}/dynamics_bar.cc
  ${CMAKE_CURRENT_LIST_DIR}/dynamics_energy.cc
  ${CMAKE_CURRENT_LIST_DIR}/dynamics_monitor.cc
  ${CMAKE_CURRENT_LIST_DIR}/dynamics_stability.cc
  ${CMAKE_CURRENT_LIST_DIR}/dynamics_top.cc
  ${CMAKE_CURRENT_LIST_DIR}/dynamics_turned.cc)
