#include "../../unit/elasticity/elasticity_testing.h"
#include "homogenization_testing.h"
#include "material/bounds.h"
#include "material/stiffness.h"
#include "morphology/random_fibres.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace homogenization_testing;
using elasticity_testing::Random;

namespace
{
constexpr unsigned int n_members = 25;

struct Morphology
{
  UniformGrid<2> grid;
  FibrePlacement rules;
  FibreMorphology fibres;
};

/** Random grid, fibres and rules. */
Morphology random_morphology(Random &draw)
{
  const auto coin = [&]() { return draw.integer(0, 1) == 1; };
  Morphology m;
  m.grid          = {{{draw.integer(30, 60), draw.integer(20, 40)}},
                     {{draw(0.5e-4, 2e-4), draw(0.5e-4, 2e-4)}}};
  const double hx = m.grid.spacing[0], hy = m.grid.spacing[1];
  m.rules.seed          = draw.integer(1, 1000000);
  m.rules.width         = draw.integer(1, 3) * hx;
  m.rules.min_height    = draw.integer(2, 5) * hy;
  m.rules.max_height    = m.rules.min_height + draw.integer(0, 8) * hy;
  m.rules.area_fraction = draw(0.05, 0.25);
  m.rules.fraction_rule = coin() ? FractionRule::actual : FractionRule::nominal;
  m.rules.allow_overlap = coin();
  m.rules.cut_by_border = coin();
  m.rules.align_to_grid = coin();
  m.fibres              = place_random_fibres(m.grid, m.rules);
  return m;
}

/** Cells that belong to more than one fibre. */
unsigned int shared_cells(const Morphology &m)
{
  std::vector<unsigned int> owners(m.grid.n_cells(), 0);
  for (const Rectangle &fibre : m.fibres.fibres)
    {
      const CellBox box = covered_cells(m.grid, fibre);
      for (unsigned int j = box.y_begin; j < box.y_end; ++j)
        for (unsigned int i = box.x_begin; i < box.x_end; ++i)
          ++owners[j * m.grid.cells[0] + i];
    }
  return std::count_if(owners.begin(), owners.end(), [](auto n) { return n > 1; });
}
} // namespace

TEST(RandomMicrostructures, KeepTheirRules)
{
  unsigned int n_shared = 0;
  for (unsigned int member = 1; member <= 8 * n_members; ++member)
    {
      SCOPED_TRACE("seed " + std::to_string(member));
      Random draw(member);
      const Morphology m = random_morphology(draw);
      ASSERT_TRUE(m.fibres.target_reached);
      // A fibre more or less, or with the last one trimmed, a row of cells of one.
      const double box   = m.grid.extent(0) * m.grid.extent(1);
      const double fibre = m.rules.width * m.rules.max_height / box;
      EXPECT_NEAR(m.fibres.reached_fraction(m.rules.fraction_rule), m.rules.area_fraction,
                  fibre);
      const auto fractions = area_fractions(m.fibres.map, 2);
      EXPECT_NEAR(fractions[1], m.fibres.actual_fraction, 1e-14);
      EXPECT_NEAR(fractions[0] + fractions[1], 1., 1e-14);
      if (m.rules.allow_overlap)
        n_shared += shared_cells(m);
      else
        EXPECT_EQ(shared_cells(m), 0u);
    }
  EXPECT_GT(n_shared, 1000u); // where it is allowed
}

TEST(RandomMicrostructures, KeepOrderAndIdentities)
{
  for (unsigned int member = 1; member <= n_members; ++member)
    {
      SCOPED_TRACE("seed " + std::to_string(member));
      Random draw(member);
      const Morphology m = random_morphology(draw);
      Volume volume;
      volume.grid      = m.grid;
      volume.id        = m.fibres.map.id;
      volume.stiffness = {
        isotropic_stiffness<2>(30e9, draw(0., 0.45)),
        isotropic_stiffness<2>(30e9 * std::pow(10., draw(-2., 2.)), draw(0., 0.45))};
      std::vector<Phase<2>> phases(2);
      for (unsigned int p = 0; p < 2; ++p)
        phases[p].stiffness = volume.stiffness[p];
      const std::vector<double> fractions = {volume.fraction(0), volume.fraction(1)};
      const auto r                        = respond(volume);
      const std::vector<VoigtMatrix<2>> ascending = {
        reuss_bound(phases, fractions), r[1].stiffness, r[2].stiffness, r[0].stiffness,
        voigt_bound(phases, fractions)};
      for (unsigned int k = 0; k < 4; ++k)
        EXPECT_GT(stiffness_eigenvalues<2>(ascending[k + 1] - ascending[k])(0), 0.) << k;
      for (const HomogenizedResponse<2> &response : r)
        {
          EXPECT_LT(response.hill_mandel_residual, 1e-8);
          EXPECT_LT(response.symmetry_residual, 1e-8);
          EXPECT_LT(response.mean_residual, 1e-8);
          ASSERT_TRUE(response.two_phase_residual.has_value());
          EXPECT_LT(*response.two_phase_residual, 1e-7);
        }
    }
}
