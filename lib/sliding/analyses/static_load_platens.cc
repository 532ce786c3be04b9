#include "base/errors.h"
#include "base/exchange.h"
#include "material/plausibility.h"
#include "sliding/analyses/static_load.h"

#include <algorithm>
#include <cmath>
#include <exception>

namespace mesoslip
{
/** Adds the platens of the sides, then the platen of the top. */
template <int dim>
void StaticLoad<dim>::add_platens(const GivenBody<dim> &body)
{
  const TopSetup &of_top               = parameters.top;
  const std::vector<SideSupport> sides = body.loaded_sides();
  std::vector<Platen> all              = body.platens(of_top);
  if (of_top.is_platen)
    std::rotate(all.begin(), all.begin() + 1, all.end());
  platens          = all;
  std::size_t side = 0;
  for (std::size_t k = 0; k < platens.size(); ++k, ++side)
    {
      const bool is_top = of_top.is_platen && k + 1 == platens.size();
      while (!is_top && !sides[side].is_platen)
        ++side;
      const SideSupport &support = is_top ? of_top : sides[side];
      const double area = is_top ? facts.size.top_area : facts.size.side_area[side];
      for (unsigned int c = 0; c < dim; ++c)
        if (platens[k].moves[c])
          {
            const unsigned int normal = is_top ? dim - 1 : c;
            const double of_body =
              elastic.phases()[0].stiffness(normal, normal) / elastic.extent(normal);
            const double push =
              is_top ? (c == normal ? -area : 0.) : facts.size.side_push[side][c];
            platen_moves.push_back({k, c, -push * support.pressure.amplitude(),
                                    area * support.suspension.stiffness[c] *
                                      std::fabs(support.suspension.motion[c](0.)),
                                    area * (of_body + support.suspension.stiffness[c])});
          }
    }
}

/** Reaction forces of body and springs on the platens, in their components of motion,
 * from the equilibrium of their nodes (N, in 2D N/m). */
template <int dim>
Eigen::VectorXd StaticLoad<dim>::platen_force() const
{
  NodalField<double> internal = elastic.zero_field();
  elastic.vmult(internal, problem.displacement);
  const std::vector<bool> counted = elastic.counted_masters();
  Eigen::VectorXd force(platen_moves.size());
  for (std::size_t k = 0; k < platen_moves.size(); ++k)
    {
      const unsigned int c = platen_moves[k].component;
      double sum           = 0.;
      for (const NodeIndex &node : platens[platen_moves[k].platen].nodes)
        if (counted[std::size_t{node.j} * elastic.n_columns() + node.i])
          sum += problem.force(c, node) - internal(c, node);
      force[static_cast<Eigen::Index>(k)] = mpi::sum(sum, elastic.communicator());
    }
  return force;
}

template <int dim>
void StaticLoad<dim>::press_in_proportion()
{
  solve();
  const double factor =
    parameters.top.pressure.amplitude() * facts.size.top_area / platen_force()[0];
  NodalField<double> &u = solution.displacement;
  for (std::size_t k = 0; k < u.size(); ++k)
    u.begin()[k] *= factor;
  for (auto *forces : {&solution.normal_force, &solution.tangential_force})
    for (double &f : *forces)
      f *= factor;
}

template <int dim>
void StaticLoad<dim>::press(const double share)
{
  // Broyden's method; in one component this is the secant through the last two forces.
  // Forces are proportional to the lowering of the platen if there are no gaps or
  // springs.
  constexpr unsigned int most = 40;
  const auto n                = static_cast<Eigen::Index>(platen_moves.size());
  Eigen::VectorXd wanted(n), before, moved;
  double scale = parameters.top.is_platen
                   ? 0.
                   : share * parameters.top.pressure.amplitude() * facts.size.top_area;
  for (Eigen::Index k = 0; k < n; ++k)
    {
      const PlatenMove &move = platen_moves[static_cast<std::size_t>(k)];
      wanted[k]              = share * move.pressed;
      scale += std::fabs(wanted[k]) + share * move.pulled;
    }
  const bool first = done.empty(), is_lowered = parameters.top.is_platen;
  // If the body hangs on the platen, the flat does not carry it; closer to the flat it
  // may.
  std::exception_ptr failed;
  if (first)
    start_platens(share);
  else
    shift *= share / done.back().share;
  for (unsigned int step = 0; step < most; ++step)
    {
      move_platens();
      failed = failure_of_solve();
      if (failed && before.size() == 0 && !is_lowered)
        break;
      if (failed && before.size() == 0)
        shift[n - 1] *= 2.;
      else if (failed)
        shift -= (moved *= 0.5);
      if (failed)
        continue;
      const Eigen::VectorXd force = platen_force();
      if ((force - wanted).cwiseAbs().maxCoeff() <= 10. * options.tolerance * scale)
        return;
      if (before.size() > 0)
        {
          const Eigen::VectorXd by        = mobility * (force - before);
          const Eigen::RowVectorXd weight = moved.transpose() * mobility;
          if (const double length = moved.dot(by); length != 0.)
            mobility += (moved - by) * weight / length;
        }
      else if (first && n == 1 && force[0] > 0. && is_lowered &&
               !parameters.top.suspension.is_there())
        mobility(0, 0) = shift[0] / force[0];
      before = force;
      moved  = mobility * (wanted - force);
      shift += moved;
    }
  if (failed)
    std::rethrow_exception(failed);
  throw NotConverged(brief_text(6, "static contact: a platen carries ", before[n - 1],
                                " of ", wanted[n - 1], dim == 2 ? " N/m" : " N",
                                " after moving the platens ", most, " times"));
}

/** Puts the nodes of the platens at the platen positions. */
template <int dim>
void StaticLoad<dim>::move_platens()
{
  for (std::size_t k = 0; k < platen_moves.size(); ++k)
    for (const NodeIndex &node : platens[platen_moves[k].platen].nodes)
      problem.displacement(platen_moves[k].component, node) =
        shift[static_cast<Eigen::Index>(k)];
}

/** The exception of solve() if there is no equilibrium, else null. */
template <int dim>
std::exception_ptr StaticLoad<dim>::failure_of_solve()
{
  try
    {
      solve();
    }
  catch (const NotConverged &)
    {
      return std::current_exception();
    }
  catch (const NumericalFailure &)
    {
      return std::current_exception();
    }
  return nullptr;
}

/** Initial guess of platen positions and mobility under a @p share of the load. */
template <int dim>
void StaticLoad<dim>::start_platens(const double share)
{
  const auto n = static_cast<Eigen::Index>(platen_moves.size());
  shift        = Eigen::VectorXd::Zero(n);
  mobility     = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    mobility(k, k) = -1. / platen_moves[static_cast<std::size_t>(k)].stiffness;
  if (parameters.top.is_platen)
    shift[n - 1] = -share * strain * elastic.extent(dim - 1);
}

#define MESOSLIP_INSTANTIATE(dim)                                     \
  template void StaticLoad<dim>::add_platens(const GivenBody<dim> &); \
  template void StaticLoad<dim>::press(const double);                 \
  template void StaticLoad<dim>::press_in_proportion();
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
