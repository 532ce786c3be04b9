#include "localization/mesh/strain_source.h"

#include "base/exchange.h"

#include <algorithm>

namespace mesoslip
{
template <int dim>
StrainSource<dim>::StrainSource(const Mesh<dim> &of_root,
                                const PlacesInCells<dim> &given,
                                const MPI_Comm the_communicator)
  : communicator(the_communicator)
  , places(given.at)
{
  const bool is_root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  // Whole on all ranks while the cells near to the places are looked for.
  Mesh<dim> received;
  if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
    {
      auto parts = std::make_pair(of_root.points, of_root.cells);
      broadcast_object(communicator, parts);
      received.points = std::move(parts.first);
      received.cells  = std::move(parts.second);
    }
  const Mesh<dim> &mesh            = is_root ? of_root : received;
  std::vector<unsigned int> wanted = given.cell;
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  for (const unsigned int cell : given.cell)
    wanted_cell.push_back(std::lower_bound(wanted.begin(), wanted.end(), cell) -
                          wanted.begin());
  strain = std::make_unique<CellStrain<dim>>(mesh, wanted);
  displacement.resize(mesh.points.size() * dim);
  if (is_root)
    mean_of_body = std::make_unique<MeanStrain<dim>>(mesh);
}

template <int dim>
void StrainSource<dim>::set_displacement(const std::vector<double> &u)
{
  if (mean_of_body)
    {
      AssertDimension(u.size(), displacement.size());
      displacement = u;
      mean_strain  = (*mean_of_body)(u);
    }
  if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
    {
      dealii::Utilities::MPI::broadcast(displacement.data(), displacement.size(), 0,
                                        communicator);
      dealii::Utilities::MPI::broadcast(mean_strain.data(),
                                        static_cast<std::size_t>(mean_strain.size()), 0,
                                        communicator);
    }
  strain->set_displacement(displacement);
}

template class StrainSource<2>;
template class StrainSource<3>;
} // namespace mesoslip
