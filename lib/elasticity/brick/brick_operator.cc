#include "elasticity/brick/brick_operator.h"

#include "elasticity/brick/brick_matrices.h"
#include "material/stiffness.h"
#include "material/symmetric_eigenvalues.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** The phase with its stiffness in the axes of the sweep. */
ElasticPhase<3> turned(const ElasticPhase<3> &phase)
{
  constexpr int place[6] = {0, 2, 1, 3, 5, 4};
  ElasticPhase<3> result = phase;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      result.stiffness(i, j) = phase.stiffness(place[i], place[j]);
  return result;
}

/**
 * Rows of cells per tile. The data shared by two planes (about 96 bytes per node of a
 * row) should fit into half of the second-level cache.
 */
unsigned int rows_of_tile(const std::size_t stride, const unsigned int n_rows)
{
  constexpr std::size_t cache = std::size_t{512} * 1024, of_node = 96;
  const auto rows = static_cast<unsigned int>(cache / (of_node * stride));
  return std::min(std::max(rows, 4U), n_rows);
}

/** Kernel kinds, see BrickKernels. */
enum Kind : unsigned int
{
  cubes,
  isotropic,
  orthotropic,
  general,
  materials,
  isotropic_apart,
  general_apart,
  materials_apart
};

/** Number of coefficients of each kind. */
constexpr unsigned int n_coefficients_of[kernels::n_brick_kinds] = {
  n_cubes,   n_isotropic,       n_orthotropic,   n_general,
  n_general, n_isotropic_apart, n_general_apart, n_general_apart};

Kind kind_of(const std::vector<ElasticPhase<3>> &phases, const std::array<double, 3> &h)
{
  const bool apart =
    std::any_of(phases.begin(), phases.end(),
                [](const ElasticPhase<3> &phase) { return phase.mean_dilatation; });
  if (CellIndices::is_wide(phases.size()))
    return apart ? materials_apart : materials;
  Kind kind = isotropic;
  for (const ElasticPhase<3> &phase : phases)
    if (!is_orthotropic<3>(phase.stiffness))
      return apart ? general_apart : general;
    else if (!is_isotropic(phase.stiffness))
      kind = apart ? general_apart : orthotropic;
  const bool equal =
    std::abs(h[0] - h[1]) <= 1e-14 * h[0] && std::abs(h[0] - h[2]) <= 1e-14 * h[0];
  if (kind != isotropic)
    return kind;
  return equal ? cubes : apart ? isotropic_apart : isotropic;
}

kernels::BrickKernels kernels_for(const InstructionSet isa)
{
  using namespace kernels;
  using Make       = BrickKernels (*)();
  const Make all[] = MESOSLIP_VARIANTS(brick_kernels);
  return variant(all, isa)();
}
} // namespace

BrickOperator::BrickOperator(BrickSlab slab,
                             const std::vector<ElasticPhase<3>> &phases,
                             const MPI_Comm communicator,
                             const InstructionSet isa)
  : communicator(communicator)
  , the_slab(std::move(slab))
  , isa(resolve(isa))
  , kernels(kernels_for(this->isa))
  , planes(std::make_unique<PlaneExchange>(the_slab, communicator))
{
  AssertDimension(phases.size(), the_slab.none);
  const auto &h         = the_slab.box.grid.spacing;
  sweep.n[0]            = the_slab.n_nodes[0];
  sweep.n[1]            = the_slab.n_nodes[1];
  sweep.n[2]            = the_slab.n_planes;
  sweep.stride          = the_slab.stride;
  sweep.periodic        = the_slab.box.periodic[0];
  sweep.ratio[0]        = h[2] / h[0];
  sweep.ratio[1]        = h[2] / h[1];
  sweep.plane_start     = the_slab.plane_start.data();
  sweep.phase           = the_slab.phase.bytes();
  sweep.material        = the_slab.phase.words();
  sweep.n_phases        = the_slab.none + 1;
  sweep.has_layer_below = the_slab.has_layer(false);
  sweep.has_layer_above = the_slab.has_layer(true);
  sweep.rows_at_once    = rows_of_tile(sweep.stride, sweep.n[1]);
  scratch.resize(kernels::scratch_size(sweep.stride, sweep.rows_at_once));
  carry.resize((std::size_t{sweep.n[2]} + 1) * 12 * sweep.stride);
  sweep.scratch = scratch.data();
  sweep.carry   = carry.data();
  sweep.below   = planes->below();
  sweep.above   = planes->above();
  set_stiffness(phases);
  set_mass(phases);
}

BrickOperator::~BrickOperator() = default;

