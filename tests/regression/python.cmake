# The programs as a user runs them, and the scripts around them: <label>/<name>.py <folder with the programs>.
find_program(MESOSLIP_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(MESOSLIP_DOXYGEN doxygen)
if(NOT MESOSLIP_PYTHON)
  return()
endif()
execute_process(COMMAND ${MESOSLIP_PYTHON} -c "import h5py, matplotlib, numpy, scipy"
                RESULT_VARIABLE missing ERROR_QUIET OUTPUT_QUIET)
if(missing)
  message(STATUS "mesoslip: python3 lacks h5py, matplotlib, numpy or scipy; the tests of the programs are left out")
  return()
endif()

# A program without physics, to test from outside what all programs share.
add_executable(io_program ${CMAKE_CURRENT_LIST_DIR}/io_program.cc)
mesoslip_warnings(io_program)
deal_ii_setup_target(io_program)
target_link_libraries(io_program mesoslip_program)

# mesoslip_python_tests(<label> <processors> <name>...); exit status 77: what the test needs is not installed.
function(mesoslip_python_tests label processors)
  foreach(name ${ARGN})
    add_test(NAME ${label}/${name} COMMAND ${MESOSLIP_PYTHON} -B ${CMAKE_SOURCE_DIR}/tests/${label}/${name}.py
             ${CMAKE_BINARY_DIR}/applications)
    set_tests_properties(${label}/${name} PROPERTIES LABELS ${label} TIMEOUT 600 PROCESSORS ${processors} SKIP_RETURN_CODE 77)
  endforeach()
endfunction()

mesoslip_python_tests(regression 1 chain_inputs bad_input earlier_results dependencies refused_statics links verification_page completion
                      python_module python_runs parameter_reference prediction report report_layout shortcuts profile_rows setup site gallery studies
                      terminal disk browser work_precision complex_modes_growth complex_modes_laws)
mesoslip_python_tests(regression 2 chain chain_validation files resume ranks steady_part first_steps guide command_line package paper
                      other_processors xdmf mesh mesh_dynamics boxes mesh_periodic mesh_flat contact_map mesh_localization mesh_modes
                      mesh_static_contact complex_modes)
mesoslip_python_tests(verification 1 independent_finite_elements static_localization stability hexagonal_cell mesh_inclusions mesh_friction_vector
                      hertz spence incremental_friction)
mesoslip_python_tests(verification 1 voxel_files)
mesoslip_python_tests(verification 2 large_strains mesh_ranks voxel_random voxels macroscopic_loads mixed_conditions)
if(MESOSLIP_DOXYGEN)
  mesoslip_python_tests(regression 1 doxygen)
else()
  message(STATUS "mesoslip: no doxygen; regression/doxygen is left out")
endif()
