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
 * The contact map over time in dynamics.h5. As an observer it collects the samples of
 * the nodes of all ranks every so many steps, so buffers stay below a few megabytes, and
 * hands rank 0 whole rows in the order of the contact. After drain() its state follows
 * from the step number.
 */
template <int dim>
class ContactMapOutput : public StepObserver
{
public:
  /**
   * Receives rows of numbers for dataset @p name from row @p first on; @p values are on
   * rank 0, elsewhere empty. Collective.
   */
  using Sink = std::function<void(
    const std::string &name, const std::size_t first, const std::vector<double> &values)>;

  /**
   * @p sampler has the samples of this rank's nodes, which have the numbers @p places in
   * the contact; empty on a rank without any. All arguments must outlive it.
   */
  ContactMapOutput(const ContactMapSetup &setup,
                   ContactMapSampler<dim> &sampler,
                   const std::vector<unsigned int> &places,
                   const BodySize &size,
                   const MPI_Comm communicator);

  /** On rank 0: reserves space in @p file for all samples of a run of @p n_steps. */
  void reserve(Hdf5File &file, const std::uint64_t n_steps) const;

  /** The names of the datasets. */
  std::vector<std::string> datasets() const;

  /** Continues before step @p n; all earlier samples are in the file. */
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

  /** On rank 0, after drain(): completes @p file with the samples before step @p n, of
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
  const std::uint64_t rows_together; ///< samples per buffer and chunk of the file
  std::vector<std::vector<unsigned int>> places; ///< places of all ranks, on rank 0
  std::uint64_t n_written = 0;
  Sink write;
};
} // namespace mesoslip

#endif
