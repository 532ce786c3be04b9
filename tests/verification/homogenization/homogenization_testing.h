#ifndef mesoslip_tests_verification_homogenization_testing_h
#define mesoslip_tests_verification_homogenization_testing_h

#include "body/grid_body.h"
#include "homogenization/ensemble.h"
#include "homogenization/volumes/grid_volume.h"
#include "material/stiffness.h"

#include <cstdlib>
#include <mpi.h>

#include <random>
#include <string>
#include <vector>

/** Small volumes and what is known about them. */
namespace homogenization_testing
{
using namespace mesoslip;

constexpr unsigned int seed = 20081;

/** Volumes of the random study; the environment may ask for another number. */
inline const unsigned int n_random_cases =
  std::getenv("MESOSLIP_RANDOM_CASES") ? std::stoul(std::getenv("MESOSLIP_RANDOM_CASES"))
                                       : 100;

inline const std::vector<BoundaryCondition> all_conditions = {
  BoundaryCondition::KUBC, BoundaryCondition::SUBC, BoundaryCondition::PBC};

/** Table 1 of the paper. */
inline std::vector<VoigtMatrix<2>> matrix_and_fibre()
{
  return {isotropic_stiffness<2>(30e9, 0.2), isotropic_stiffness<2>(240e9, 0.2)};
}

struct Volume
{
  UniformGrid<2> grid;
  std::vector<std::uint8_t> id;
  std::vector<VoigtMatrix<2>> stiffness;

  UniformMaterial material() const
  {
    std::vector<ElasticPhase<2>> classes;
    for (const VoigtMatrix<2> &C : stiffness)
      classes.push_back({C, 1.});
    return UniformMaterial(grid, classes, id);
  }

  double fraction(const unsigned int phase) const
  {
    double n = 0.;
    for (const std::uint8_t p : id)
      n += p == phase;
    return n / id.size();
  }
};

inline Volume make_volume(const unsigned int nx,
                          const unsigned int ny,
                          const std::vector<VoigtMatrix<2>> &stiffness,
                          const double hx = 1e-4,
                          const double hy = 1e-4)
{
  Volume volume;
  volume.grid = {{{nx, ny}}, {{hx, hy}}};
  volume.id.assign(static_cast<std::size_t>(nx) * ny, 0);
  volume.stiffness = stiffness;
  return volume;
}

/** Every cell by itself. */
inline void make_random(Volume &volume)
{
  std::mt19937_64 random(seed);
  for (std::uint8_t &phase : volume.id)
    phase = static_cast<std::uint8_t>(random() % volume.stiffness.size());
}

/** The response that @p solutions on @p body sum up to. */
inline HomogenizedResponse<2> respond(const ElasticBody<2> &body,
                                      const LoadCaseSolutions &solutions)
{
  return homogenize<2>(sum_up(body, solutions), body.phases());
}

/** Responses of all three conditions. */
inline std::vector<HomogenizedResponse<2>>
respond(const Volume &volume,
        const double tolerance        = 1e-10,
        const StaticSolverKind solver = StaticSolverKind::multigrid,
        const MPI_Comm communicator   = MPI_COMM_SELF)
{
  const UniformMaterial material = volume.material();
  std::vector<HomogenizedResponse<2>> responses;
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  const auto body = make_body(material, solver, communicator);
  for (const LoadCaseSolutions &solutions :
       solve_load_cases(*body, all_conditions, tolerance, communicator))
    if (rank == 0 || body->is_distributed())
      responses.push_back(respond(*body, solutions));
  return responses;
}

inline double distance(const VoigtMatrix<2> &a, const VoigtMatrix<2> &b)
{
  return (a - b).norm() / b.norm();
}
} // namespace homogenization_testing

#endif