void BrickOperator::set_stiffness(const std::vector<ElasticPhase<3>> &phases)
{
  const auto &h                     = the_slab.box.grid.spacing;
  kind                              = kind_of(phases, h);
  const unsigned int n_coefficients = n_coefficients_of[kind],
                     n_together     = n_of_material(n_coefficients);
  // [coefficient][phase], or [material][coefficient]; zero for the last one.
  const bool together = kind == materials || kind == materials_apart;
  stiffness.resize(together ? (phases.size() + 1) * n_together
                            : std::size_t{256} * n_coefficients);
  const double volume = h[0] * h[1] * h[2], factor = volume / (16. * h[2] * h[2]);
  const BrickStiffness of_brick(h);
  for (std::size_t p = 0; p < phases.size(); ++p)
    {
      const std::vector<double> c = coefficients_of(turned(phases[p]), n_coefficients);
      for (std::size_t m = 0; m < c.size(); ++m)
        stiffness[together ? p * n_together + m : 256 * m + p] = factor * c[m];
      bound = std::max(bound, std::sqrt(symmetric_eigenvalues(of_brick(phases[p]))[23] *
                                        volume / (16. * h[1] * h[1]) /
                                        (phases[p].density * volume / 8.)));
    }
  sweep.stiffness = stiffness.data();
}

void BrickOperator::set_mass(const std::vector<ElasticPhase<3>> &phases)
{
  const auto &n = the_slab.n_nodes;
  std::vector<double> of_cell;
  for (const ElasticPhase<3> &phase : phases)
    of_cell.push_back(phase.density * the_slab.box.grid.cell_measure() / 8.);
  of_cell.push_back(0.);
  const unsigned int n_rows = n[1] - 1;
  const auto cell           = [&](const std::size_t layer, const unsigned int row,
                        const unsigned int i) {
    return row < n_rows
                       ? of_cell[the_slab.phase[(layer * n_rows + row) * the_slab.stride + i]]
                       : 0.;
  };
  mass.resize(the_slab.part.points.size());
  const bool periodic = the_slab.box.periodic[0];
  for (unsigned int plane = 0; plane < the_slab.n_planes; ++plane)
    for (unsigned int k = 0; k < n[1]; ++k)
      for (unsigned int i = 0; i < n[0]; ++i)
        {
          double sum = 0.;
          for (const unsigned int layer : {plane, plane + 1})
            for (const unsigned int row : {k - 1, k}) // beyond all rows: none
              {
                if (i > 0 || periodic)
                  sum += cell(layer, row, i > 0 ? i - 1 : n[0] - 1);
                sum += cell(layer, row, i);
              }
          mass[the_slab.plane_start[plane] + std::size_t{k} * n[0] + i] = sum;
        }
  for (const auto &[copy, first] : the_slab.part.copies)
    mass[copy] = mass[first];
}

void BrickOperator::exchange_planes(const double *const x[3],
                                    const double *const w[3],
                                    const double beta) const
{
  planes->exchange([&](const unsigned int plane, double *out) {
    kernels.copy_plane(sweep, x, w, beta, plane, out);
  });
}

void BrickOperator::multiply(NodalField<double> &f, const NodalField<double> &x) const
{
  kernels::BrickProduct product;
  const double *none[3] = {};
  for (unsigned int c = 0; c < 3; ++c)
    {
      product.x[c]   = x.row(sweep_axis[c], 0);
      product.out[c] = f.row(sweep_axis[c], 0);
    }
  exchange_planes(product.x, none, 0.);
  kernels.product[kind](sweep, product);
  set_copies(f);
}

void BrickOperator::advance(const kernels::BrickStep &step) const
{
  exchange_planes(step.u, step.w, step.beta);
  kernels.advance[kind](sweep, step);
}

void BrickOperator::set_copies(NodalField<double> &field) const
{
  for (const auto &[copy, first] : the_slab.part.copies)
    for (unsigned int c = 0; c < 3; ++c)
      field.row(c, 0)[copy] = field.row(c, 0)[first];
}

void BrickOperator::set_points_of_others(NodalField<double> &field) const
{
  const std::size_t size = std::size_t{sweep.n[0]} * sweep.n[1];
  for (unsigned int c = 0; c < 3; ++c)
    planes->pass(field.row(c, 0) + the_slab.plane_start.front(),
                 field.row(c, 0) + the_slab.plane_start.back(), size);
  set_copies(field);
}

std::string BrickOperator::kernel_name() const
{
  const std::string kinds[] = {"cubes of isotropic phases",
                               "bricks of isotropic phases",
                               "bricks of orthotropic phases",
                               "bricks of anisotropic phases",
                               "bricks of many materials",
                               "bricks of isotropic phases with mean dilatation",
                               "bricks of phases with mean dilatation",
                               "bricks of many materials with mean dilatation"};
  return to_string(isa) + " " + kinds[kind];
}
} // namespace mesoslip
