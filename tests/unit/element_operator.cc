// The product with the stiffness matrix of general cells against the same assembled by
// deal.II, the lumped mass, and what holds whatever the cells are.

#include "elasticity/element_operator.h"
#include "mesh_of_triangulation.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace mesoslip;

namespace
{
template <int dim>
struct TestMesh
{
  std::vector<dealii::Point<dim>> points;
  std::vector<Cell> cells;
};

/** A sheared brick of n^dim cells with two phases; @p shift moves the points at random. */
template <int dim>
TestMesh<dim> make_mesh(const unsigned int n, const bool simplices, const double shift)
{
  dealii::Triangulation<dim> tria, simplex;
  dealii::GridGenerator::subdivided_hyper_cube(tria, n);
  if (simplices)
    dealii::GridGenerator::convert_hypercube_to_simplex_mesh(tria, simplex);
  TestMesh<dim> mesh;
  take_cells(mesh, simplices ? simplex : tria);
  std::mt19937 generator(3);
  std::uniform_real_distribution<> random(-shift / n, shift / n);
  for (auto &p : mesh.points)
    {
      for (unsigned int d = 0; d < dim; ++d)
        p[d] += random(generator);
      p[0] += 0.3 * p[dim - 1];
    }
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
    mesh.cells[k].material_id = k % 3 == 0;
  return mesh;
}

template <int dim>
std::vector<ElasticPhase<dim>> make_phases(const bool anisotropic,
                                           const bool mean_dilatation = false)
{
  std::vector<ElasticPhase<dim>> phases(2);
  for (unsigned int p = 0; p < 2; ++p)
    {
      phases[p].density = 2. + p;
      // One of two, so that both are met.
      phases[p].mean_dilatation = mean_dilatation && p == 0;
      auto &C                   = phases[p].stiffness;
      C.diagonal().setConstant(1. + p);
      C.template topLeftCorner<dim, dim>().array() += 0.7;
      C(0, 0) += 2.;
      if (anisotropic)
        {
          C(0, dim) = C(dim, 0) = 0.2 + 0.1 * p;
          C(1, dim) = C(dim, 1) = -0.1;
        }
    }
  return phases;
}

/** Gradients of the shape functions at all quadrature points, or those whose sum of diagonals is its mean. */
template <int dim>
struct Gradients
{
  Gradients(const dealii::FEValues<dim> &values, const bool mean_dilatation)
    : values(values)
    , mean_dilatation(mean_dilatation)
    , means(values.dofs_per_cell)
  {
    double volume = 0.;
    for (const unsigned int q : values.quadrature_point_indices())
      {
        volume += values.JxW(q);
        for (const unsigned int i : values.dof_indices())
          means[i] += values.JxW(q) * values.shape_grad(i, q);
      }
    for (auto &mean : means)
      mean /= volume;
  }

  /** Of the displacement of component @p c by shape function @p i. */
  dealii::Tensor<2, dim>
  operator()(const unsigned int i, const unsigned int c, const unsigned int q) const
  {
    dealii::Tensor<2, dim> gradient;
    gradient[c] = values.shape_grad(i, q);
    for (unsigned int d = 0; mean_dilatation && d < dim; ++d)
      gradient[d][d] += (means[i][c] - values.shape_grad(i, q)[c]) / dim;
    return gradient;
  }

  const dealii::FEValues<dim> &values;
  const bool mean_dilatation;
  std::vector<dealii::Tensor<1, dim>> means;
};

/** Forces and row sums of the mass matrix as deal.II integrates them. */
template <int dim>
void assemble(const TestMesh<dim> &mesh,
              const std::vector<ElasticPhase<dim>> &phases,
              const std::vector<double> &u,
              std::vector<double> &f,
              std::vector<double> &mass)
{
  const bool simplices = mesh.cells[0].vertices.size() == dim + 1;
  const dealii::FE_Q<dim> fe_q(1);
  const dealii::FE_SimplexP<dim> fe_p(1);
  const dealii::FiniteElement<dim> &fe =
    simplices ? static_cast<const dealii::FiniteElement<dim> &>(fe_p) : fe_q;
  dealii::Triangulation<dim> tria;
  tria.create_triangulation(mesh.points, to_dealii<dim>(mesh.cells), {});
  dealii::DoFHandler<dim> dofs(tria);
  dofs.distribute_dofs(fe);
  const dealii::MappingFE<dim> mapping(fe);
  const dealii::Quadrature<dim> quadrature =
    simplices ? static_cast<dealii::Quadrature<dim>>(dealii::QGaussSimplex<dim>(2))
              : static_cast<dealii::Quadrature<dim>>(dealii::QGauss<dim>(2));
  dealii::FEValues<dim> values(mapping, fe, quadrature,
                               dealii::update_values | dealii::update_gradients |
                                 dealii::update_JxW_values);
  f.assign(u.size(), 0.);
  mass.assign(mesh.points.size(), 0.);
  for (const auto &cell : dofs.active_cell_iterators())
    {
      values.reinit(cell);
      const ElasticPhase<dim> &phase = phases[cell->material_id()];
      const Gradients<dim> gradients(values, phase.mean_dilatation);
      for (const unsigned int q : values.quadrature_point_indices())
        {
          dealii::Tensor<2, dim> grad, stress;
          for (const unsigned int i : values.dof_indices())
            for (unsigned int c = 0; c < dim; ++c)
              grad += u[dim * cell->vertex_index(i) + c] * gradients(i, c, q);
          VoigtVector<dim> e;
          const auto index = [](const unsigned int i, const unsigned int j) {
            return i == j ? i : dim == 2 ? 2 : 6 - i - j;
          };
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = i; j < dim; ++j)
              e[index(i, j)] = i == j ? grad[i][i] : grad[i][j] + grad[j][i];
          const VoigtVector<dim> s = phase.stiffness * e;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              stress[i][j] = s[index(i, j)];
          for (const unsigned int i : values.dof_indices())
            {
              for (unsigned int c = 0; c < dim; ++c)
                f[dim * cell->vertex_index(i) + c] +=
                  scalar_product(stress, gradients(i, c, q)) * values.JxW(q);
              mass[cell->vertex_index(i)] +=
                phase.density * values.shape_value(i, q) * values.JxW(q);
            }
        }
    }
}

