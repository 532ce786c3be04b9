#include "dynamics/deformation.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
double rounding_of_strain(const UniformGrid<2> &grid,
                          const NodeRows &rows,
                          const NodalField<double> &u,
                          const MPI_Comm communicator)
{
  double largest = 0.;
  for (unsigned int j = rows.begin; j < rows.end; ++j)
    for (unsigned int c = 0; c < 2; ++c)
      {
        const double *row = u.row(c, rows.local(j));
        double farthest   = 0.;
        for (unsigned int i = 0; i < u.n_columns(); ++i)
          farthest = std::max(farthest, std::fabs(row[i]));
        largest = std::max(largest, farthest / grid.spacing[c]);
      }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, communicator);
  return 0x1p-24 * largest;
}
} // namespace mesoslip
