mesoslip_test(verification homogenization RANKS 2 LIBS mesoslip_homogenization)
target_sources(verification_homogenization PRIVATE
  ${CMAKE_CURRENT_LIST_DIR}/ensemble_ranks.cc
  ${CMAKE_CURRENT_LIST_DIR}/random_microstructures.cc
  ${CMAKE_CURRENT_LIST_DIR}/random_statics.cc)
