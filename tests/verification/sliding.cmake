mesoslip_test(verification sliding RANKS 2 LIBS mesoslip_sliding)
target_sources(verification_sliding PRIVATE
  ${CMAKE_CURRENT_LIST_DIR}/sliding_column.cc
  ${CMAKE_CURRENT_LIST_DIR}/sliding_growth.cc)
