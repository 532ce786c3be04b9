#ifndef mesoslip_statics_grid_preconditioners_h
#define mesoslip_statics_grid_preconditioners_h

#include "statics/multigrid/multigrid.h"

namespace mesoslip
{
/** A cycle in one precision, with the fields that it takes and gives. */
template <typename N>
struct MultigridCycle
{
  using Number = N; ///< of the cycle

  /** Sets the cycle up for what @p held constrains. */
  MultigridCycle(const UniformMaterial &material,
                 const UniformGridOperator &stiffness,
                 const DofMask &held)
    : cycle(material, stiffness)
    , b(material.n_columns(), material.n_rows())
    , z(b)
  {
    cycle.set_held(held);
  }

  /** z = M^-1 b */
  void apply()
  {
    cycle.vmult(z, b);
  }

  multigrid::Multigrid<Number> cycle; ///< M^-1
  NodalField<Number> b;               ///< residual
  NodalField<Number> z;               ///< what apply() makes of it
};

/** The diagonal of K, zero where entries are held. */
struct Diagonal
{
  using Number = double; ///< of the diagonal

  /** Computes it. */
  Diagonal(const UniformGridOperator &stiffness, const DofMask &held)
    : inverse(held.n_columns(), held.n_rows())
    , b(inverse)
    , z(inverse)
  {
    stiffness.diagonal(inverse);
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int j = 0; j < held.n_rows(); ++j)
        for (unsigned int i = 0; i < held.n_columns(); ++i)
          {
            double &d = inverse.row(c, j)[i];
            d         = held.is_held(c, i, j) ? 0. : 1. / d;
          }
  }

  /** z = D^-1 b */
  void apply()
  {
    for (std::size_t k = 0; k < z.size(); ++k)
      z.begin()[k] = inverse.begin()[k] * b.begin()[k];
  }

  NodalField<double> inverse; ///< 1/D
  NodalField<double> b;       ///< residual
  NodalField<double> z;       ///< what apply() makes of it
};
} // namespace mesoslip

#endif
