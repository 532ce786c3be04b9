# The multigrid of mesoslip_elasticity. Its row kernels are compiled once for each
# instruction set; it is a preconditioner, so contraction may do what it likes.
file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cc)
target_sources(mesoslip_elasticity PRIVATE ${sources})
foreach(isa x86_64 x86_64_v3 x86_64_v4)
  set(kernel_options -ffp-contract=fast ${mesoslip_kernel_options})
  if(isa STREQUAL "x86_64_v3")
    list(APPEND kernel_options -march=x86-64-v3)
  elseif(isa STREQUAL "x86_64_v4")
    list(APPEND kernel_options -march=x86-64-v4 -mprefer-vector-width=512)
  endif()
  set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/kernels_${isa}.cc PROPERTIES
    COMPILE_OPTIONS "${kernel_options}")
endforeach()
unset(sources)
unset(kernel_options)
