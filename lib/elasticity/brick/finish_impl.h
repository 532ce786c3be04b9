// Processing of the complete forces on a row of nodes during a sweep. Included inside a
// namespace by brick_kernel.cc, after rows_impl.h.

/** Writes the forces of the whole field (N). */
struct WriteForces
{
  const BrickProduct &product;

  MESOSLIP_INLINE Source source(const WriteForces &self)
  {
    return {{self.product.x[0], self.product.x[1], self.product.x[2]}, {}, 0.};
  }

  inline __attribute__((always_inline)) void finish(const BrickSweep &a,
                                                    const std::size_t k,
                                                    const std::size_t j,
                                                    const double *f) const
  {
    const std::size_t place = a.plane_start[k] + j * a.n[0];
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < a.n[0]; ++i)
        product.out[c][place + i] = f[c * a.stride + i];
  }
};

/** Advances the nodes by the beta2 scheme (see MeshStepper). */
struct Advance
{
  const BrickStep &step;

  MESOSLIP_INLINE Source source(const Advance &self)
  {
    const BrickStep &s = self.step;
    return {{s.u[0], s.u[1], s.u[2]}, {s.w[0], s.w[1], s.w[2]}, s.beta};
  }

  inline __attribute__((always_inline)) void finish(const BrickSweep &a,
                                                    const std::size_t k,
                                                    const std::size_t j,
                                                    const double *f) const
  {
    const unsigned int side = j == 0 ? 0 : 1;
    if ((j == 0 || j + 1 == a.n[1]) && step.surface_force[side] != nullptr)
      {
        double *out = step.surface_force[side] + k * 3 * a.n[0];
        for (int c = 0; c < 3; ++c)
          for (std::size_t i = 0; i < a.n[0]; ++i)
            out[std::size_t{a.n[0]} * c + i] = f[c * a.stride + i];
        return;
      }
    const std::size_t row = k * a.n[1] + j, place = a.plane_start[k] + j * a.n[0];
    const std::uint32_t first = step.held_begin[row], last = step.held_begin[row + 1];
    constexpr unsigned int at_once = 64;
    if (step.alpha == 0. && last - first <= at_once)
      {
        double before[2 * at_once];
        save(first, last, place, before);
        advance_row(a, row, place, f);
        move_held(first, last, place, before);
      }
    else
      advance_slowly(a, row, place, f);
  }

private:
  MESOSLIP_INLINE vdouble new_velocity(const vdouble w,
                                       const vdouble force,
                                       const vdouble inverse_mass,
                                       const double dt,
                                       const double acceleration)
  {
    return fma(splat(dt), fnma(inverse_mass, force, splat(acceleration)), w);
  }

  inline __attribute__((always_inline)) void advance_row(const BrickSweep &a,
                                                         const std::size_t row,
                                                         const std::size_t place,
                                                         const double *f) const
  {
    constexpr std::size_t length = Simd<double>::length;
    const std::size_t n = a.n[0], whole = n / length * length, rest = n - whole;
    const double *inverse_mass = step.inverse_mass[row];
    for (int c = 0; c < 3; ++c)
      {
        double *u = step.u[c] + place, *w = step.w[c] + place;
        const double *force = f + c * a.stride;
        const double g      = step.acceleration[c];
        for (std::size_t i = 0; i < whole; i += length)
          {
            const vdouble old = load_any(w + i),
                          now = new_velocity(old, load_any(force + i),
                                             load_any(inverse_mass + i), step.dt, g);
            store_any(w + i, now);
            store_any(u + i, load_any(u + i) + moved(now, old));
          }
        const vdouble old = load_some(w + whole, rest),
                      now =
                        new_velocity(old, load_some(force + whole, rest),
                                     load_some(inverse_mass + whole, rest), step.dt, g);
        store_some(w + whole, now, rest);
        store_some(u + whole, load_some(u + whole, rest) + moved(now, old), rest);
      }
  }

  inline __attribute__((always_inline)) vdouble moved(const vdouble now,
                                                      const vdouble old) const
  {
    return fma(splat(step.c_new), now, splat(step.c_old) * old);
  }

  inline __attribute__((always_inline)) void save(const std::uint32_t first,
                                                  const std::uint32_t last,
                                                  const std::size_t place,
                                                  double *before) const
  {
    for (std::uint32_t h = first; h < last; ++h, before += 2)
      {
        const HeldNode &node = step.held[h];
        before[0]            = step.u[node.component][place + node.node];
        before[1]            = step.w[node.component][place + node.node];
      }
  }

  /** Constrained components keep their velocity. */
  inline __attribute__((always_inline)) void move_held(const std::uint32_t first,
                                                       const std::uint32_t last,
                                                       const std::size_t place,
                                                       const double *before) const
  {
    for (std::uint32_t h = first; h < last; ++h, before += 2)
      {
        const HeldNode &node = step.held[h];
        step.u[node.component][place + node.node] =
          before[0] + (step.c_new + step.c_old) * before[1];
        step.w[node.component][place + node.node] = before[1];
      }
  }

  /** Advances a row with many constrained components or mass-proportional damping. */
  void advance_slowly(const BrickSweep &a,
                      const std::size_t row,
                      const std::size_t place,
                      const double *f) const
  {
    const double *inverse_mass = step.inverse_mass[row];
    // Entries are in the order of this loop.
    std::uint32_t next       = step.held_begin[row];
    const std::uint32_t last = step.held_begin[row + 1];
    for (std::uint32_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < a.n[0]; ++i)
        {
          const bool held =
            next < last && step.held[next].component == c && step.held[next].node == i;
          next += held ? 1 : 0;
          double &u = step.u[c][place + i], &w = step.w[c][place + i];
          const double old = w;
          if (!held)
            w += step.dt * (step.acceleration[c] - step.alpha * old -
                            inverse_mass[i] * f[c * a.stride + i]);
          u += step.c_new * w + step.c_old * old;
        }
  }
};
