#include "dynamics/grid/explicit_stepper.h"
#include "elasticity/uniform_grid_operator.h"
#include "elasticity_testing.h"
#include "grid/halo.h"
#include "grid/row_partition.h"

#include <gtest/gtest.h>

using namespace elasticity_testing;

namespace
{
/** The recursion of doc/theory.md, section 2, on the reference product. */
void naive_step(const UniformMaterial &material,
                const StepParameters &p,
                const SideConstraints &sides,
                NodalField<double> &u,
                NodalField<double> &w)
{
  NodalField<double> z(u);
  for (std::size_t k = 0; k < z.size(); ++k)
    z.begin()[k] += p.beta * w.begin()[k];
  const NodalField<double> f = reference_product(material, z);
  const unsigned int last    = u.n_columns() - 1;
  std::vector<double> mass(last + 1);
  for (unsigned int j = 0; j < u.n_rows(); ++j)
    {
      material.mass_row(j, mass.data());
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int i = 0; i <= last; ++i)
          {
            const bool held =
              (i == 0 && sides.left_held[c]) || (i == last && sides.right_held[c]);
            const double a = held ? 0. : p.acceleration[c] - f.row(c, j)[i] / mass[i];
            double &wi     = w.row(c, j)[i];
            wi += p.dt * a;
            u.row(c, j)[i] += p.dt * wi + (p.beta2 - 0.5) * p.dt * p.dt * a;
          }
    }
}

struct State
{
  NodalField<double> u, w;
};

State random_state(Random &random, const UniformMaterial &material)
{
  State s{NodalField<double>(material.n_columns(), material.n_rows()),
          NodalField<double>(material.n_columns(), material.n_rows())};
  random.fill(s.u);
  random.fill(s.w);
  material.update_copies(s.u);
  material.update_copies(s.w);
  return s;
}

State advanced(const UniformMaterial &material,
               const StepParameters &p,
               const SideConstraints &sides,
               const State &start,
               const SweepOptions &options,
               const unsigned int n_steps)
{
  State s = start;
  ExplicitStepper stepper({material, p, s.u, s.w}, sides, options);
  stepper.advance(n_steps);
  EXPECT_EQ(stepper.step_number(), n_steps);
  return s;
}

/** Records how it was called; pushes with a constant force. */
struct PushingRow : FreeSurface<2>
{
  explicit PushingRow(const StepParameters &p)
    : FreeSurface(p)
  {
  }

  void advance(const SurfaceView<2> &surface) override
  {
    steps.push_back(surface.step);
    times.push_back(surface.time);
    std::vector<double> fy(surface.force[1], surface.force[1] + surface.n);
    for (double &f : fy)
      f -= 0.01 * (1. + surface.step);
    SurfaceView<2> pushed = surface;
    pushed.force[1]       = fy.data();
    FreeSurface::advance(pushed);
  }

  std::vector<std::uint64_t> steps;
  std::vector<double> times;
};
} // namespace

TEST(ExplicitStepper, EqualsTheNaiveRecursion)
{
  Random random;
  SCOPED_TRACE(seed);
  constexpr unsigned int n_steps = 11;
  for (const InstructionSet isa : available_instruction_sets())
    for (const unsigned int n_classes : {1, 2, 6, 12, 40})
      for (const auto &cells : shapes())
        for (unsigned int flags = 0; flags < 32; ++flags)
          {
            const bool anisotropic = flags & 1, periodic = flags & 8;
            const UniformMaterial material =
              random_material(random, cells, n_classes, anisotropic, flags & 16,
                              Periodicity{periodic, false});
            StepParameters p;
            p.dt    = 0.05;
            p.beta2 = 0.8;
            p.beta  = flags & 2 ? 0.02 : 0.;
            if (flags & 4)
              p.acceleration = {{0.1, -0.3}};
            SideConstraints sides;
            if (!periodic && n_classes % 2 == 0)
              {
                sides.left_held  = {{true, false}};
                sides.right_held = {{true, true}};
              }
            const State start = random_state(random, material);
            SweepOptions options;
            options.isa           = isa;
            options.steps_at_once = 1;
            const State plain     = advanced(material, p, sides, start, options, n_steps);
            options.steps_at_once = 2 + (flags + cells[1]) % 9;
            const State in_wave   = advanced(material, p, sides, start, options, n_steps);
            State naive           = start;
            for (unsigned int k = 0; k < n_steps; ++k)
              naive_step(material, p, sides, naive.u, naive.w);
            ASSERT_LT(largest_difference(naive.u, plain.u), 2e-12)
              << to_string(isa) << " classes " << n_classes << " cells " << cells[0]
              << "x" << cells[1] << " flags " << flags;
            ASSERT_LT(largest_difference(naive.w, plain.w), 2e-12);
            ASSERT_TRUE(equal_bits(plain.u, in_wave.u) && equal_bits(plain.w, in_wave.w))
              << "steps at once " << options.steps_at_once << " cells " << cells[0] << "x"
              << cells[1];

            options.single_precision = true;
            const State single    = advanced(material, p, sides, start, options, n_steps);
            options.steps_at_once = 1;
            const State one_by_one =
              advanced(material, p, sides, start, options, n_steps);
            ASSERT_TRUE(equal_bits(single.u, one_by_one.u) &&
                        equal_bits(single.w, one_by_one.w));
            ASSERT_LT(largest_difference(naive.u, single.u), 2e-5);
            ASSERT_LT(largest_difference(naive.w, single.w), 2e-5);
          }
}

