// Compiled for x86-64, see multigrid.cmake. Keep the standard library out.
#include "elasticity/multigrid/kernels.h"

namespace mesoslip
{
namespace multigrid
{
namespace x86_64
{
#include "elasticity/multigrid/kernels_impl.h"
//
#include "elasticity/multigrid/line_kernels_impl.h"
//
#include "elasticity/multigrid/galerkin_impl.h"
//
#include "elasticity/multigrid/vector_kernels_impl.h"
//
#include "elasticity/multigrid/kernels_table.h"
} // namespace x86_64
} // namespace multigrid
} // namespace mesoslip
