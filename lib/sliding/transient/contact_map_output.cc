#include "sliding/transient/contact_map_output.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "exchange/datasets.h"

#include <algorithm>
#include <cstring>
#include <deal.II/base/exceptions.h>
#include <limits>

namespace mesoslip
{
const char contact_map_group[] = "/contact_map";

namespace
{
/** Numbers of one field in the buffer, all ranks together. */
constexpr std::uint64_t numbers_together = 1U << 17;

std::string map_dataset(const MapField &field)
{
  return std::string(contact_map_group) + "/" + field.name;
}

/** Arrays of all ranks on rank 0, elsewhere empty; raw bytes, not compressed. */
std::vector<std::vector<double>> gather_numbers(const std::vector<double> &own,
                                                const MPI_Comm communicator)
{
  const std::string bytes(reinterpret_cast<const char *>(own.data()),
                          own.size() * sizeof(double));
  std::vector<std::vector<double>> numbers;
  for (const std::string &of_rank : gather(communicator, bytes))
    {
      numbers.emplace_back(of_rank.size() / sizeof(double));
      std::memcpy(numbers.back().data(), of_rank.data(), of_rank.size());
    }
  return numbers;
}
} // namespace

template <int dim>
ContactMapOutput<dim>::ContactMapOutput(const ContactMapSetup &setup,
                                        ContactMapSampler<dim> &sampler,
                                        const std::vector<unsigned int> &places,
                                        const BodySize &size,
                                        const MPI_Comm communicator)
  : setup(setup)
  , sampler(sampler)
  , size(size)
  , communicator(communicator)
  , rows_together(
      std::clamp<std::uint64_t>(numbers_together / size.friction.size(), 1, 1024))
  , places(mpi::gather(places, communicator))
{
}

template <int dim>
Shape ContactMapOutput<dim>::shape(const MapField &field,
                                   const std::uint64_t n_rows) const
{
  Shape shape = {n_rows, size.friction.size()};
  if (field.components > 1)
    shape.push_back(field.components);
  return shape;
}

template <int dim>
void ContactMapOutput<dim>::reserve(Hdf5File &file, const std::uint64_t n_steps) const
{
  if (setup.count(n_steps) == 0)
    throw UserError(
      "Contact map/From lies behind the last step, so that there would be no "
      "sample; set it earlier, or Interval = 0");
  for (const MapField &field : setup.fields(dim))
    file.reserve_rows(
      map_dataset(field), shape(field, setup.count(n_steps)), rows_together,
      field.quantity == MapQuantity::state ? StoredNumber::byte : StoredNumber::float64);
}

template <int dim>
std::vector<std::string> ContactMapOutput<dim>::datasets() const
{
  std::vector<std::string> names;
  for (const MapField &field : setup.fields(dim))
    names.push_back(map_dataset(field));
  return names;
}

// Due after each sample that fills the buffer.
template <int dim>
std::uint64_t ContactMapOutput<dim>::next_step(const std::uint64_t n) const
{
  const std::uint64_t behind    = n > setup.first + 1 ? n - 1 - setup.first : 0,
                      n_samples = (behind + setup.interval - 1) / setup.interval + 1;
  const std::uint64_t full      = (n_samples + rows_together - 1) / rows_together,
                      last = setup.first + (full * rows_together - 1) * setup.interval;
  return last < setup.end ? last + 1 : std::numeric_limits<std::uint64_t>::max();
}

template <int dim>
void ContactMapOutput<dim>::drain(const std::uint64_t n)
{
  const std::uint64_t n_rows                     = setup.count(n) - n_written;
  const std::vector<std::vector<double>> samples = sampler.take();
  const std::vector<MapField> fields             = setup.fields(dim);
  if (n_rows == 0)
    return;
  for (std::size_t f = 0; f < fields.size(); ++f)
    {
      const auto of_ranks = gather_numbers(samples[f], communicator);
      write(map_dataset(fields[f]), n_written,
            of_ranks.empty() ? std::vector<double>()
                             : whole_rows(fields[f], of_ranks, n_rows));
    }
  n_written += n_rows;
}

template <int dim>
std::vector<double>
ContactMapOutput<dim>::whole_rows(const MapField &field,
                                  const std::vector<std::vector<double>> &of_ranks,
                                  const std::size_t n_rows) const
{
  const std::size_t n = size.friction.size(), n_components = field.components;
  std::vector<double> whole(n_rows * n * n_components);
  const auto at = [&](const std::size_t row, const std::size_t node) {
    return whole.data() + (row * n + node) * n_components;
  };
  for (std::size_t rank = 0; rank < of_ranks.size(); ++rank)
    {
      const std::vector<unsigned int> &of_rank = places[rank];
      AssertThrow(of_ranks[rank].size() == n_rows * of_rank.size() * n_components,
                  dealii::ExcDimensionMismatch(of_ranks[rank].size(),
                                               n_rows * of_rank.size() * n_components));
      const double *value = of_ranks[rank].data();
      for (std::size_t row = 0; row < n_rows; ++row)
        for (const unsigned int node : of_rank)
          for (std::size_t c = 0; c < n_components; ++c)
            at(row, node)[c] = *value++ / (field.over_area ? size.area[node] : 1.);
    }
  // On a periodic grid the last node is a copy of the first.
  for (std::size_t row = 0; row < n_rows; ++row)
    for (std::size_t node = size.n_contact_nodes; node < n; ++node)
      std::copy_n(at(row, node - size.n_contact_nodes), n_components, at(row, node));
  return whole;
}

template <int dim>
void ContactMapOutput<dim>::complete(Hdf5File &file,
                                     const std::uint64_t n,
                                     const double dt) const
{
  std::vector<double> times;
  for (std::uint64_t k = 0; k < setup.count(n); ++k)
    times.push_back(static_cast<double>(setup.first + k * setup.interval) * dt);
  for (const MapField &field : setup.fields(dim))
    {
      file.reserve_rows(map_dataset(field), shape(field, times.size()));
      file.write_unit(map_dataset(field), field.unit);
      if (field.quantity == MapQuantity::state)
        file.write_attribute(map_dataset(field), "meaning",
                             std::string("0 separated, 1 stick, 2 slip"));
      if (field.quantity == MapQuantity::law_state)
        file.write_attribute(map_dataset(field), "meaning", setup.law_state.name);
    }
  write_series(file, contact_map_group, {{"time", "s", &times}});
}

template class ContactMapOutput<2>;
template class ContactMapOutput<3>;
} // namespace mesoslip