TEST(ExplicitStepper, BoundariesOncePerStepInOrder)
{
  Random random;
  const UniformMaterial material = random_material(random, {{19, 23}}, 3, false, true);
  StepParameters p;
  p.dt              = 0.05;
  const State start = random_state(random, material);
  State plain       = start;
  for (const unsigned int depth : {1, 5, 16})
    {
      State s = start;
      PushingRow bottom(p), top(p);
      SweepOptions options;
      options.steps_at_once = depth;
      ExplicitStepper stepper({material, p, s.u, s.w, &bottom, &top}, {}, options);
      EXPECT_EQ(stepper.steps_at_once(), depth);
      stepper.set_step_number(3);
      stepper.advance(38);
      stepper.step();
      for (const PushingRow *row : {&bottom, &top})
        {
          ASSERT_EQ(row->steps.size(), 39u);
          for (unsigned int k = 0; k < 39; ++k)
            {
              EXPECT_EQ(row->steps[k], k + 3);
              EXPECT_EQ(row->times[k], (k + 3) * p.dt);
            }
        }
      if (depth == 1)
        plain = s;
      EXPECT_TRUE(equal_bits(plain.u, s.u) && equal_bits(plain.w, s.w));
    }
}

TEST(ExplicitStepper, RefusesWhatDoesNotFit)
{
  Random random;
  const UniformMaterial material = random_material(random, {{4, 4}}, 1, false, true);
  NodalField<double> u(5, 5), w(5, 5), wrong(4, 5);
  StepParameters p;
  EXPECT_THROW(ExplicitStepper({material, p, u, w}), std::invalid_argument);
  p.dt = 0.1;
  EXPECT_THROW(ExplicitStepper({material, p, u, wrong}), std::invalid_argument);
  const UniformMaterial torus =
    random_material(random, {{4, 4}}, 1, false, true, Periodicity{true, true});
  EXPECT_THROW(ExplicitStepper({torus, p, u, w}), std::invalid_argument);
}

namespace
{
/** The rows of a slab, ghost rows included. */
NodalField<double> slab_of(const NodalField<double> &whole, const NodeRows &rows)
{
  NodalField<double> slab(whole.n_columns(), rows.n_local());
  std::copy_n(whole.row(0, rows.first()), rows.n_local() * whole.stride(),
              slab.row(0, 0));
  return slab;
}

/** Numbers of ghost rows that slabs have room for. */
std::vector<unsigned int> ghost_rows(const unsigned int n_rows)
{
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  std::vector<unsigned int> numbers = {1, 2, 3, 4, 7};
  while (numbers.back() > n_rows / size)
    numbers.pop_back();
  return numbers;
}
} // namespace

TEST(Partition, AnErrorOnOneRankDoesNotWaitForTheOthers)
{
  int rank = 0, n_ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  if (n_ranks == 1)
    return;
  const auto fail_on_last = [&]() {
    const MPIHalo halo(8, 1, MPI_COMM_WORLD);
    if (rank == n_ranks - 1)
      throw std::runtime_error("an error");
    MPI_Barrier(MPI_COMM_WORLD); // the last one comes here as well, when its halo is gone
    throw std::runtime_error("now here as well");
  };
  EXPECT_THROW(fail_on_last(), std::runtime_error);
  if (rank == n_ranks - 1)
    MPI_Barrier(MPI_COMM_WORLD);
}

