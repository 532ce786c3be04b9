# Programs, libraries, headers, scripts, and a CMake package:
#   find_package(mesoslip REQUIRED)
#   add_executable(mine mine.cc)
#   mesoslip_link(mine contact io)      # the topics of lib/ that it uses
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/mesoslip)
set(data_dir ${CMAKE_INSTALL_DATADIR}/mesoslip)
set(tools ${CMAKE_SOURCE_DIR}/applications/tools)

get_property(topics GLOBAL PROPERTY mesoslip_topics)
list(TRANSFORM topics PREPEND mesoslip_ OUTPUT_VARIABLE libraries)
install(TARGETS ${libraries} EXPORT mesoslip ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT mesoslip FILE mesoslipTargets.cmake NAMESPACE mesoslip:: DESTINATION ${package_dir})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/lib/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mesoslip
        FILES_MATCHING PATTERN "*.h")
install(TARGETS rve_homogenization contact_dynamics stress_localization
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

# Scripts keep their places beside one another: run_chain.py uses chain/ and calls report/make_report.py.
install(DIRECTORY ${tools}/chain ${tools}/report ${tools}/python DESTINATION ${data_dir}/applications/tools
        FILES_MATCHING PATTERN "*.py" PATTERN "*.toml")
install(PROGRAMS ${tools}/run_chain.py ${tools}/volume_size.py ${tools}/material_card.py ${tools}/export_volume.py ${tools}/complex_moduli.py
        DESTINATION ${data_dir}/applications/tools)
install(FILES ${tools}/studies/study.py DESTINATION ${data_dir}/applications/tools/studies)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/prm DESTINATION ${data_dir})
foreach(program rve_homogenization contact_dynamics stress_localization)
  install(FILES ${tools}/completion.bash
          DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ${program})
endforeach()
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/CITATION.cff
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/mesoslipConfig.cmake.in
  ${CMAKE_BINARY_DIR}/mesoslipConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/mesoslipConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/mesoslipConfig.cmake ${CMAKE_BINARY_DIR}/mesoslipConfigVersion.cmake
        DESTINATION ${package_dir})
