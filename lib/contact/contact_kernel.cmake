# The contact kernel, once for each instruction set; contraction is off, so that all give
# the same bits.
set(kernel_options -ffp-contract=off ${mesoslip_kernel_options})
set_source_files_properties(contact/contact_kernel_x86_64.cc PROPERTIES
  COMPILE_OPTIONS "${kernel_options}")
set_source_files_properties(contact/contact_kernel_x86_64_v3.cc PROPERTIES
  COMPILE_OPTIONS "${kernel_options};-march=x86-64-v3")
set_source_files_properties(contact/contact_kernel_x86_64_v4.cc PROPERTIES
  COMPILE_OPTIONS "${kernel_options};-march=x86-64-v4;-mprefer-vector-width=512")
unset(kernel_options)
