# The row kernels, once for each instruction set; which one runs is decided at run time
# (instruction_set.h). Contraction is off: fused multiply-adds stand where the kernel
# writes them, so that all its variants agree bit for bit. The four -fno- options keep GCC
# from spilling what it moved out of the loop (5 % with AVX-512, 6 % with AVX2).
set(kernel_options -ffp-contract=off ${mesoslip_kernel_options})
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND kernel_options -fno-ivopts -fno-tree-loop-im -fno-gcse -fno-tree-pre)
endif()
set_source_files_properties(elasticity/row_kernel_x86_64.cc PROPERTIES
  COMPILE_OPTIONS "${kernel_options}")
set_source_files_properties(elasticity/row_kernel_x86_64_v3.cc PROPERTIES
  COMPILE_OPTIONS "${kernel_options};-march=x86-64-v3")
set_source_files_properties(elasticity/row_kernel_x86_64_v4.cc PROPERTIES
  COMPILE_OPTIONS "${kernel_options};-march=x86-64-v4;-mprefer-vector-width=512")
unset(kernel_options)
