// Strains from derivatives along reference axes, and forces from stresses. Included by
// the kernels of general cells only, inside their namespace, after simd.h.

template <int dim>
constexpr int n_components = dim *(dim + 1) / 2;

/** Voigt index of component (i, j). */
template <int dim>
constexpr int voigt_index(const int i, const int j)
{
  return i == j ? i : dim == 2 ? 2 : 6 - i - j;
}

/**
 * Computes A = adj(J) with adj(J) J = det(J), and returns det(J); J[c][d] = dx_c / dxi_d.
 */
MESOSLIP_INLINE vdouble adjugate(const vdouble (&J)[2][2], vdouble (&A)[2][2])
{
  A[0][0] = J[1][1];
  A[0][1] = -J[0][1];
  A[1][0] = -J[1][0];
  A[1][1] = J[0][0];
  return fnma(J[0][1], J[1][0], J[0][0] * J[1][1]);
}

MESOSLIP_INLINE vdouble adjugate(const vdouble (&J)[3][3], vdouble (&A)[3][3])
{
  for (int d = 0; d < 3; ++d)
    for (int c = 0; c < 3; ++c)
      {
        const int c1 = (c + 1) % 3, c2 = (c + 2) % 3, d1 = (d + 1) % 3, d2 = (d + 2) % 3;
        A[d][c] = fnma(J[c1][d2], J[c2][d1], J[c1][d1] * J[c2][d2]);
      }
  return fma(J[0][2], A[2][0], fma(J[0][1], A[1][0], J[0][0] * A[0][0]));
}

/** a(0) b(0) + a(1) b(1) + ..., with functions @p a and @p b of the index. */
template <int n, typename A, typename B>
MESOSLIP_INLINE vdouble sum_of_products(const A &a, const B &b)
{
  vdouble sum = a(0) * b(0);
  for (int i = 1; i < n; ++i)
    sum = fma(a(i), b(i), sum);
  return sum;
}

/**
 * Voigt strain from the gradients g [axis][component] in the directions of the rows of
 * @p A.
 */
template <int dim>
MESOSLIP_INLINE void strain_from_gradients(const vdouble (&g)[dim][dim],
                                           const vdouble (&A)[dim][dim],
                                           vdouble (&strain)[n_components<dim>])
{
  vdouble du[dim][dim];
  for (int c = 0; c < dim; ++c)
    for (int j = 0; j < dim; ++j)
      du[c][j] = sum_of_products<dim>([&](const int d) { return g[d][c]; },
                                      [&](const int d) { return A[d][j]; });
  for (int i = 0; i < dim; ++i)
    {
      strain[i] = du[i][i];
      for (int j = i + 1; j < dim; ++j)
        strain[voigt_index<dim>(i, j)] = du[i][j] + du[j][i];
    }
}

/** Forces [axis][component]: the transpose of strain_from_gradients(). */
template <int dim>
MESOSLIP_INLINE void forces_from_stress(const vdouble (&stress)[n_components<dim>],
                                        const vdouble (&A)[dim][dim],
                                        vdouble (&force)[dim][dim])
{
  for (int c = 0; c < dim; ++c)
    for (int d = 0; d < dim; ++d)
      force[d][c] =
        sum_of_products<dim>([&](const int j) { return stress[voigt_index<dim>(c, j)]; },
                             [&](const int j) { return A[d][j]; });
}

template <int dim, bool anisotropic>
MESOSLIP_INLINE void multiply_stiffness(const double *C,
                                        const vdouble (&strain)[n_components<dim>],
                                        vdouble (&stress)[n_components<dim>])
{
  constexpr int n = n_components<dim>;
  const auto e    = [&](const int j) { return strain[j]; };
  for (int i = 0; i < n; ++i)
    {
      const auto row = [&](const int j) { return splat(C[i * n + j]); };
      if constexpr (anisotropic)
        stress[i] = sum_of_products<n>(row, e);
      else
        stress[i] = i < dim ? sum_of_products<dim>(row, e) : row(i) * e(i);
    }
}
