#include "eigenvalues/complex/sliding_pencil.h"

#include "eigenvalues/complex/pencil_contact.h"

#include "base/exchange.h"
#include "eigenvalues/complex/pencil_damping.h"
#include "eigenvalues/free_dofs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
using Complex = SlidingPencil::Complex;
using Triplet = Eigen::Triplet<double, std::int64_t>;

/** alpha M by free degrees of freedom; alpha does not act on platens. */
template <int dim>
RealMatrix
drags_of_mass(const FreeDofs<dim> &dofs, Eigen::VectorXd mass, const double alpha)
{
  for (const PlatenDof &dof : dofs.of_platens())
    mass[static_cast<Eigen::Index>(dof.place)] -= dof.mass;
  return RealMatrix((alpha * mass).asDiagonal());
}

/** Matrix entries of the nodal drags (kg/s, in 2D kg/(m s)). */
template <int dim>
std::vector<SpringEntry> drag_entries(const ElasticBody<dim> &body,
                                      const std::vector<double> &drags)
{
  std::vector<SpringEntry> entries;
  for (std::size_t k = 0; k < drags.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      entries.push_back({{static_cast<unsigned int>(k % body.n_columns()),
                          static_cast<unsigned int>(k / body.n_columns())},
                         c,
                         c,
                         drags[k]});
  return entries;
}
} // namespace

ComplexVector product(const RealMatrix &matrix, const ComplexVector &x)
{
  ComplexVector result(matrix.rows());
  const Eigen::VectorXd real = x.real(), imaginary = x.imag();
  result.real() = matrix * real;
  result.imag() = matrix * imaginary;
  return result;
}

ComplexMatrix SlidingPencil::operator()(const Complex s) const
{
  const Complex damped = 1. + law.beta * s;
  const ComplexMatrix force =
    (damped * lag(s)).cwiseInverse().asDiagonal() *
    ComplexMatrix(targets.cast<Complex>() * damped + spring_targets.cast<Complex>() +
                  (damped_targets - drag).cast<Complex>() * s -
                  late_drag.cast<Complex>() * (s / (1. + law.state_time * s)));
  return mass.cast<Complex>() * (s * s / damped) +
         resistances.cast<Complex>() * (s / damped) +
         springs.cast<Complex>() * (1. / damped) + stiffness.cast<Complex>() -
         ComplexMatrix(distribution.cast<Complex>() * force);
}

ComplexVector SlidingPencil::lag(const Complex s) const
{
  return 1. + s * (lag_at_once().cast<Complex>() +
                   late_lag().cast<Complex>() / (1. + law.state_time * s));
}

std::vector<Complex> SlidingPencil::poles() const
{
  std::vector<Complex> result;
  for (Eigen::Index q = 0; q < slack.size(); ++q)
    {
      // square s^2 + linear s + 1 = 0
      const double square = law.state_time * lag_at_once()[q],
                   linear = law.state_time + lag_at_once()[q] + late_lag()[q];
      if (linear * linear < 4. * square && distribution.col(q).nonZeros() > 0)
        result.push_back(Complex(-linear, std::sqrt(4. * square - linear * linear)) /
                         (2. * square));
    }
  return result;
}

double SlidingPencil::largest_response() const
{
  // The real part of s/(1 + s tau) is between 0 and 1/tau.
  double least = 1.;
  if (law.state_time > 0. && n_along > 0)
    least += std::min(0., late_lag().minCoeff() / law.state_time);
  return (lag_at_once() < 0.).any() || !(least > 0.)
           ? std::numeric_limits<double>::infinity()
           : 1. / least;
}

ComplexVector SlidingPencil::friction_force(const Complex s, const ComplexVector &u) const
{
  return ((1. + law.beta * s) * product(targets, u) + product(spring_targets, u) +
          s * product(damped_targets, u) - s * product(drag, u) -
          s / (1. + law.state_time * s) * product(late_drag, u))
    .cwiseQuotient(lag(s));
}

RealMatrix SlidingPencil::whole_stiffness() const
{
  RealMatrix whole = stiffness;
  if (on_springs())
    whole += springs;
  return whole;
}

