# The programs as a user runs them, and the scripts around them: <label>/<name>.py <folder with the programs>.
find_program(MESOSLIP_DOXYGEN doxygen)
foreach(candidate $ENV{MESOSLIP_PYTHON} python3 /usr/bin/python3)
  execute_process(COMMAND ${candidate} -c "import h5py, matplotlib, numpy, scipy" RESULT_VARIABLE missing ERROR_QUIET OUTPUT_QUIET)
  if(missing STREQUAL 0)
    set(MESOSLIP_PYTHON ${candidate})
    break()
  endif()
endforeach()
if(NOT MESOSLIP_PYTHON)
  message(STATUS "mesoslip: neither $MESOSLIP_PYTHON nor python3 has h5py, matplotlib, numpy and scipy; the tests of the programs are left out")
  return()
endif()

# A program without physics, to test from outside what all programs share.
add_executable(io_program ${CMAKE_CURRENT_LIST_DIR}/programs/io_program.cc)
mesoslip_warnings(io_program)
deal_ii_setup_target(io_program)
target_link_libraries(io_program mesoslip_program)

# The programs without the time that their start takes, for scenes.py; mpirun starts clients of it.
add_executable(program_server ${CMAKE_CURRENT_LIST_DIR}/../scenes/program_server.cc)
mesoslip_warnings(program_server)
mesoslip_patient_ranks(program_server)
deal_ii_setup_target(program_server)
target_link_libraries(program_server mesoslip_sliding mesoslip_localization)
add_executable(program_client ${CMAKE_CURRENT_LIST_DIR}/../scenes/program_client.cc)
mesoslip_warnings(program_client)
add_dependencies(program_server program_client)

# mesoslip_python_tests(<label> <processors> <name>...); exit status 77: what the test needs is not installed.
function(mesoslip_python_tests label processors)
  foreach(name ${ARGN})
    add_test(NAME ${label}/${name} COMMAND ${MESOSLIP_PYTHON} -B ${CMAKE_SOURCE_DIR}/tests/${label}/${name}.py
             ${CMAKE_BINARY_DIR}/applications)
    set_tests_properties(${label}/${name} PROPERTIES LABELS ${label} TIMEOUT 600 PROCESSORS ${processors} SKIP_RETURN_CODE 77
                         ENVIRONMENT PYTHONPATH=${CMAKE_SOURCE_DIR}/tests/scenes)
  endforeach()
endfunction()

# mesoslip_long_test(<label>/<name> <processors> <argument>...): the same script with arguments that ask for more of it, as <label>/<name>.long
# with the label long, which ./test.sh leaves out.
function(mesoslip_long_test script processors)
  add_test(NAME ${script}.long COMMAND ${MESOSLIP_PYTHON} -B ${CMAKE_SOURCE_DIR}/tests/${script}.py ${CMAKE_BINARY_DIR}/applications ${ARGN})
  set_tests_properties(${script}.long PROPERTIES LABELS long TIMEOUT 1800 PROCESSORS ${processors} SKIP_RETURN_CODE 77
                       ENVIRONMENT PYTHONPATH=${CMAKE_SOURCE_DIR}/tests/scenes)
endfunction()

mesoslip_python_tests(system 1 chains/complex_moduli chains/export_volume chains/material_card chains/volume_size chains/chain_inputs chains/chain_validation chains/counter_localization chains/python_module chains/python_runs chains/setup chains/shortcuts
                      homogenization/refused_statics pages/dependencies pages/gallery pages/guide pages/links pages/mesh_scripts pages/parameter_reference pages/prediction
                      pages/site pages/studies pages/thickness pages/verification_page pages/work_precision programs/bad_input programs/command_line programs/completion
                      programs/disk programs/earlier_results programs/profile_rows programs/terminal report/browser report/whole_page
                      report/report_layout report/report_modes sliding/complex_modes_growth sliding/complex_modes_laws
                      sliding/contact_map)
