#ifndef steel_block_h
#define steel_block_h

#include <elasticity/uniform_material.h>
#include <material/stiffness.h>

/** 1 x 0.5 mm of steel in 10 x 5 cells. */
inline mesoslip::UniformMaterial block()
{
  using namespace mesoslip;
  UniformGrid<2> grid;
  grid.cells                  = {{10, 5}};
  grid.spacing                = {{1e-4, 1e-4}};
  const ElasticPhase<2> steel = {isotropic_stiffness<2>(210e9, 0.3), 7800.};
  return UniformMaterial(grid, {steel}, std::vector<std::uint8_t>(grid.n_cells(), 0));
}

#endif