/** The product of an operator whose cells are in two parts. */
template <int dim>
std::vector<double> product(const TestMesh<dim> &mesh,
                            const std::vector<ElasticPhase<dim>> &phases,
                            const std::vector<double> &u,
                            const InstructionSet isa,
                            std::size_t &n_congruent)
{
  std::vector<typename ElementOperator<dim>::Cells> parts(2);
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
    parts[k < 7].push_back(mesh.cells[k]);
  const ElementOperator<dim> op(mesh.points, parts, phases, isa);
  n_congruent          = op.n_congruent_cells();
  LineVector<double> x = op.zero_field(), y = op.zero_field();
  const unsigned int stride = kernels::node_stride<dim>;
  for (std::size_t k = 0; k < u.size(); ++k)
    x[k / dim * stride + k % dim] = u[k];
  for (unsigned int part = 0; part < 2; ++part)
    op.add_product(part, y.data(), x.data());
  std::vector<double> f(u.size());
  for (std::size_t k = 0; k < u.size(); ++k)
    f[k] = y[k / dim * stride + k % dim];
  for (std::size_t k = mesh.points.size() * stride; k < y.size(); ++k)
    EXPECT_EQ(y[k], 0.);
  return f;
}

template <int dim>
void compare(const unsigned int n)
{
  std::mt19937 generator(5);
  std::uniform_real_distribution<> random(-1., 1.);
  for (const bool simplices : {false, true})
    for (const double shift : {0., simplices ? 0.05 : 0.2})
      for (const auto &[anisotropic, mean_dilatation] :
           {std::pair(false, false), {true, false}, {false, true}, {true, true}})
        {
          const auto mesh   = make_mesh<dim>(n, simplices, shift);
          const auto phases = make_phases<dim>(anisotropic, mean_dilatation);
          std::vector<double> u(mesh.points.size() * dim), expected, mass;
          for (double &x : u)
            x = random(generator);
          assemble(mesh, phases, u, expected, mass);
          const auto own_mass = lumped_mass(mesh.points, mesh.cells, phases);
          for (std::size_t k = 0; k < mass.size(); ++k)
            ASSERT_NEAR(own_mass[k], mass[k], 1e-14);
          double scale = 0.;
          for (const double x : expected)
            scale = std::max(scale, std::abs(x));
          for (const InstructionSet isa : available_instruction_sets())
            {
              SCOPED_TRACE(to_string(isa) + (simplices ? ", simplices" : "") +
                           (anisotropic ? ", anisotropic" : "") +
                           (mean_dilatation ? ", mean dilatation" : "") +
                           (shift > 0. ? ", distorted" : ""));
              std::size_t n_congruent = 0;
              const auto f            = product(mesh, phases, u, isa, n_congruent);
              EXPECT_EQ(n_congruent > 0, shift == 0.);
              for (std::size_t k = 0; k < f.size(); ++k)
                ASSERT_NEAR(f[k], expected[k], 4e-14 * scale);
            }
        }
}
} // namespace

// Every second point of every second row moved: four shapes, each of many congruent cells.
TEST(ElementOperator, SharesNoMatrixOfCongruentCellsThatAreNoParallelograms)
{
  constexpr unsigned int n = 40;
  auto mesh                = make_mesh<2>(n, false, 0.);
  for (auto &p : mesh.points)
    {
      const auto row    = std::lround(p[1] * n);
      const auto column = std::lround((p[0] - 0.3 * p[1]) * n);
      p[0] += row % 2 == 1 && column % 2 == 1 ? 0.2 / n : 0.;
    }
  const auto phases = make_phases<2>(true);
  std::vector<double> u(mesh.points.size() * 2), expected, mass;
  for (std::size_t k = 0; k < u.size(); ++k)
    u[k] = std::sin(static_cast<double>(k * k));
  assemble(mesh, phases, u, expected, mass);
  std::size_t n_congruent = 0;
  const auto f = product(mesh, phases, u, InstructionSet::automatic, n_congruent);
  EXPECT_EQ(n_congruent, 0U);
  for (std::size_t k = 0; k < f.size(); ++k)
    ASSERT_NEAR(f[k], expected[k], 1e-13);
}

TEST(ElementOperator, EqualsAssembledMatrixInThePlane)
{
  compare<2>(23);
}

TEST(ElementOperator, EqualsAssembledMatrixInSpace)
{
  compare<3>(9);
}
