// A sweep over the nodes of a flat grid (VoxelGrid::flat), with the given in-plane
// stiffness (plane strain or other): rows of cells between two rows of nodes, whose
// components 0 and 1 are x and z. The basis is that of brick_impl.h with four nodes.
// Included inside a namespace by voxel_kernels.cc.

/** Upper triangle of the stiffness of xx, zz and xz. */
template <typename Number>
struct Stiffness<Number, n_plane>
{
  using Vector = typename Simd<Number>::Vector;
  Vector c[n_plane];

  template <typename Load>
  MESOSLIP_INLINE Stiffness of(const Load &load_one)
  {
    Stiffness result;
    for (unsigned int m = 0; m < n_plane; ++m)
      result.c[m] = load_one(m);
    return result;
  }

  inline __attribute__((always_inline)) void stress(const Vector e[3], Vector s[3]) const
  {
    s[0] = c[0] * e[0] + c[1] * e[1] + c[2] * e[2];
    s[1] = c[1] * e[0] + c[3] * e[1] + c[4] * e[2];
    s[2] = c[2] * e[0] + c[4] * e[1] + c[5] * e[2];
  }
};

/** Stiffness for the strains about the mean. */
template <typename Number>
MESOSLIP_INLINE const Stiffness<Number, n_plane> &
of_changing_strains(const Stiffness<Number, n_plane> &stiffness)
{
  return stiffness;
}

template <typename Number>
struct Stiffness<Number, n_plane_apart> : ApartStiffness<Number, n_plane, n_plane_apart>
{
};

template <typename Number>
MESOSLIP_INLINE const Stiffness<Number, n_plane> &
of_changing_strains(const Stiffness<Number, n_plane_apart> &stiffness)
{
  return stiffness.about;
}

/** Voigt indices of the in-plane components. */
constexpr int place_in_plane[3] = {0, 2, 4};

/** Forces @p h on the sums and differences @p v of the nodes of neighbouring cells,
 *  [component][x + 2 z]. */
template <typename Number, typename Material, typename Vector>
MESOSLIP_INLINE void flat_forces(const Layer<Number> &layer,
                                 const Material &cells,
                                 const std::size_t i,
                                 const Vector v[2][4],
                                 Vector h[2][4])
{
  const auto stiffness = cells.at(i);
  Vector e[3]          = {v[0][1], v[1][2], v[0][2] + v[1][1]}, s[3];
  if constexpr (Material::adds_stress)
    for (int m = 0; m < 3; ++m)
      e[m] += layer.strain[place_in_plane[m]];
  stiffness.stress(e, s);
  if constexpr (Material::adds_stress)
    for (int m = 0; m < 3; ++m)
      s[m] -= cells.inside(i) * layer.stress[place_in_plane[m]];
  // Stresses of the strains that vary along z and along x.
  const Vector along_z[3] = {v[0][3], Vector{}, v[1][3]},
               along_x[3] = {Vector{}, v[1][3], v[0][3]};
  Vector of_z[3], of_x[3];
  of_changing_strains(stiffness).stress(along_z, of_z);
  of_changing_strains(stiffness).stress(along_x, of_x);
  h[0][0] = h[1][0] = Vector{};
  h[0][1]           = s[0];
  h[0][2] = h[1][1] = s[2];
  h[1][2]           = s[1];
  h[0][3]           = layer.weight[2] * of_z[0] + layer.weight[0] * of_x[2];
  h[1][3]           = layer.weight[2] * of_z[2] + layer.weight[0] * of_x[1];
}

/** A sweep on a flat grid, see kernels.h. */
template <typename Number, typename Material, Sweep kind>
double flat_sweep(const SweepArguments<Number> &a)
{
  using Vector           = typename Simd<Number>::Vector;
  const std::size_t line = 2 * a.stride;
  auto layer             = first_layer<Layer<Number>>(a, 2 * line);
  layer.complete         = a.work;
  double sum             = 0.;
  for (std::size_t k = 0; k <= a.n[2]; ++k)
    {
      layer.lower = a.x + k * line;
      layer.upper = layer.lower + line;
      const Material cells(a, k);
      Vector before[2] = {};
      for (unsigned int n = 0; n < layer.n_vectors; ++n)
        {
          const std::size_t i = std::size_t{n} * Simd<Number>::length;
          Vector v[2][4], h[2][4];
          combine_nodes(layer, i, v);
          flat_forces(layer, cells, i, v, h);
          for (int c = 0; c < 2; ++c)
            complete_nodes(layer, layer.plane, c, i, h[c], before[c]);
        }
      if (k > 0)
        sum += finish_row<kind, 2>(a, k, layer.complete);
    }
  return sum;
}