namespace
{
/** Slabs on any number of ranks move as the whole body, bit for bit. */
void expect_equal_slabs(const SweepOptions &options)
{
  const MPI_Comm world = MPI_COMM_WORLD;
  Random random;
  for (const auto &cells : {std::array<unsigned int, 2>{{37, 13}}, {{16, 7}}, {{64, 50}}})
    {
      const UniformMaterial material =
        random_material(random, cells, cells[1] % 3 + 1, true, cells[0] == 16);
      StepParameters p;
      p.dt           = 0.05;
      p.beta         = 0.01;
      p.beta2        = 0.6;
      p.acceleration = {{0.02, 0.1}};
      SideConstraints sides;
      sides.left_held   = {{true, false}};
      const State start = random_state(random, material);
      State serial      = start;
      PushingRow bottom(p), top(p);
      SweepOptions plain  = options;
      plain.steps_at_once = 1;
      ExplicitStepper({material, p, serial.u, serial.w, &bottom, &top}, sides, plain)
        .advance(30);

      for (const unsigned int ghosts : ghost_rows(material.n_rows()))
        {
          SCOPED_TRACE(std::to_string(cells[1]) + " rows of cells, ghost rows " +
                       std::to_string(ghosts));
          const unsigned int columns = material.n_columns();
          const NodeRows rows        = partition_rows(material.n_rows(), world, ghosts);
          State slab{slab_of(start.u, rows), slab_of(start.w, rows)};
          MPIHalo halo(columns, rows.ghosts, world);
          PushingRow slab_bottom(p), slab_top(p);
          ExplicitStepper stepper(
            {material, p, slab.u, slab.w, &slab_bottom, &slab_top, rows, &halo, world},
            sides, options);
          stepper.advance(17);
          stepper.step();
          stepper.advance(12);
          EXPECT_EQ(slab_bottom.steps.size(), rows.has_lower_ghost() ? 0u : 30u);
          EXPECT_EQ(slab_top.steps.size(), rows.has_upper_ghost() ? 0u : 30u);

          update_ghost_rows(slab.u, rows, world);
          const unsigned int first = rows.begin - (rows.has_lower_ghost() ? 1 : 0);
          const unsigned int last  = rows.end + (rows.has_upper_ghost() ? 1 : 0);
          for (unsigned int c = 0; c < 2; ++c)
            for (unsigned int j = first; j < last; ++j)
              for (unsigned int i = 0; i < columns; ++i)
                ASSERT_EQ(slab.u.row(c, rows.local(j))[i], serial.u.row(c, j)[i]);
          const NodalField<double> w = gather_rows(slab.w, rows, world);
          if (w.size() > 0)
            {
              EXPECT_TRUE(equal_bits(w, serial.w));
            }
        }
    }
}
} // namespace

TEST(Partition, AnyNumberOfRanksAndStepsInFlightBitForBit)
{
  expect_equal_slabs({});
}

TEST(Partition, AnyNumberOfRanksInSinglePrecisionBitForBit)
{
  SweepOptions options;
  options.single_precision = true;
  expect_equal_slabs(options);
}

TEST(Partition, AfterOneStepTheNearestGhostRowsHoldTheStateBeforeIt)
{
  const MPI_Comm world = MPI_COMM_WORLD;
  Random random;
  const UniformMaterial material = random_material(random, {{19, 23}}, 2, false, true);
  StepParameters p;
  p.dt              = 0.05;
  const State start = random_state(random, material);
  State before      = start;
  ExplicitStepper({material, p, before.u, before.w}).advance(5);
  for (const unsigned int ghosts : ghost_rows(material.n_rows()))
    {
      const unsigned int columns = material.n_columns();
      const NodeRows rows        = partition_rows(material.n_rows(), world, ghosts);
      State slab{slab_of(start.u, rows), slab_of(start.w, rows)};
      MPIHalo halo(columns, rows.ghosts, world);
      ExplicitStepper stepper(
        {material, p, slab.u, slab.w, nullptr, nullptr, rows, &halo, world});
      stepper.advance(5);
      stepper.step();
      const auto expect_before = [&](const unsigned int j) {
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int i = 0; i < columns; ++i)
            {
              ASSERT_EQ(slab.u.row(c, rows.local(j))[i], before.u.row(c, j)[i]);
              ASSERT_EQ(slab.w.row(c, rows.local(j))[i], before.w.row(c, j)[i]);
            }
      };
      if (rows.has_lower_ghost())
        expect_before(rows.begin - 1);
      if (rows.has_upper_ghost())
        expect_before(rows.end);
    }
}
