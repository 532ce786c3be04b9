// The effective stiffness of a microstructure of our own.
#include "checkerboard.h"

#include <deal.II/base/mpi.h>

#include <body/grid_body.h>
#include <homogenization/volumes/grid_volume.h>
#include <material/stiffness.h>

#include <cstdio>

using namespace mesoslip;

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  UniformGrid<2> grid;
  grid.cells            = {{64, 64}};
  grid.spacing          = {{1e-5, 1e-5}};
  const PhaseMap<2> map = checkerboard(grid, 16);

  // Both phases have the shear modulus G, so the answer is known (Hill 1964).
  const double G = 10e9, lambda[2] = {5e9, 80e9};
  std::vector<ElasticPhase<2>> phases;
  for (const double l : lambda)
    phases.push_back(
      {isotropic_stiffness<2>(G * (3. * l + 2. * G) / (l + G), l / (2. * (l + G))), 1.});

  const UniformMaterial material(grid, phases, map.id);
  const GridBody<2> body(material);
  for (const LoadCaseSolutions &solutions :
       solve_load_cases(body, {BoundaryCondition::PBC}, 1e-10, MPI_COMM_SELF))
    {
      const VoigtMatrix<2> D = homogenize<2>(sum_up(body, solutions), phases).stiffness;
      // In the plane k = lambda + G and 1/(k + G) averages.
      const double exact = 2. / (1. / (lambda[0] + 2. * G) + 1. / (lambda[1] + 2. * G));
      std::printf("D11 = %.6f GPa, exact %.6f; D33 = %.6f GPa, exact %.6f\n",
                  1e-9 * D(0, 0), 1e-9 * exact, 1e-9 * D(2, 2), 1e-9 * G);
    }
}
