// Calls every baseline kernel with the same numbers on any processor and prints a digest
// of the bits of its results: other_processors.py compares the lines.

#include "contact/contact_kernel.h"
#include "elasticity/element_kernel.h"
#include "elasticity/row_kernel.h"
#include "statics/multigrid/kernels/kernels.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

using namespace mesoslip;

namespace
{
/** Rows of so many columns, a multiple of every vector, with room on both sides. */
constexpr unsigned int n = 64, margin = 64;

double random_number()
{
  static std::uint64_t state = 1;
  state                      = state * 6364136223846793005u + 1442695040888963407u;
  return static_cast<double>(state >> 11) / 9007199254740992. - 0.4;
}

/** Random numbers, starting at a cache line; data() is behind a margin. */
template <typename Number>
class Numbers
{
public:
  explicit Numbers(const std::size_t size)
    : values((size + 2 * margin) + 64)
    , start((64 - reinterpret_cast<std::uintptr_t>(values.data()) % 64) / sizeof(Number))
  {
    // From the cache line on, wherever the memory begins.
    for (std::size_t i = 0; i + 64 < values.size(); ++i)
      values[start + i] = static_cast<Number>(random_number());
  }
  Number *data()
  {
    return values.data() + start + margin;
  }
  Number *row(const unsigned int r)
  {
    return data() + static_cast<std::size_t>(r) * 2 * n;
  }
  void digest(const std::string &name) const
  {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (std::size_t i = 0; i + 64 < values.size(); ++i)
      {
        std::uint64_t bits = 0;
        std::memcpy(&bits, values.data() + start + i, sizeof(Number));
        hash = (hash ^ bits) * 0x100000001b3;
      }
    std::printf("%s %016llx\n", name.c_str(), static_cast<unsigned long long>(hash));
  }

private:
  std::vector<Number> values;
  std::size_t start;
};

template <typename Number>
void row_kernels(kernels::Choice choice, const std::string &name)
{
  static kernels::Constants<Number> c;
  for (auto &coefficient : c.coefficient)
    for (Number &x : coefficient)
      x = static_cast<Number>(random_number());
  c.n_cells = n - 3;
  c.ratio   = 0.7f;
  c.beta    = 0.1f;
  c.c_new   = 0.9f;
  c.c_old   = 0.2f;
  c.scale_x = c.scale_y = 1.1f;
  c.gravity_x = c.gravity_y = c.scaled_gravity_x = c.scaled_gravity_y = 0.3f;
  c.alpha = c.scaled_alpha_x = c.scaled_alpha_y = 0.2f;
  std::vector<std::uint8_t> phases(4 * n, 0);
  for (unsigned int k = 0; k < phases.size(); ++k)
    phases[k] = choice.n_phases == 2 ? k * k % 7 % 2 : k * k % 31;
  kernels::Kernels<Number> functions;
  kernels::baseline::select(choice, functions);
  for (const bool periodic : {false, true})
    for (unsigned int several = 0; several < 2; ++several)
      for (const auto function :
           {functions.step[several], functions.store[several], functions.finish})
        {
          if (function == nullptr)
            continue;
          c.periodic = periodic;
          Numbers<Number> x(64 * 2 * n);
          kernels::Rows<Number> r;
          unsigned int row = 0;
          const auto rows  = [&](const unsigned int count) {
            row += count;
            return x.row(row - count);
          };
          r.ux = rows(4), r.uy = rows(4), r.wx = rows(4), r.wy = rows(4);
          r.qx = rows(1), r.qy = rows(1), r.sxy = rows(1), r.syy = rows(1);
          r.fx = rows(3), r.fy = rows(3), r.factor_x = rows(3), r.factor_y = rows(3);
          r.mass   = rows(3);
          r.stride = r.f_stride = r.factor_stride = r.mass_stride = 2 * n;
          r.phases                                                = phases.data();
          r.phase_stride                                          = n;
          function(c, r);
          x.digest(name);
        }
}

void all_row_kernels()
{
  for (const unsigned int n_phases : {1, 2, 31})
    for (unsigned int terms = 0; terms < 8; ++terms)
      {
        kernels::Choice choice;
        choice.n_phases    = n_phases;
        choice.anisotropic = terms & 1;
        choice.damping     = terms & 2;
        choice.gravity     = terms & 4;
        const std::string name =
          " row " + std::to_string(n_phases) + " " + std::to_string(terms);
        row_kernels<double>(choice, "double" + name);
        row_kernels<float>(choice, "float" + name);
      }
  Numbers<double> x(8 * 2 * n);
  kernels::Choice choice;
  kernels::Kernels<double> functions;
  kernels::baseline::select(choice, functions);
  functions.strain(x.row(0), x.row(1), 4 * n, n - 1, 0.3, 0.4, x.row(4), x.row(5),
                   x.row(6));
  x.row(7)[0] = functions.dot(x.row(0), x.row(1), n - 1);
  x.digest("strain and dot");
}

void contact_kernel()
{
  constexpr unsigned int n_rows = 13 + ContactArrays::n_columns;
  Numbers<double> x(n_rows * 2 * n);
  unsigned int k  = 0;
  const auto next = [&]() { return x.row(k++); };
  ContactArrays a = {};
  a.n             = n;
  for (const double **components : {a.force, a.inverse_mass})
    for (const unsigned int c : {0, 1, 2})
      components[c] = next();
  for (double **components : {a.u, a.w})
    for (const unsigned int c : {0, 1, 2})
      components[c] = next();
  for (double *&column : a.column)
    column = next();
  for (const auto of_spring : {ContactArrays::softness, ContactArrays::slackness})
    for (unsigned int i = 0; i < n; ++i)
      a.column[of_spring][i] = std::max(0., a.column[of_spring][i]);
  ContactSums sums;
  for (unsigned int step = 0; step < 5; ++step)
    {
      const ContactStep constants = {1e-1, 0.7, {1e-3, -4e-4}, {9e-4, -5e-4}, {0.6, 0.8}};
      contact_kernels::baseline::advance(a, constants, sums);
      contact_kernels::baseline::advance_in_space(a, constants, sums);
      contact_kernels::baseline::advance_in_full(a, constants, sums);
      contact_kernels::baseline::advance_in_full_in_space(a, constants, sums);
    }
  const double all[] = {sums.normal_force,  sums.tangential_force, sums.sticking,
                        sums.slipping,      sums.friction_energy,  sums.impact_energy,
                        sums.stored_energy, sums.lifting_work};
  std::memcpy(x.row(n_rows - 1), all, sizeof(all));
  x.digest("contact");
}

template <int dim>
void cell_kernels(const kernels::CellKernels &cells)
{
  const std::string in_space  = std::to_string(dim) + "D";
  const std::size_t n_batches = 4, n_nodes = n / 4;
  std::vector<std::uint32_t> nodes(n_batches * 8 * cells.cells_at_once),
    material(n_batches);
  // No node twice in a cell, whose volume is not 0 then: the sign of a NaN differs.
  for (std::size_t k = 0; k < nodes.size(); ++k)
    nodes[k] = static_cast<std::uint32_t>(
      (k / cells.cells_at_once * 3 + k % cells.cells_at_once * 5) % n_nodes *
      kernels::node_stride<dim>);
  for (unsigned int kind = 0; kind < 2; ++kind)
    for (unsigned int common = 0; common < 3; ++common)
      {
        Numbers<double> stiffness(24 * 24), points(2 * n), u(2 * n), f(2 * n),
          shapes(n_batches * dim * 7 * cells.cells_at_once);
        const kernels::CellBatches batches = {n_batches,        nodes.data(),
                                              material.data(),  stiffness.data(),
                                              stiffness.data(), shapes.data()};
        if (kind == 1) // of simplices it would take roots of negative volumes
          cells.shapes[kind](batches, points.data(), shapes.data());
        (kind == 0 ? cells.simplex : cells.tensor)[common](batches, u.data(), f.data());
        const std::string name = std::to_string(kind) + std::to_string(common);
        f.digest(in_space + " cells " + name);
        if (kind == 1 && common == 0)
          shapes.digest(in_space + " shapes " + name);
      }
  Numbers<double> x(14 * 2 * n);
  kernels::NodeArrays a = {};
  a.n                   = n_nodes;
  for (unsigned int c = 0; c < 3; ++c)
    {
      a.u[c]            = x.row(3 * c);
      a.w[c]            = x.row(3 * c + 1);
      a.inverse_mass[c] = x.row(3 * c + 2);
    }
  a.mass  = x.row(9);
  a.z     = x.row(10);
  a.force = x.row(12);
  cells.advance(a, {0.1, 0.07, 0.03, 0.2, 0.4, {0.1, 0.2, 0.3}});
  x.digest(in_space + " nodes");
}

template <typename Number>
void multigrid_kernels(const multigrid::GridKernels<Number> &g,
                       const std::string &precision)
{
  for (unsigned int nc = 2; nc < 4; ++nc)
    {
      Numbers<Number> x(80 * 2 * n);
      Number *r[24];
      for (unsigned int k = 0; k < 24; ++k)
        r[k] = x.row(k);
      Number *const more       = x.row(24);
      const unsigned int lanes = 64 / sizeof(Number);
      multigrid::TransferRow<Number> transfer;
      transfer.even     = r[18];
      transfer.odd_left = r[19], transfer.odd_right = r[20];
      transfer.to_left = r[21], transfer.to_right = r[22];
      transfer.dy = 0.3f;
      if (nc == 3)
        g.stencil_residual(n, more, more + 44 * n, n, r, r + 9, r + 12);
      g.eliminate[nc - 2](n, more, n, r, r + 3, r + 6);
      g.substitute[nc - 2](n, more, n, r, r + 3, Number(0.7), nc == 3, r + 9);
      g.solve_tile[nc - 2](n / 16, more, more + 60 * n);
      g.load_tile(n / 2, nc, r, more + 60 * n);
      g.add_tile(n / 2, nc, lanes - 1, more + 60 * n, Number(0.3), r);
      g.split(n / 2, r[0], r[12], r[13]);
      g.merge(n / 2, r[3], r[4], r[14]);
      g.restrict_row[nc - 2](n / 2, transfer, r, r + 3, r + 6);
      g.prolongate_row[nc - 2](n / 2, transfer, nc == 2, r, r + 9, r + 12);
      g.subtract_from(n, r[15], r[16]);
      Numbers<double> y(5 * 2 * n);
      g.direction(n, 0.3, 0.4, r[0], y.row(0));
      g.scaled(n, 0.7, y.row(1), r[17]);
      g.two_dots(n, y.row(0), y.row(1), r[1], y.row(2));
      x.digest(precision + " multigrid " + std::to_string(nc));
      y.digest(precision + " multigrid vectors " + std::to_string(nc));
    }
}

template <typename Patch>
void fill(Patch &patch)
{
  double *const begin = reinterpret_cast<double *>(&patch);
  for (std::size_t k = 0; k < sizeof(Patch) / sizeof(double); ++k)
    begin[k] = random_number();
  patch.n_rows = 2;
}

void all_multigrid_kernels()
{
  const multigrid::Kernels &k = multigrid::baseline::kernels();
  multigrid_kernels(k.single, "float");
  multigrid_kernels(k.twice, "double");
  static multigrid::FinestPatch finest;
  static multigrid::CoarsePatch coarse;
  fill(finest);
  fill(coarse);
  Numbers<double> x(40 * 2 * n);
  k.galerkin_finest(finest, x.row(0), 8);
  k.galerkin_coarse(coarse, x.row(8), 8);
  k.dense(n - 3, x.row(0), n, x.row(36), x.row(37));
  x.row(39)[0] = k.dot(n, x.row(0), x.row(1));
  x.row(39)[1] = k.step(n, 0.3, x.row(0), x.row(1), x.row(2), x.row(3));
  x.digest("galerkin and sums");
}
} // namespace

int main()
{
  all_row_kernels();
  contact_kernel();
  cell_kernels<2>(kernels::baseline::plane_cell_kernels());
  cell_kernels<3>(kernels::baseline::solid_cell_kernels());
  all_multigrid_kernels();
}
