// Contact steps on meshes: cells a second on one rank, against the product with a Trilinos
// matrix (CSR) and the update of the nodes, and on all ranks against one.
//
//     mpirun -np 2 build/tests/mesh_benchmark [cells along an edge in 2D] [in 3D]

#include "../verification/mesh_sliding.h"
#include "measuring.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <cstdlib>

using namespace verification;

namespace
{
struct Kind
{
  const char *name;
  Cells cells;
};

template <int dim>
MeshCase<dim> make_case(const unsigned int n, const Cells &cells)
{
  MeshCase<dim> c;
  std::array<unsigned int, dim> numbers;
  std::array<double, dim> size;
  numbers.fill(n);
  size.fill(0.1);
  c.mesh = brick<dim>(numbers, size, cells);
  for (std::size_t k = 0; k < c.mesh.cells.size(); ++k)
    c.mesh.cells[k].material_id = k % 7 == 2;
  c.phases                      = two_phases<dim>();
  c.friction                    = 0.3;
  c.setup.step.dt               = 1e-10;
  c.setup.top.pressure          = LoadHistory(1e6);
  c.setup.contact.flat_velocity = LoadHistory(1.);
  c.setup.history_interval      = 0;
  return c;
}

/** The least of some times for a step (s), each over @p n steps. */
template <int dim>
double
seconds_a_step(const MeshCase<dim> &c, const MPI_Comm communicator, const bool works)
{
  constexpr unsigned int n = 20;
  std::unique_ptr<MeshRun<dim>> run;
  if (works)
    run = std::make_unique<MeshRun<dim>>(c, communicator);
  return measure(
           [&]() {
             if (run)
               run->body.stepper.advance(n);
           },
           7)[0] /
         n;
}

/** The same for a matrix of the same couplings, and the update of u and w. */
template <int dim>
double seconds_of_matrix(const MeshCase<dim> &c)
{
  const MeshPart<dim> part =
    distribute(c.mesh, std::vector<unsigned int>(c.mesh.cells.size()), MPI_COMM_SELF);
  const std::size_t n = dim * part.points.size();
  dealii::DynamicSparsityPattern couplings(n, n);
  for (const auto &cell : part.cells)
    for (const unsigned int v : cell.vertices)
      for (const unsigned int other : cell.vertices)
        for (unsigned int k = 0; k < dim * dim; ++k)
          couplings.add(dim * v + k / dim, dim * other + k % dim);
  dealii::TrilinosWrappers::SparseMatrix matrix;
  matrix.reinit(couplings);
  dealii::Vector<double> u(n), w(n), f(n), inverse_mass(n);
  return measure(
    [&]() {
      matrix.vmult(f, u);
      for (std::size_t k = 0; k < n; ++k)
        {
          w[k] -= 1e-10 * inverse_mass[k] * f[k];
          u[k] += 1e-10 * w[k];
        }
    },
    31)[0];
}

template <int dim>
void compare(const unsigned int n)
{
  const Kind kinds[] = {{"congruent", {false, 0.}},
                        {"distorted", {false, 0.2}},
                        {"congruent simplices", {true, 0.}},
                        {"distorted simplices", {true, 0.05}}};
  const int n_ranks =
    static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
  for (const Kind &kind : kinds)
    {
      const MeshCase<dim> c = make_case<dim>(n, kind.cells);
      const double millions = 1e-6 * static_cast<double>(c.mesh.cells.size());
      const double one      = seconds_a_step(c, MPI_COMM_SELF, rank() == 0);
      const double all      = n_ranks > 1 ? seconds_a_step(c, MPI_COMM_WORLD, true) : one;
      if (rank() != 0)
        {
          measure([]() {}, 31);
          continue;
        }
      const double csr = seconds_of_matrix(c);
      std::printf("%dD %-20s %8zu cells: %7.1f million cells/s, CSR %6.1f, ratio %5.2f",
                  dim, kind.name, c.mesh.cells.size(), millions / one, millions / csr,
                  csr / one);
      if (n_ranks > 1)
        std::printf("; %d ranks %7.1f, %5.2f times one", n_ranks, millions / all,
                    one / all);
      std::printf("\n");
    }
}

int run(int argc, char **argv)
{
  compare<2>(argc > 1 ? std::atoi(argv[1]) : 300);
  compare<3>(argc > 2 ? std::atoi(argv[2]) : 40);
  return 0;
}
} // namespace

int main(int argc, char **argv)
{
  return mesoslip::guarded_main(argc, argv, "mesh_benchmark", run);
}
