mesoslip_test(unit localization LIBS mesoslip_localization)
target_sources(unit_localization PRIVATE
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/localization_files.cc
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/localization_runs.cc
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/localization_parameters.cc)
