/**
 * Benchmark of a contact step on meshes: its time, its memory, and the time of a program
 * without a kernel (product with a Trilinos CSR matrix and update of the nodes).
 *
 *     [mpirun -np n] mesh_benchmark <kind>:<cells along an edge>...
 *
 * Kinds: quadrilaterals, triangles, hexahedra, tetrahedra with randomly shifted inner
 * points, and congruent-quadrilaterals etc. of a grid. Squares and cubes are cut into 8
 * triangles or 24 tetrahedra. Each argument gives one line of CSV: wall-clock seconds of
 * a step, median, lowest and highest, alternating between rank 0 alone, its matrix, all
 * ranks together, and all ranks with one body each, which is the bound for shared memory.
 */
#include "matrix_step.h"
#include "measuring.h"
#include "verification/mesh_sliding/mesh_sliding.h"

#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

using namespace verification;

namespace
{
constexpr unsigned int repetitions = 15;
constexpr unsigned int steps       = 10; ///< steps per repetition

struct Kind
{
  unsigned int dim = 2;
  Cells cells;
};

const std::map<std::string, Kind> kinds = {
  {"quadrilaterals", {2, {false, 0.2}}}, {"congruent-quadrilaterals", {2, {false, 0.}}},
  {"triangles", {2, {true, 0.05}}},      {"congruent-triangles", {2, {true, 0.}}},
  {"hexahedra", {3, {false, 0.2}}},      {"congruent-hexahedra", {3, {false, 0.}}},
  {"tetrahedra", {3, {true, 0.05}}},     {"congruent-tetrahedra", {3, {true, 0.}}}};

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

/** Resident memory of this process (bytes); Linux. */
double resident_bytes()
{
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("VmRSS:", 0) == 0)
      return 1024. * std::stod(line.substr(6));
  return 0.;
}

/** ",median,lowest,highest". */
std::string text(std::vector<double> seconds)
{
  std::sort(seconds.begin(), seconds.end());
  char line[99];
  std::snprintf(line, sizeof line, ",%.6g,%.6g,%.6g", seconds[seconds.size() / 2],
                seconds.front(), seconds.back());
  return line;
}

template <int dim>
void run_kind(const std::string &name, const unsigned int n, const Cells &cells)
{
  const MeshCase<dim> c = make_case<dim>(n, cells);
  const double before   = resident_bytes();
  MeshRun<dim> all(c, MPI_COMM_WORLD);
  const double bytes   = resident_bytes() - before;
  const unsigned ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  MeshRun<dim> own(c, MPI_COMM_SELF);
  std::unique_ptr<MatrixStep<dim>> matrix;
  if (rank() == 0)
    matrix = std::make_unique<MatrixStep<dim>>(c);

  const auto advance = [](MeshRun<dim> &run) { run.body.stepper.advance(steps); };
  const std::vector<std::function<void()>> turns = {
    [&]() { rank() == 0 ? advance(own) : void(); },
    [&]() {
      for (unsigned int k = 0; k < steps && matrix; ++k)
        matrix->advance();
    },
    [&]() { advance(all); }, [&]() { advance(own); }};
  std::vector<std::vector<double>> seconds(turns.size());
  for (unsigned int r = 0; r < repetitions; ++r)
    for (std::size_t k = 0; k < turns.size(); ++k)
      seconds[k].push_back(measure(turns[k], 1)[0] / steps);

  const MeshPart<dim> &part = all.part;
  std::size_t n_sent        = 0;
  for (const auto &neighbour : part.neighbours)
    n_sent += neighbour.points.size();
  const std::size_t sent = dealii::Utilities::MPI::max(n_sent, MPI_COMM_WORLD);
  const double largest   = dealii::Utilities::MPI::max(bytes, MPI_COMM_WORLD);
  const unsigned contact =
    dealii::Utilities::MPI::max(all.body.contact_nodes.n_owned(), MPI_COMM_WORLD);
  if (rank() == 0)
    std::printf("%s,%d,%zu,%zu,%u,%zu,%zu,%u,%.0f%s%s%s%s\n", name.c_str(), dim,
                c.mesh.cells.size(), c.mesh.points.size(), ranks, sent,
                c.side(2 * (dim - 1)).points.size(), contact, largest,
                text(seconds[0]).c_str(), text(seconds[1]).c_str(),
                text(seconds[2]).c_str(), text(seconds[3]).c_str());
  std::fflush(stdout);
}

int run(int argc, char **argv)
{
  if (rank() == 0)
    {
      std::printf(
        "kind,dim,cells,points,ranks,points_sent,contact_nodes,contact_nodes_a_rank,"
        "bytes_a_rank");
      for (const char *what : {"one_rank", "matrix", "all_ranks", "side_by_side"})
        std::printf(",%s_s,%s_s_low,%s_s_high", what, what, what);
      std::printf("\n");
    }
  for (int k = 1; k < argc; ++k)
    {
      const std::string argument = argv[k];
      const auto colon           = argument.find(':');
      const auto kind            = kinds.find(argument.substr(0, colon));
      if (kind == kinds.end() || colon == std::string::npos)
        throw std::runtime_error("not a kind and a number of cells: " + argument);
      const unsigned int n = std::stoi(argument.substr(colon + 1));
      if (kind->second.dim == 2)
        run_kind<2>(kind->first, n, kind->second.cells);
      else
        run_kind<3>(kind->first, n, kind->second.cells);
    }
  return 0;
}
} // namespace

int main(int argc, char **argv)
{
  return mesoslip::guarded_main(argc, argv, "mesh_benchmark", run);
}
