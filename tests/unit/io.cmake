add_executable(io_program ${CMAKE_CURRENT_SOURCE_DIR}/unit/io_program.cc)
mesoslip_warnings(io_program)
deal_ii_setup_target(io_program)
target_link_libraries(io_program mesoslip_io)
