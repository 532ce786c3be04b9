// Quadrilaterals: the sum over the four Gauss points in closed form. Included by the
// kernels of general cells only, inside their namespace, after element_modes.h.
//
// For u = u_1 xi + u_2 eta + u_3 xi eta, and x and y likewise, det(J) du/dx is [u, y] and
// det(J) du/dy is [x, u], where
//
// [a, b] = (a_1 b_2 - a_2 b_1) + (a_1 b_3 - a_3 b_1) xi + (a_3 b_2 - a_2 b_3) eta
//
// has no term in xi eta, and det(J) = [x, y]. Stress and strain are divided by det(J) at
// the Gauss points; only the sums over the Gauss points of 1, xi, eta and xi eta over
// det(J) are needed.

/** Modes of a component or coordinate, with gauss_scale, for each cell of the batch. */
struct QuadrilateralModes
{
  vdouble a1; ///< four times the coefficient of xi
  vdouble a2; ///< four times the coefficient of eta
  vdouble a3; ///< four times the coefficient of xi eta
};

/**
 * Coefficients of 1, xi and eta; the coefficients of xi and eta are divided by sqrt(3).
 */
struct LinearFunction
{
  vdouble of[3]; ///< coefficients of 1, xi and eta
};

/** [a, b] + sum */
MESOSLIP_INLINE LinearFunction bracket(const QuadrilateralModes &a,
                                       const QuadrilateralModes &b,
                                       const LinearFunction &sum = {})
{
  return {{fnma(a.a2, b.a1, fma(a.a1, b.a2, sum.of[0])),
           fnma(a.a3, b.a1, fma(a.a1, b.a3, sum.of[1])),
           fnma(a.a2, b.a3, fma(a.a3, b.a2, sum.of[2]))}};
}

/**
 * Sums over the Gauss points of 1, sign(xi), sign(eta) and sign(xi eta), each over 16
 * det(J), because modes are four times coefficients.
 */
struct GaussSums
{
  vdouble one;  ///< sum of 1
  vdouble xi;   ///< sum of sign(xi)
  vdouble eta;  ///< sum of sign(eta)
  vdouble both; ///< sum of sign(xi eta)
};

MESOSLIP_INLINE GaussSums gauss_sums(const LinearFunction &det)
{
  // 1 / (a + b) +- 1 / (a - b) = 2 (a or b) / ((a + b) (a - b)) for opposite points
  const vdouble a = det.of[0], s = det.of[1] + det.of[2], d = det.of[1] - det.of[2];
  const vdouble even = splat(0.125) / ((a + s) * (a - s));
  const vdouble odd  = splat(0.125) / ((a + d) * (a - d));
  return {a * (even + odd), -fma(s, even, d * odd), fnma(s, even, d * odd),
          a * (even - odd)};
}

/** Sums over the Gauss points of @p f times 1, sign(xi) and sign(eta). */
MESOSLIP_INLINE LinearFunction sum_up(const GaussSums &sums, const LinearFunction &f)
{
  const auto sum = [&](const vdouble a, const vdouble b, const vdouble c) {
    return fma(c, f.of[2], fma(b, f.of[1], a * f.of[0]));
  };
  return {{sum(sums.one, sums.xi, sums.eta), sum(sums.xi, sums.one, sums.both),
           sum(sums.eta, sums.both, sums.one)}};
}

/** @p apart: cells have excess. A run-time check for null would cost registers. */
template <bool anisotropic, bool apart>
static void multiply_quadrilaterals(const CellBatches &cells, const double *u, double *f)
{
  CellStream<2, 4> stream(cells, u, f);
  for (std::size_t k = 0; k < cells.n; ++k)
    {
      vdouble value[4][2];
      stream.start(k, value);
      const auto shape = [&](const int c) {
        return QuadrilateralModes{stream.shape(1, c), stream.shape(2, c),
                                  stream.shape(3, c)};
      };
      const QuadrilateralModes x = shape(0), y = shape(1);
      to_modes<2>(value);
      scale_modes<2>(value);
      const QuadrilateralModes ux = {value[1][0], value[2][0], value[3][0]},
                               uy = {value[1][1], value[2][1], value[3][1]};
      const LinearFunction det    = bracket(x, y);
      const GaussSums sums        = gauss_sums(det);
      stream.move(0);

      const LinearFunction strain[] = {sum_up(sums, bracket(ux, y)),
                                       sum_up(sums, bracket(x, uy)),
                                       sum_up(sums, bracket(x, ux, bracket(uy, y)))};
      stream.move(1);

      LinearFunction stress[3];
      for (int m = 0; m < 3; ++m)
        {
          vdouble e[3], s[3];
          for (int i = 0; i < 3; ++i)
            e[i] = strain[i].of[m];
          multiply_stiffness<2, anisotropic>(
            cells.stiffness + std::size_t{9} * cells.material[k], e, s);
          for (int i = 0; i < 3; ++i)
            stress[i].of[m] = s[i];
        }
      if constexpr (apart)
        {
          // The mean strain is used four times, hence the factor 1/4: see sum_up().
          const vdouble inverse_area = splat(0.25) / det.of[0];
          const vdouble e[]          = {inverse_area * bracket(ux, y).of[0],
                                        inverse_area * bracket(x, uy).of[0],
                                        inverse_area * bracket(x, ux, bracket(uy, y)).of[0]};
          vdouble s[3];
          multiply_stiffness<2, anisotropic>(
            cells.excess + std::size_t{9} * cells.material[k], e, s);
          for (int i = 0; i < 3; ++i)
            stress[i].of[0] += s[i];
        }
      stream.move(2);

      // The transpose of the brackets.
      for (int c = 0; c < 2; ++c)
        {
          const auto &X = stress[c == 0 ? 0 : 2].of, &Y = stress[c == 0 ? 2 : 1].of;
          value[1][c] = fnma(Y[1], x.a3, fnma(Y[0], x.a2, fma(X[1], y.a3, X[0] * y.a2)));
          value[2][c] = fnma(X[2], y.a3, fnma(X[0], y.a1, fma(Y[2], x.a3, Y[0] * x.a1)));
          value[3][c] = fnma(X[1], y.a1, fnma(Y[2], x.a2, fma(X[2], y.a2, Y[1] * x.a1)));
        }
      scale_modes<2>(value);
      from_modes<2>(value);
      stream.move(3);
      stream.finish(value);
    }
  stream.end();
}
