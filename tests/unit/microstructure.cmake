mesoslip_test(unit microstructure LIBS mesoslip_morphology)
target_sources(unit_microstructure PRIVATE
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/morphology_files.cc
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/microstructure_keys.cc
  ${CMAKE_CURRENT_LIST_DIR}/microstructure_parameters.cc)
