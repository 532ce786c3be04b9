# A program without physics, to test from outside what all programs share.
add_executable(io_program ${CMAKE_CURRENT_SOURCE_DIR}/unit/io_program.cc)
mesoslip_warnings(io_program)
deal_ii_setup_target(io_program)
target_link_libraries(io_program mesoslip_program)

# It starts mpirun, which a process with MPI cannot.
mesoslip_test(unit io NO_MPI LIBS mesoslip_exchange mesoslip_program)
target_sources(unit_io PRIVATE
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/io_command_line.cc
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/io_files.cc
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/io_hdf5.cc
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/io_hdf5_contents.cc
  ${CMAKE_CURRENT_SOURCE_DIR}/unit/io_images.cc)
target_compile_definitions(unit_io PRIVATE
  IO_PROGRAM="$<TARGET_FILE:io_program>" MPIEXEC="${MPIEXEC_EXECUTABLE}")
add_dependencies(unit_io io_program)
# The settings of one process do not apply to mpirun.
set_tests_properties(unit/io PROPERTIES ENVIRONMENT "")