mesoslip_python_tests(system 2 chains/chain chains/drafts chains/package homogenization/mesh localization/heat localization/mesh_localization localization/voxels
                      pages/first_steps pages/paper pages/tomogram programs/files programs/other_processors
                      programs/ranks programs/xdmf sliding/boxes sliding/complex_modes sliding/friction_homogenization sliding/mesh_dynamics
                      sliding/mesh_flat sliding/mesh_modes sliding/mesh_periodic sliding/mesh_static_contact sliding/one_run sliding/oriented_boxes
                      sliding/contact_stiffness sliding/profile sliding/tangential_stiffness sliding/counter_body sliding/counter_bodies sliding/unmatched_surfaces sliding/resume sliding/side_platens sliding/side_supports sliding/start sliding/steady_part sliding/supports sliding/continue_run sliding/single_precision sliding/sweep)
mesoslip_python_tests(verification 1 stability contact/hertz contact/hertz_pair contact/hertz_sphere contact/incremental_friction contact/incremental_sphere
                      contact/mesh_friction_vector contact/oblique_modes contact/random_resting_solids contact/random_static_contact
                      contact/spence contact/static_localization volumes/hexagonal_cell volumes/curved_cells volumes/independent_finite_elements
                      volumes/mesh_inclusions volumes/quadratic_cells voxels/voxel_files)
mesoslip_python_tests(verification 2 dynamics/damped_layers dynamics/layers dynamics/mean_dilatation contact/wear contact/large_strains contact/absorbing_layer contact/falling_friction contact/random_pairs contact/random_surfaces contact/half_spaces contact/interface_pulse contact/rupture_times contact/equal_bodies contact/random_pairs_at_rest contact/random_supports contact/two_layers contact/mesh_ranks contact/resting_flat volumes/divided_plane
                      volumes/conductivity volumes/derivatives volumes/frequency_derivatives volumes/thermal_expansion volumes/macroscopic_loads volumes/macroscopic_loads_kinds volumes/mixed_conditions voxels/voxel_extremes voxels/voxel_orientations
                      voxels/voxel_random voxels/voxels voxels/box_modes)
mesoslip_python_tests(regression 1 stored_runs)
set_property(TEST system/chains/chain APPEND PROPERTY LABELS regression) # its numbers are stored, too
# Above a quarter of a minute each; ./test.sh --quick leaves them out.
foreach(name chains/chain_validation chains/package chains/python_runs pages/guide pages/tomogram programs/other_processors programs/ranks
             report/whole_page sliding/boxes sliding/complex_modes sliding/complex_modes_laws sliding/contact_map sliding/contact_stiffness sliding/mesh_flat sliding/mesh_modes
             sliding/mesh_periodic sliding/oriented_boxes sliding/resume sliding/side_platens sliding/side_supports sliding/supports sliding/continue_run sliding/single_precision sliding/sweep)
  set_property(TEST system/${name} APPEND PROPERTY LABELS slow)
endforeach()
mesoslip_long_test(system/sliding/resume 2 --long)
mesoslip_long_test(verification/contact/random_static_contact 1 500)
# Meshes in 3D whose static contact takes most of a minute.
set_property(TEST verification/contact/hertz_sphere verification/contact/incremental_sphere APPEND PROPERTY LABELS long)
if(MESOSLIP_DOXYGEN)
  mesoslip_python_tests(system 1 pages/doxygen)
else()
  message(STATUS "mesoslip: no doxygen; system/pages/doxygen is left out")
endif()
# Scripts that nothing runs are no tests; these are parts of others.
set(parts system/pages/architecture system/programs/xdmf_in_paraview system/report/synthetic_chain verification/mesh_pin verification/problems
          verification/run)
file(GLOB_RECURSE scripts CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} system/*.py verification/*.py)
foreach(script ${scripts})
  string(REGEX REPLACE "\\.py$" "" name ${script})
  if(NOT TEST ${name} AND NOT name IN_LIST parts AND NOT name MATCHES "pages/doxygen$")
    message(FATAL_ERROR "tests/${script} is no test: name it in tests/system/python.cmake")
  endif()
endforeach()
