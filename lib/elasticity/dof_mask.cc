#include "elasticity/dof_mask.h"

namespace mesoslip
{
DofMask DofMask::boundary(const unsigned int n_columns, const unsigned int n_rows)
{
  DofMask mask(n_columns, n_rows);
  for (unsigned int c = 0; c < 2; ++c)
    {
      mask.hold_row(c, 0);
      mask.hold_row(c, n_rows - 1);
      mask.hold_column(c, 0);
      mask.hold_column(c, n_columns - 1);
    }
  return mask;
}

void DofMask::hold_row(const unsigned int c, const unsigned int j)
{
  for (unsigned int i = 0; i < columns; ++i)
    hold(c, i, j);
}

void DofMask::hold_column(const unsigned int c, const unsigned int i)
{
  for (unsigned int j = 0; j < rows; ++j)
    hold(c, i, j);
}
} // namespace mesoslip
