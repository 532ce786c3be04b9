#include "contact/pair/surface_values.h"

#include "base/exchange.h"

#include <algorithm>

namespace mesoslip
{
SurfaceValues::SurfaceValues(const NodesOfContact &nodes,
                             const unsigned int n_rows,
                             const MPI_Comm communicator)
  : owned(nodes.number.begin(), nodes.number.begin() + nodes.n_owned)
  , communicator(communicator)
{
  for (const std::vector<unsigned int> &of_rank : mpi::all_gather(owned, communicator))
    {
      starts.push_back(static_cast<int>(n_rows * of_ranks.size()));
      counts.push_back(static_cast<int>(n_rows * of_rank.size()));
      of_ranks.insert(of_ranks.end(), of_rank.begin(), of_rank.end());
    }
  own.resize(n_rows * owned.size());
  all.resize(n_rows * of_ranks.size());
  whole = NodalField<double>::of_points(of_ranks.size(), n_rows);
}

void SurfaceValues::set(const unsigned int r, const double *values)
{
  if (counts.size() > 1)
    std::copy_n(values, owned.size(), own.begin() + r * owned.size());
  else
    for (std::size_t i = 0; i < owned.size(); ++i)
      whole.row(r, 0)[owned[i]] = values[i];
}

void SurfaceValues::share()
{
  if (counts.size() == 1)
    return;
  all_gather(own, counts, starts, all, communicator);
  std::size_t first = 0;
  for (std::size_t rank = 0; rank < counts.size(); ++rank)
    {
      const double *values = all.data() + starts[rank];
      const std::size_t n  = counts[rank] / whole.n_components();
      for (unsigned int r = 0; r < whole.n_components(); ++r)
        for (std::size_t i = 0; i < n; ++i)
          whole.row(r, 0)[of_ranks[first + i]] = *values++;
      first += n;
    }
}
} // namespace mesoslip
