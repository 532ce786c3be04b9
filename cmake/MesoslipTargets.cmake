# mesoslip_warnings(<target>): warnings and optimization of our own code; call it after
# deal_ii_setup_target.
function(mesoslip_warnings target)
  target_compile_options(${target} PRIVATE
    $<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wpedantic;-Wshadow=local;-Wno-psabi>
    $<$<AND:$<BOOL:${MESOSLIP_WERROR}>,$<COMPILE_LANGUAGE:CXX>>:-Werror>)
  # After deal.II's own flags, which end in "-g -O2". No -ffast-math: NaN must stay visible.
  target_compile_options(${target} PRIVATE
    $<$<AND:$<CONFIG:Release>,$<COMPILE_LANGUAGE:CXX>>:-O3;-g0>)
  # Lambdas that capture what is in an unnamed namespace: wrong where files are compiled together.
  if(MESOSLIP_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
  endif()
  if(MESOSLIP_SANITIZE)
    mesoslip_sanitize(${target})
  endif()
endfunction()

# mesoslip_sanitize(<target>): AddressSanitizer and UndefinedBehaviorSanitizer, which end the program at the first
# finding, and the assertions of the standard library; clang also counts branches for the fuzzers. Little optimization, and checks
# by calls: GCC takes less time than at -O0 for the smaller code, and three times as long at -O1 with checks in place. Checks of every
# pointer double GCC's time for Eigen; most of what they find AddressSanitizer finds, too. GCC warns of more than in other
# builds, and wrongly, as of std::regex; theirs count. Boost asserts that archives are whole, ours have to be read in any case. Gmsh's library has templates
# of Eigen, too, of which a program keeps one: with sanitizers Eigen would allocate otherwise than that library frees.
function(mesoslip_sanitize target)
  set(sanitizers -fsanitize=address,undefined -fno-sanitize-recover=undefined)
  target_compile_options(${target} PRIVATE
    -g1 -fno-omit-frame-pointer -U_FORTIFY_SOURCE -D_GLIBCXX_ASSERTIONS -DBOOST_DISABLE_ASSERTS -DEIGEN_MALLOC_ALREADY_ALIGNED=1 -DXXH_NO_INLINE_HINTS=1 ${sanitizers}
    $<$<CXX_COMPILER_ID:GNU>:-Og;--param=asan-instrumentation-with-call-threshold=0;-fno-sanitize=null,alignment,object-size,vptr;-Wno-error>
    $<$<CXX_COMPILER_ID:Clang>:-O1;-fsanitize=fuzzer-no-link;-Wno-unknown-warning-option;-Wno-ignored-optimization-argument>)
  target_link_options(${target} PRIVATE ${sanitizers} LINKER:--export-dynamic-symbol=event_base_loop)
  target_sources(${target} PRIVATE
    $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:${PROJECT_SOURCE_DIR}/tests/lint/leaks_of_mpi.cc>)
endfunction()

# Options of the row kernels. Sanitizers make clang compile them for minutes; its builds are for the fuzzers of the readers.
# GCC optimizes them and checks only what they read and write in memory, by calls: inline checks take minutes, too.
set(mesoslip_kernel_options -fno-exceptions)
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  list(APPEND mesoslip_kernel_options -fno-sanitize=all)
elseif(MESOSLIP_SANITIZE)
  list(APPEND mesoslip_kernel_options
    -O1 -fno-sanitize=undefined -fno-sanitize-address-use-after-scope
    --param=asan-instrumentation-with-call-threshold=0 --param=asan-stack=0)
endif()

# mesoslip_precompile(<target> <kind> [<header>...]): headers that most sources read, precompiled; those of the first target of a kind serve all
# that have the same options. Not what few sources read: GCC takes as long for each source as the file is large (0.2 GB). Kernels have
# options of their own.
function(mesoslip_precompile target kind)
  get_property(owner GLOBAL PROPERTY mesoslip_precompiled_${kind})
  if(owner)
    target_precompile_headers(${target} REUSE_FROM ${owner})
    return()
  endif()
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <optional> <sstream> <string> <vector>
    <mpi.h> <Eigen/Core> <deal.II/base/point.h> ${ARGN})
  set_property(GLOBAL PROPERTY mesoslip_precompiled_${kind} ${target})
endfunction()

# mesoslip_sources(<variable> <target> <folder> <source>...): with MESOSLIP_UNITY sources that include the given ones, else the given ones.
# Groups of 20 take a third less of the processor than groups of 8, as deal.II's headers and templates are gone through once a group; they need
# up to 2 GB a compiler, 3 GB with sanitizers, and are too few for many cores. CMake's own unity sources name absolute paths, so that no compiler cache finds them again in another clone.
cmake_host_system_information(RESULT mesoslip_cores QUERY NUMBER_OF_LOGICAL_CORES)
cmake_host_system_information(RESULT mesoslip_memory QUERY TOTAL_PHYSICAL_MEMORY) # MiB
math(EXPR mesoslip_memory_of_job "${mesoslip_memory} / (${mesoslip_cores} + 2)") # as many jobs as ninja has
set(mesoslip_group 8)
if(mesoslip_cores LESS_EQUAL 4 AND mesoslip_memory_of_job GREATER 3000)
  set(mesoslip_group 20)
