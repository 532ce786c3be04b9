// Modes of square prisms, many of which have a twin of the same frequency, against those of the
// dense matrices. Runs on any number of ranks.

#include "body/brick_body.h"
#include "divided_body.h"
#include "eigenvalues/vibration_modes.h"
#include "material/stiffness.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

using namespace mesoslip;

namespace
{
CellReader one_phase()
{
  return
    [](const CellBlock<3> &block) { return std::vector<std::uint16_t>(block.n_cells()); };
}

/** Frequencies (Hz) of the whole body, ascending. */
std::vector<double> all_frequencies(const ElasticBody<3> &body)
{
  const DofMask held               = verification::held_at_top(body);
  const std::vector<double> masses = body.lumped_mass();
  std::vector<Eigen::Index> number(3 * masses.size(), -1);
  Eigen::Index n = 0;
  for (std::size_t k = 0; k < number.size(); ++k)
    if (!held.is_constrained(k % 3, {static_cast<unsigned int>(k / 3), 0}))
      number[k] = n++;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (const MatrixEntry &entry : body.stiffness_entries())
    if (number[entry.row] >= 0 && number[entry.column] >= 0)
      K(number[entry.row], number[entry.column]) +=
        entry.value / std::sqrt(masses[entry.row / 3] * masses[entry.column / 3]);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K, Eigen::EigenvaluesOnly);
  std::vector<double> frequencies;
  for (const double x : eigen.eigenvalues())
    frequencies.push_back(std::sqrt(x) / (2. * M_PI));
  return frequencies;
}

/** The lowest modes of a box of such cubes against those of the dense matrix. */
void check_modes(const std::array<unsigned int, 3> &cells,
                 const double edge,
                 const ElasticPhase<3> &phase)
{
  const BrickBox box{{cells, {{edge, edge, edge}}, {}}, {}};
  const std::vector<ElasticPhase<3>> phases = {phase};
  const GridBody<3> whole(box, one_phase(), phases, MPI_COMM_SELF, true);
  const std::vector<double> expected = all_frequencies(whole);
  const GridBody<3> body(box, one_phase(), phases, MPI_COMM_WORLD);
  for (const unsigned int n : {1, 2, 7, 12})
    {
      VibrationModesOptions options;
      options.n_modes = n;
      const auto found =
        vibration_modes<3>(body, verification::held_at_top(body), options);
      ASSERT_EQ(found.modes.size(), n);
      for (unsigned int k = 0; k < n; ++k)
        EXPECT_NEAR(found.modes[k].frequency, expected[k], 1e-8 * expected[k])
          << "mode " << k << " of " << n << ", cells of " << edge << " m";
    }
}
} // namespace

// The iteration for the modes alone leaves out the twin of mode 1 and of mode 6 of the second box.
TEST(BrickModes, OfASquarePrismHaveTheirTwins)
{
  for (const auto &cells : {std::array<unsigned int, 3>{{6, 6, 6}}, {{3, 3, 2}}})
    check_modes(cells, 0.1, {isotropic_stiffness<3>(2., 0.3), 1.5});
}

// ARPACK has a tolerance in units of its own.
TEST(BrickModes, OfSmallBodiesAreAsAccurate)
{
  for (const double edge : {4e-5, 1e-9})
    check_modes({{5, 5, 5}}, edge, {isotropic_stiffness<3>(2e11, 0.3), 7800.});
}
