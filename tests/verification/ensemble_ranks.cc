// What the ranks of an ensemble exchange.
#include "base/exchange.h"
#include "homogenization/ensemble.h"

#include <gtest/gtest.h>

using namespace mesoslip;

namespace
{
/** All entries apart from those of any other @p number and place. */
VoigtMatrix<2> matrix_of(const double number)
{
  VoigtMatrix<2> matrix;
  for (unsigned int e = 0; e < 9; ++e)
    matrix(e / 3, e % 3) = number + 1e-3 * e;
  return matrix;
}

HomogenizedResponse response_of(const double number)
{
  // Does not compile when a member is left out.
  return {BoundaryCondition::PBC,
          matrix_of(number),
          matrix_of(number + 1.),
          number + 2.,
          number + 3.,
          number + 4.,
          number + 5.,
          {number + 6., number + 7.},
          {matrix_of(number + 8.), matrix_of(number + 9.)},
          {{{1, number + 10., 4}, {2, number + 11., 5}, {3, number + 12., {}}}}};
}

EnsembleMember member_of(const unsigned int number)
{
  HomogenizedResponse without = response_of(100. * number);
  without.condition           = BoundaryCondition::SUBC;
  without.two_phase_residual.reset();
  return {number,
          {"a", "warning " + std::to_string(number)},
          {0.1 * number, 0.2},
          {response_of(10. * number), without}};
}

void expect_equal(const HomogenizedResponse &one, const HomogenizedResponse &two)
{
  // Names all members, so that one that is added has to be compared as well.
  const auto &[condition, stiffness, from_mean, hill_mandel, symmetry, mean, two_phase,
               concentration, phase_means, reports] = one;
  EXPECT_EQ(condition, two.condition);
  EXPECT_EQ(stiffness, two.stiffness);
  EXPECT_EQ(from_mean, two.stiffness_from_mean);
  EXPECT_EQ(hill_mandel, two.hill_mandel_residual);
  EXPECT_EQ(symmetry, two.symmetry_residual);
  EXPECT_EQ(mean, two.mean_residual);
  EXPECT_EQ(two_phase, two.two_phase_residual);
  EXPECT_EQ(concentration, two.concentration);
  EXPECT_EQ(phase_means, two.phase_means);
  for (unsigned int k = 0; k < 3; ++k)
    {
      const auto &[iterations, residual, single] = reports[k];
      EXPECT_EQ(iterations, two.reports[k].iterations);
      EXPECT_EQ(residual, two.reports[k].residual);
      EXPECT_EQ(single, two.reports[k].single_iterations);
    }
}

void expect_equal(const EnsembleMember &one, const EnsembleMember &two)
{
  const auto &[seed, warnings, fractions, responses] = one;
  EXPECT_EQ(seed, two.seed);
  EXPECT_EQ(warnings, two.warnings);
  EXPECT_EQ(fractions, two.fractions);
  ASSERT_EQ(responses.size(), two.responses.size());
  for (std::size_t k = 0; k < responses.size(); ++k)
    expect_equal(responses[k], two.responses[k]);
}

EnsembleMember member_with(const std::uint64_t seed,
                           const std::vector<std::string> &warnings)
{
  EnsembleMember member;
  member.seed     = seed;
  member.warnings = warnings;
  return member;
}
} // namespace

// Saved and restored, and from the last rank to the first and to all.
TEST(EnsembleRanks, MembersTravelWhole)
{
  EnsembleMember restored;
  load_state(save_state(member_of(7)), restored, "a test");
  expect_equal(member_of(7), restored);

  int rank = 0, n_ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  const unsigned int last = static_cast<unsigned int>(n_ranks) - 1;
  EnsembleMember member   = member_of(static_cast<unsigned int>(rank));
  bring_object_to_root(MPI_COMM_WORLD, member, static_cast<int>(last));
  expect_equal(member_of(rank == 0 ? last : static_cast<unsigned int>(rank)), member);
  member = member_of(static_cast<unsigned int>(rank));
  broadcast_object(MPI_COMM_WORLD, member, static_cast<int>(last));
  expect_equal(member_of(last), member);
}

// One that holds for all morphologies is said once, others with the seeds they are about.
TEST(EnsembleRanks, WarningsNameTheirMorphologies)
{
  const std::vector<EnsembleMember> members = {member_with(3, {"all", "one"}),
                                               member_with(4, {"all", "two"}),
                                               member_with(5, {"all", "two"})};
  EXPECT_EQ(morphology_warnings(members),
            (std::vector<std::string>{"all", "one (seed 3)", "two (seeds 4, 5)"}));
}