double SlidingPencil::residual(const Complex s, const ComplexVector &u) const
{
  const Complex damped = 1. + law.beta * s;
  const ComplexVector inertia =
                        s / damped * (s * product(mass, u) + product(resistances, u)),
                      force = friction_force(s, u) / damped;
  ComplexVector elastic     = product(stiffness, u);
  if (on_springs())
    elastic += product(springs, u) / damped;
  ComplexVector sum = inertia + elastic;
  sum -= product(distribution, force);
  return sum.norm() / (inertia.norm() + elastic.norm() + force.norm());
}

template <int dim>
RealMatrix whole_stiffness(const ElasticBody<dim> &body, const MPI_Comm communicator)
{
  std::vector<MatrixEntry> entries = body.stiffness_entries();
  if (body.is_distributed())
    {
      const auto of_ranks = mpi::all_gather(entries, communicator);
      entries.clear();
      for (const std::vector<MatrixEntry> &of_rank : of_ranks)
        entries.insert(entries.end(), of_rank.begin(), of_rank.end());
    }
  std::vector<Triplet> triplets;
  triplets.reserve(entries.size());
  for (const MatrixEntry &entry : entries)
    triplets.emplace_back(entry.row, entry.column, entry.value);
  const auto n = static_cast<Eigen::Index>(static_cast<std::size_t>(body.n_columns()) *
                                           body.n_rows() * dim);
  RealMatrix all(n, n);
  all.setFromTriplets(triplets.begin(), triplets.end());
  return all;
}

template <int dim>
SlidingPencil make_sliding_pencil(const ElasticBody<dim> &body,
                                  const RealMatrix &all,
                                  const FreeDofs<dim> &dofs,
                                  const SlidingNodesAtRest &contact,
                                  const SlidingLaw &law,
                                  const DampingByPhase &damping)
{
  const ContactMotion<dim> motion = make_contact_motion<dim>(body, dofs, contact);
  const Eigen::VectorXd mass      = masses_of(dofs);
  const RealMatrix springs        = whole_matrix(body, body.foundation().springs);
  RealMatrix resistances          = whole_matrix(body, body.foundation().dashpots);
  const bool damps_by_phase       = damping.stiffness.size() > 0;

  SlidingPencil pencil;
  pencil.law  = law;
  pencil.free = motion.free;
  pencil.mass = motion.of_free(RealMatrix(mass.asDiagonal()));
  pencil.own_mass.resize(pencil.mass.rows());
  for (Eigen::Index k = 0; k < pencil.size(); ++k)
    pencil.own_mass[k] = mass[motion.of_unknowns[static_cast<std::size_t>(k)]];
  pencil.stiffness   = motion.among_unknowns(all);
  pencil.springs     = motion.among_unknowns(springs) + springs_of(motion, contact);
  pencil.resistances = motion.among_unknowns(resistances) +
                       motion.of_free(drags_of_mass(dofs, mass, law.alpha));
  if (damps_by_phase)
    {
      const RealMatrix damped = motion.among_unknowns(damping.stiffness);
      pencil.resistances += damped + motion.of_free(drags_of(body, dofs, damping.drags));
      pencil.beta_besides = mean_beta(pencil.whole_stiffness(), damped);
      resistances +=
        damping.stiffness + whole_matrix(body, drag_entries(body, damping.drags));
    }
  const RealMatrix by_forces = normal_reactions(body, dofs, contact);
  const auto reactions       = [&](const RealMatrix &whole) {
    return RealMatrix(by_forces * (whole * motion.whole).eval());
  };
  add_contact<dim>(motion, {{reactions(all), reactions(resistances), reactions(springs)}},
                   contact, pencil);
  return pencil;
}

template RealMatrix whole_stiffness(const ElasticBody<2> &, const MPI_Comm);
template RealMatrix whole_stiffness(const ElasticBody<3> &, const MPI_Comm);
template SlidingPencil make_sliding_pencil(const ElasticBody<2> &,
                                           const RealMatrix &,
                                           const FreeDofs<2> &,
                                           const SlidingNodesAtRest &,
                                           const SlidingLaw &,
                                           const DampingByPhase &);
template SlidingPencil make_sliding_pencil(const ElasticBody<3> &,
                                           const RealMatrix &,
                                           const FreeDofs<3> &,
                                           const SlidingNodesAtRest &,
                                           const SlidingLaw &,
                                           const DampingByPhase &);
} // namespace mesoslip
