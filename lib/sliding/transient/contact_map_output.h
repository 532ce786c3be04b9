#ifndef mesoslip_sliding_transient_contact_map_output_h
#define mesoslip_sliding_transient_contact_map_output_h

#include "contact/contact_map.h"
#include "dynamics/stepper.h"
#include "io/hdf5_file.h"
#include "sliding/body_size.h"

#include <cstdint>
#include <functional>
#include <mpi.h>
#include <string>
#include <vector>

namespace mesoslip
{
/** Group of the map in dynamics.h5. */
extern const char contact_map_group[];

/**
 * The map of the contact over time in dynamics.h5: as an observer it takes what the nodes
 * of all ranks sampled every so many steps, so that they keep a few megabytes at most, and
 * hands rank 0 whole rows in the order of the contact. Its state between two steps follows
 * from the number of the step once drain() was called.
 */
template <int dim>
class ContactMapOutput : public StepObserver
{
public:
  /**
   * Takes rows of numbers for dataset @p name from row @p first on; @p values are on rank
   * 0, elsewhere empty. All ranks call it.
   */
  using Sink = std::function<void(
    const std::string &name, const std::size_t first, const std::vector<double> &values)>;

  /**
   * Of the samples of @p sampler, that of this rank, whose nodes are number @p places of
   * the contact; empty on a rank without any. All arguments must outlive it.
   */
  ContactMapOutput(const ContactMapSetup &setup,
                   ContactMapSampler<dim> &sampler,
                   const std::vector<unsigned int> &places,
                   const BodySize &size,
                   const MPI_Comm communicator);

  /** On rank 0: makes place in @p file for all samples of a run of @p n_steps. */
  void reserve(Hdf5File &file, const std::uint64_t n_steps) const;

  /** The names of the datasets. */
  std::vector<std::string> datasets() const;

  /** Goes on before step @p n, where all samples before it are in the file already. */
  void begin(const std::uint64_t n, const Sink &rows)
  {
    n_written = setup.count(n);
    write     = rows;
  }

  std::uint64_t next_step(const std::uint64_t n) const override;
  void before_step(const std::uint64_t n) override
  {
    drain(n);
  }

  /** Hands on all samples of the steps before @p n. Collective. */
  void drain(const std::uint64_t n);

  /** On rank 0, after drain(): @p file is complete with the samples before step @p n of
   * @p dt seconds. */
  void complete(Hdf5File &file, const std::uint64_t n, const double dt) const;

private:
  std::vector<double> whole_rows(const MapField &field,
                                 const std::vector<std::vector<double>> &of_ranks,
                                 const std::size_t n_rows) const;
  Shape shape(const MapField &field, const std::uint64_t n_rows) const;

  const ContactMapSetup setup;
  ContactMapSampler<dim> &sampler;
  const BodySize &size;
  const MPI_Comm communicator;
  const std::uint64_t rows_together; ///< in the buffer and in a chunk of the file
  std::vector<std::vector<unsigned int>> places; ///< of all ranks, on rank 0
  std::uint64_t n_written = 0;
  Sink write;
};
} // namespace mesoslip

#endif