endif()
function(mesoslip_sources variable target folder)
  if(NOT MESOSLIP_UNITY)
    set(${variable} ${ARGN} PARENT_SCOPE)
    return()
  endif()
  set(result)
  set(rest ${ARGN})
  list(SORT rest)
  while(rest)
    list(LENGTH rest n)
    math(EXPR parts "(${n} + ${mesoslip_group} - 1) / ${mesoslip_group}")
    math(EXPR size "(${n} + ${parts} - 1) / ${parts}")
    list(LENGTH result number)
    set(content)
    foreach(source RANGE 1 ${size})
      list(POP_FRONT rest source)
      file(RELATIVE_PATH name ${folder} ${source})
      string(APPEND content "#include \"${name}\"\n")
    endforeach()
    set(unity ${CMAKE_CURRENT_BINARY_DIR}/Unity/${target}_${number}.cc)
    file(CONFIGURE OUTPUT ${unity} CONTENT "${content}" @ONLY)
    list(APPEND result ${unity})
  endwhile()
  set(${variable} ${result} PARENT_SCOPE)
endfunction()

# mesoslip_library(<topic> [DEALII] [DEPENDS <topic>... | <target>...])
# One static library for each folder of lib/, named mesoslip_<topic>, with its kernels, of which mesoslip_kernels() was called before.
# DEALII makes deal.II available to it; everything that depends on it must say DEALII, too.
function(mesoslip_library topic)
  cmake_parse_arguments(ARG "DEALII" "" "DEPENDS" ${ARGN})
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${topic}/*.cc)
  get_property(left_out GLOBAL PROPERTY mesoslip_left_out)
  list(REMOVE_ITEM files ${left_out})
  set(target mesoslip_${topic})
  set_property(GLOBAL APPEND PROPERTY mesoslip_topics ${topic})
  set_property(GLOBAL PROPERTY mesoslip_files_${topic} ${files})
  get_property(kernels GLOBAL PROPERTY mesoslip_kernels_${topic})
  if(kernels)
    list(REMOVE_ITEM files ${kernels})
  endif()
  mesoslip_sources(sources ${topic} ${CMAKE_CURRENT_SOURCE_DIR} ${files})
  list(APPEND sources ${kernels})
  add_library(${target} STATIC ${sources})
  add_library(mesoslip::${topic} ALIAS ${target})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/lib> $<INSTALL_INTERFACE:include/mesoslip>)
  if(ARG_DEALII)
    deal_ii_setup_target(${target})
  endif()
  mesoslip_warnings(${target})
  if(ARG_DEALII)
    mesoslip_precompile(${target} library)
  endif()
  # deal_ii_setup_target uses the keyword-less signature, so this must, too.
  target_link_libraries(${target} ${ARG_DEPENDS})
endfunction()

# mesoslip_program(<name> <topic>): applications/<name>/*.cc linked with lib/<topic>.
function(mesoslip_program name topic)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cc)
  add_executable(${name} ${sources})
  deal_ii_setup_target(${name})
  mesoslip_warnings(${name})
  target_link_libraries(${name} mesoslip_${topic})
endfunction()

# mesoslip_kernels(<topic> <source> <option>... [GNU <option>...]): compiles a source of the
# topic, which is the baseline of the processor family, alone and once more for each further instruction
# set (elasticity/kernel_variants.h); which one runs is decided at run time.
function(mesoslip_kernels topic source)
  cmake_parse_arguments(ARG "" "" "GNU" ${ARGN})
  set(options ${ARG_UNPARSED_ARGUMENTS} ${mesoslip_kernel_options})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND options ${ARG_GNU})
  endif()
  set(baseline ${CMAKE_CURRENT_SOURCE_DIR}/${source})
  set_source_files_properties(${baseline} PROPERTIES COMPILE_OPTIONS "${options}" SKIP_PRECOMPILE_HEADERS ON)
  set_property(GLOBAL APPEND PROPERTY mesoslip_kernels_${topic} ${baseline})
  if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    return()
  endif()
  get_filename_component(name ${source} NAME_WE)
  foreach(set x86_64_v3 x86_64_v4)
    set(variant ${CMAKE_CURRENT_BINARY_DIR}/${topic}_${name}_${set}.cc)
    file(CONFIGURE OUTPUT ${variant} CONTENT "#define MESOSLIP_VARIANT ${set}\n#include \"${source}\"\n")
    set_property(GLOBAL APPEND PROPERTY mesoslip_kernels_${topic} ${variant})
    string(REPLACE "_" "-" march ${set})
    set(wide ${options} -march=${march})
    if(set STREQUAL "x86_64_v4")
      list(APPEND wide -mprefer-vector-width=512)
    endif()
    set_source_files_properties(${variant} PROPERTIES COMPILE_OPTIONS "${wide}" SKIP_PRECOMPILE_HEADERS ON)
  endforeach()
endfunction()
