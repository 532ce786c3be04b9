# The libraries that mesoslip needs beside deal.II. Whatever is missing is told at once, with what helps.

set(missing)
# mesoslip_need(<condition> <name> <Debian package>)
macro(mesoslip_need condition name package)
  if(NOT ${condition})
    string(APPEND missing "\n  ${name}: the package ${package} of Debian and Ubuntu, or -DCMAKE_PREFIX_PATH=<its prefix>")
  endif()
endmacro()

# What deal.II itself was configured with; the option is one of its own. HDF5 is that of deal.II, as two in one program do not go together.
foreach(feature MPI TRILINOS HDF5 ARPACK METIS MUPARSER UMFPACK)
  if(NOT DEAL_II_WITH_${feature})
    string(APPEND missing "\n  deal.II in ${DEAL_II_PATH} was built without ${feature}: build it with -DDEAL_II_WITH_${feature}=ON")
  endif()
endforeach()

find_package(MPI QUIET COMPONENTS C CXX)
mesoslip_need(MPI_FOUND "MPI" libopenmpi-dev)
# Without a version, as 5.0 declares itself incompatible with 3.4, which it is not here.
find_package(Eigen3 QUIET NO_MODULE)
if(Eigen3_FOUND AND Eigen3_VERSION VERSION_LESS 3.4)
  set(Eigen3_FOUND FALSE)
endif()
mesoslip_need(Eigen3_FOUND "Eigen 3.4 or newer" libeigen3-dev)
find_package(nlohmann_json QUIET)
mesoslip_need(nlohmann_json_FOUND "JSON for Modern C++" nlohmann-json3-dev)
find_package(PNG QUIET)
mesoslip_need(PNG_FOUND "libpng" libpng-dev)
find_package(TIFF QUIET)
mesoslip_need(TIFF_FOUND "libtiff" libtiff-dev)
find_package(Boost 1.74 QUIET CONFIG COMPONENTS program_options serialization)
mesoslip_need(Boost_FOUND "Boost 1.74 or newer with program_options and serialization" "libboost-program-options-dev libboost-serialization-dev")

# Libraries without files for CMake: <NAME>_INCLUDE_DIR and <NAME>_LIBRARY. Gmsh reads its meshes, muParser the expressions of .prm files, UMFPACK
# factorizes complex matrices and CHOLMOD symmetric ones; the functions of xxHash are inlined where they are used, so that nothing is linked.
foreach(library "GMSH;gmsh.h;gmsh;Gmsh with its library;libgmsh-dev" "MUPARSER;muParser.h;muparser;muParser with its headers;libmuparser-dev"
                "UMFPACK;umfpack.h;umfpack;UMFPACK with its headers;libsuitesparse-dev"
                "CHOLMOD;cholmod.h;cholmod;CHOLMOD with its headers;libsuitesparse-dev" "XXHASH;xxhash.h;;xxHash;libxxhash-dev")
  list(GET library 0 name)
  list(GET library 1 header)
  list(GET library 2 file)
  find_path(${name}_INCLUDE_DIR ${header} PATH_SUFFIXES suitesparse)
  set(found ${name}_INCLUDE_DIR)
  if(file)
    find_library(${name}_LIBRARY ${file})
    if(NOT ${name}_LIBRARY)
      set(found ${name}_LIBRARY)
    endif()
  endif()
  list(GET library 3 words)
  list(GET library 4 package)
  mesoslip_need(${found} "${words}" ${package})
endforeach()

# Algebraic multigrid for meshes: ML, which deal.II's Trilinos had until Trilinos 17, or GAMG of the PETSc that deal.II was built with.
find_path(ML_INCLUDE_DIR ml_MultiLevelPreconditioner.h PATH_SUFFIXES trilinos HINTS ${DEAL_II_INCLUDE_DIRS})
set(multigrids ml gamg)
if(NOT ML_INCLUDE_DIR)
  list(REMOVE_ITEM multigrids ml)
endif()
list(GET multigrids 0 multigrid)
set(MESOSLIP_MULTIGRID ${multigrid} CACHE STRING "ml (Trilinos) or gamg (PETSc)")
if(NOT MESOSLIP_MULTIGRID IN_LIST multigrids)
  string(APPEND missing "\n  MESOSLIP_MULTIGRID is ${MESOSLIP_MULTIGRID}: set one of those that are there, ${multigrids}")
elseif(MESOSLIP_MULTIGRID STREQUAL "gamg" AND NOT DEAL_II_WITH_PETSC)
  string(APPEND missing "\n  deal.II in ${DEAL_II_PATH} was built without PETSC, of which GAMG is: build it with -DDEAL_II_WITH_PETSC=ON")
endif()
set(other_multigrid_ml gamg)
set(other_multigrid_gamg ml)
set_property(GLOBAL PROPERTY mesoslip_left_out
             ${CMAKE_SOURCE_DIR}/lib/body/mesh/algebra_${other_multigrid_${MESOSLIP_MULTIGRID}}.cc)

if(missing)
  message(FATAL_ERROR "mesoslip needs what was not found:${missing}")
endif()
