# The row kernels, once for each instruction set; which one runs is decided at run time
# (instruction_set.h). Contraction is off: fused multiply-adds stand where the kernel
# writes them, so that all its variants agree bit for bit.
set_source_files_properties(elasticity/row_kernel_x86_64.cc PROPERTIES
  COMPILE_OPTIONS "-ffp-contract=off;-fno-exceptions")
set_source_files_properties(elasticity/row_kernel_x86_64_v3.cc PROPERTIES
  COMPILE_OPTIONS "-ffp-contract=off;-fno-exceptions;-march=x86-64-v3")
set_source_files_properties(elasticity/row_kernel_x86_64_v4.cc PROPERTIES
  COMPILE_OPTIONS "-ffp-contract=off;-fno-exceptions;-march=x86-64-v4;-mprefer-vector-width=512")
