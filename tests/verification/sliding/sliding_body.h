#ifndef mesoslip_tests_verification_sliding_body_h
#define mesoslip_tests_verification_sliding_body_h

#include "dynamics/critical_time_step.h"
#include "dynamics/stepper.h"
#include "material/stiffness.h"
#include "sliding/sliding_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <vector>

namespace verification
{
using namespace mesoslip;

/** What makes a run; the friction coefficient is that of all nodes. */
struct BodySetup : SlidingSetup
{
  std::array<unsigned int, 2> cells = {};
  std::array<double, 2> spacing     = {};
  std::vector<ElasticPhase<2>> classes;
  std::vector<std::uint8_t> ids;
  double friction = 0.;

  UniformMaterial material() const
  {
    const UniformGrid<2> grid{cells, spacing};
    return UniformMaterial(grid, classes, ids, Periodicity{periodic, false});
  }

  SlidingSetup with_friction() const
  {
    SlidingSetup s = *this;
    s.contact.friction_coefficient.resize(cells[0] + 1, friction);
    return s;
  }

  /** @p share of the critical time step of the other parameters. */
  void choose_time_step(const double share)
  {
    step.dt = share * critical_time_step(material(), step.beta2, step.beta);
  }
};

struct OwnMaterial
{
  const UniformMaterial own_material;
};

/** Time steps with the energy balance, if there is one, and an observer or none. */
inline void run_steps(Stepper &stepper,
                      EnergyAudit *energy,
                      const std::uint64_t n_steps,
                      StepObserver *other)
{
  std::vector<StepObserver *> observers;
  if (other != nullptr)
    observers.push_back(other);
  if (energy != nullptr)
    observers.push_back(energy);
  run_time_loop(stepper, observers, stepper.step_number() + n_steps, 1u << 20,
                [](const std::uint64_t) { return true; });
}

/** A body with its material, and fields from functions. */
class Body : OwnMaterial, public SlidingGrid
{
public:
  explicit Body(const BodySetup &setup,
                MPI_Comm communicator       = MPI_COMM_SELF,
                SurfaceCondition<2> *bottom = nullptr)
    : OwnMaterial{setup.material()}
    , SlidingGrid(own_material, setup.with_friction(), communicator, bottom)
    , setup(setup)
  {
  }

  const BodySetup setup;

  /** Sets u and w (of this rank's rows) to a function of x, y and component. */
  static void set(NodalField<double> &field,
                  const UniformMaterial &material,
                  const NodeRows &rows,
                  const std::function<double(double, double, unsigned int)> &f)
  {
    const auto &h = material.grid().spacing;
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int j = rows.first(); j < rows.last(); ++j)
        {
          double *row = field.row(c, rows.local(j));
          for (unsigned int i = 0; i < field.n_columns(); ++i)
            row[i] = f(i * h[0], j * h[1], c);
          if (material.periodicity().x)
            row[field.n_columns() - 1] = row[0];
        }
  }

  void set_u(const std::function<double(double, double, unsigned int)> &f)
  {
    set(u, material, rows, f);
  }

  void set_w(const std::function<double(double, double, unsigned int)> &f)
  {
    set(w, material, rows, f);
  }

  void run(const std::uint64_t n_steps, StepObserver *other = nullptr)
  {
    run_steps(stepper, energy.get(), n_steps, other);
  }

  /** A component of a field at a node. */
  double at(const NodalField<double> &field,
            const unsigned int c,
            const unsigned int i,
            const unsigned int j) const
  {
    return field.row(c, j)[i];
  }

  static constexpr double depth = 1.;           ///< forces are those on so much of it (m)
  static constexpr unsigned int nodes_deep = 1; ///< nodes across the plane
};

/** Bottom row that keeps u_y and is free along x. */
struct HeldBelow : FreeSurface<2>
{
  explicit HeldBelow(const StepParameters &p)
    : FreeSurface(p)
  {
  }

  void advance(const SurfaceView<2> &surface) override
  {
    const std::vector<double> nothing(surface.n, 0.);
    SurfaceView<2> held  = surface;
    held.inverse_mass[1] = nothing.data();
    FreeSurface::advance(held);
  }
};

/** The largest of n absolute values; infinity if one is not a number. */
inline double largest(const double *values, const std::size_t n)
{
  double most = 0.;
  for (std::size_t k = 0; k < n; ++k)
    most = std::max(most, std::isnan(values[k]) ? HUGE_VAL : std::abs(values[k]));
  return most;
}

inline double largest(const std::vector<double> &values)
{
  return largest(values.data(), values.size());
}

/** Largest difference of two fields over the largest value of the first, by component. */
inline double relative_difference(const NodalField<double> &a,
                                  const NodalField<double> &b,
                                  const double factor = 1.)
{
  double worst = 0.;
  for (unsigned int c = 0; c < 2; ++c)
    {
      double difference = 0., size = 0.;
      std::vector<double> d(a.n_columns());
      for (unsigned int j = 0; j < a.n_rows(); ++j)
        {
          for (unsigned int i = 0; i < a.n_columns(); ++i)
            d[i] = a.row(c, j)[i] - factor * b.row(c, j)[i];
          difference = std::max(difference, largest(d));
          size       = std::max(size, largest(a.row(c, j), a.n_columns()));
        }
      worst = std::max(worst, difference > 0. ? difference / size : 0.);
    }
  return worst;
}

/** a . M b */
inline double mass_product(const UniformMaterial &material,
                           const NodalField<double> &a,
                           const NodalField<double> &b)
{
  std::vector<double> mass(material.n_columns());
  double sum = 0.;
  for (unsigned int j = 0; j < a.n_rows(); ++j)
    {
      material.mass_row(j, mass.data());
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int i = 0; i < a.n_columns(); ++i)
          sum += mass[i] * a.row(c, j)[i] * b.row(c, j)[i];
    }
  return sum;
}

/** log2 of the error ratio of each refinement by two. */
inline std::vector<double> orders(const std::vector<double> &errors)
{
  std::vector<double> found;
  for (std::size_t k = 1; k < errors.size(); ++k)
    found.push_back(std::log2(std::abs(errors[k - 1] / errors[k])));
  return found;
}

/** The paper's matrix, rounded: c_T = 2560 m/s, nu = 0.2, plane strain. */
inline ElasticPhase<2> resin(const double density = 1900.)
{
  const double G = density * 2560. * 2560.;
  return {isotropic_stiffness<2>(2.4 * G, 0.2), density};
}
} // namespace verification

#endif
