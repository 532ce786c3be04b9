#ifndef mesoslip_sliding_given_body_h
#define mesoslip_sliding_given_body_h

#include "dynamics/deformation.h"
#include "exchange/xdmf.h"
#include "observation/probe_recorder.h"
#include "program/program.h"
#include "sliding/body_memory.h"
#include "sliding/complex/contact_parts.h"
#include "sliding/contact_parameters.h"
#include "sliding/counter/counter_motion.h"
#include "sliding/flat/profile_check.h"

#include "sliding/run_plan.h"
#include "sliding/sliding_body.h"

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
template <int dim>
class ElasticBody;
class DofMask;
struct DampingByPhase;
struct Foundation;
struct Platen;

/** Description of a body and the data that its runs are planned by; the same on all ranks
 * except lines and warnings, which are on rank 0. */
template <int dim>
struct BodyFacts
{
  std::vector<std::string> lines;    ///< lines for the log: shape, materials, boundaries
  std::vector<std::string> warnings; ///< warnings on values that look like slips
  std::uint64_t n_points = 0;        ///< points of the whole body
  bool heterogeneous     = false;    ///< whether it is made of several phases
  bool has_simplices =
    false; ///< whether some cells are triangles or tetrahedra, on rank 0
  std::vector<Phase<dim>> phases; ///< without orientations

  std::vector<double> volume_fractions; ///< by phase, on rank 0
  std::string rve_digest;               ///< digest of the RVE file; empty without one
  BodyMemory memory;                    ///< memory of the analysis without histories
  BodySize size;                        ///< for statistics and results
  PlaceText place;                      ///< "cell 12 around x = 1.25 mm, y = 0.05 mm"

  /** Reference scales for loads, times and lengths; for a transient run with the highest
   * frequency. */
  BodyScales scales;

  double shortest_side = 0.; ///< m

  /** Lines on the content of the body's files, which a resumed run has to match. */
  std::string contents;

  std::vector<ProbePoint> probes; ///< positions of the probes

  /** Heights of the contact nodes above the lowest (m); empty: all have the same
   * height. */
  std::vector<double> contact_height;

  /** x and, in 3D, y of the contact nodes (m). */
  std::array<std::vector<double>, 2> contact_place;

  /** Facets between the contact nodes, for a counter body. */
  std::vector<SurfaceFacet> contact_facets;

  std::vector<unsigned int>
    contact_points; ///< numbers of the contact nodes in the mesh; empty: a grid

  double long_run         = 0.; ///< steps times cells that take some seconds on one core
  unsigned int most_ranks = 1;  ///< number of idle cores that still shorten a long run
};

/** Locally stored nodes of the top or of a loaded side. */
struct SupportNodes
{
  std::vector<NodeIndex> nodes; ///< column and row in ElasticBody fields
  SideNodes carried;            ///< area, push and impedance of each node
};

/** A contact face and its load. */
struct ContactCell
{
  unsigned int phase = 0;  ///< phase of the cell behind the face
  double area        = 0.; ///< along the normal of the flat (m^2, in 2D m)
  double pressure    = 0.; ///< -sigma_nn from the mean strain of the cell (Pa)
};

/** Part of a field that a rank writes: rows of the second axis of the dataset. */
struct FieldRows
{
  std::size_t first = 0;      ///< index of its first row
  std::vector<double> values; ///< components of a node are adjacent
};

/** Displacement fields that a file stores and ParaView shows. */
struct ShownFields
{
  std::string name;                               ///< name in ParaView
  std::string dataset;                            ///< name of the dataset in the file
  std::vector<const NodalField<double> *> fields; ///< fields of elastic() or vibrating()
  std::string unit;                               ///< empty: none
};

/** A body in its initial state on the flat, with probes and output. */
template <int dim>
struct BodyInMotion
{
  std::unique_ptr<SlidingBody<dim>> body; ///< the moving body
  std::unique_ptr<ProbeRecorder> probes;  ///< probes of the body; null without any

  /** Current displacement: the rows that this rank writes; every row is written by one
   * rank. Collective. */
  std::function<FieldRows()> displacement;
};

/**
 * The body given by parameters and files, as the analyses see it: materials, supports,
 * time integration, statics and file layout. GivenGrid is a plane grid, GivenMesh a mesh
 * or a box. Members are collective unless documented otherwise.
 */
template <int dim>
class GivenBody
{
public:
  virtual ~GivenBody() = default;

  GivenBody(const GivenBody &)            = delete; ///< referred to
  GivenBody &operator=(const GivenBody &) = delete; ///< see the constructor

  /** Facts of the body. */
  const BodyFacts<dim> &facts() const
  {
    return known;
  }

  /** Prints lines, degrees of freedom, memory and warnings for --validate. */
  void describe(std::ostream &out, const double more_memory = 0.) const;

  /** Lines of facts() and on the supports. */
  std::vector<std::string> told() const;

  /** Writes lines and warnings to the log. */
  void log(RunContext &context) const;

  /** Positions of the contact nodes. */
  ContactPlaces contact_nodes() const;

  /** Adds lines and warnings on the flat.
   * @throws UserError, see look_at_profile() */
  void look_at_flat();

  /** Puts analysis, material and size of the body into summary.json. */
  void summarize(const std::string &analysis, RunContext &context) const;

  /** The body at the start of a run, above @p counter if there is one. This object,
   * @p counter and @p context must outlive it. */
  virtual BodyInMotion<dim> start(const SlidingSetup &setup,
                                  RunContext &context,
                                  CounterMotion<dim> *counter) const = 0;

  /** A counter body in its initial state; for a plane grid on rank 0 only. */
  virtual CounterMotion<dim> start_below(const SlidingSetup &setup,
                                         RunContext &context) const = 0;

  /** On rank 0: writes the positions of the contact nodes into the group /contact of a
   * run. */
  virtual void write_contact(Hdf5File &file) const = 0;

  /**
   * @name Statics and modes
   * @{
   */
  /** Makes the body that elastic() returns, with fields replicated on all ranks if
   * @p whole; contact nodes then have the order of ElasticBody::surface(). */
  virtual void make_elastic(const MPI_Comm communicator, const bool whole = false) = 0;

  virtual const ElasticBody<dim> &elastic() const = 0; ///< see make_elastic()

  /** The body for vibrations: elastic(), but with absolute displacements at its
   * contact. */
  virtual const ElasticBody<dim> &vibrating() const
  {
    return elastic();
  }

  /** Modes of elastic() below @p top, with the contact held along the normal of the flat
   * or free. Collective.
   * @throws as vibration_modes() */
  virtual VibrationModes<dim> modes(const TopSetup &top,
                                    const bool contact_held,
                                    const VibrationModesOptions &options) const;

  /** Stiffness and masses of the body with phases_of_damping() in place of its phases, in
   * replicated fields laid out like those of vibrating(). Collective. */
  virtual DampingByPhase make_damping(const StepParameters &step,
                                      const MPI_Comm communicator) const = 0;

  /** Constraints of elastic() by supports and @p top, including all components of nodes
   * that platens move; with @p contact_held the contact along the normal of the flat. */
  virtual DofMask held(const TopSetup &top, const bool contact_held) const = 0;

  /** The platens of top and sides, which move nodes of elastic(). */
  std::vector<Platen> platens(const TopSetup &top) const;

  /** Number of components in which the platens move. */
  std::size_t n_platen_moves(const TopSetup &top) const;

  /** Locally stored nodes of the top. */
  virtual SupportNodes top_nodes() const = 0;

  /** Loaded sides of the body, then of a counter body; of each platens first. */
  virtual std::vector<SideSupport> loaded_sides() const
  {
    return parameters.loaded_sides();
  }

  /** The nodes of each of loaded_sides(). */
  virtual std::vector<SupportNodes> side_nodes() const = 0;

  /** Contact nodes of elastic(); for a counter body on its upper side. */
  virtual std::vector<NodeIndex> contact_of_elastic() const
  {
    return elastic().surface(ElasticBody<dim>::bottom).nodes;
  }

  /** Initial guess of the displacement (m): uniform strain along the normal of the flat
   * if the whole contact touches; else zero. */
  virtual NodalField<double> compressed(const double strain) const = 0;

  /** On rank 0: the cells behind the contact faces under a displacement. */
  virtual std::vector<ContactCell> contact_cells(const NodalField<double> &u) const = 0;

  /** On rank 0: coordinates of the contact nodes (m), along the dim axes; for a plane
   * grid along x only. */
  virtual std::vector<std::vector<double>> contact_places() const = 0;

  /** Names of the phases and their shares in the tributary area of each contact node. */
  virtual ContactParts contact_parts() const = 0;

  /** Strains and rotations of the cells under a displacement. */
  virtual Deformation deformation(const NodalField<double> &u) const = 0;

  /** Number of free components under these constraints, without platen motions. */
  virtual std::size_t n_free(const TopSetup &top, const bool contact_held) const = 0;
  /** @} */

  /**
   * @name Files
   * @{
   */
  /** On rank 0: creates a file of contact_dynamics with header, cells and materials. */
  virtual Hdf5File create_file(const std::string &path,
                               const std::string &format) const = 0;

  /** On rank 0: shape of a nodal displacement field in a file. */
  virtual Shape vectors_shape() const = 0;

  /** Writes displacements of elastic() as dataset @p name into @p file at @p path, which
   * is open on rank 0. */
  virtual void
  write_fields(std::optional<Hdf5File> &file,
               const std::string &path,
               const std::string &name,
               const std::vector<const NodalField<double> *> &fields) const = 0;

  /** Writes @p shown into @p file at @p path, which is open on rank 0, closes it and
   * writes the XDMF file, with @p numbers as times. */
  void write_and_show(std::optional<Hdf5File> &file,
                      const std::string &path,
                      const std::vector<ShownFields> &shown,
                      const std::vector<double> &numbers) const;

  /** The counter body of a pair; null without one. */
  virtual const GivenBody *lower() const
  {
    return nullptr;
  }

  /** On rank 0: writes the counter body's part of the fields into the file at @p path, of
   * this @p format, and its XDMF file, with @p numbers as times and with the
   * @p conditions of a run, if there are any. Does nothing without a counter body. */
  virtual void write_below(const std::string & /*path*/,
                           const std::string & /*format*/,
                           const std::vector<ShownFields> & /*shown*/,
                           const std::vector<double> & /*numbers*/,
                           const RunConditions & /*conditions*/) const
  {
  }

  /** On rank 0: writes NAME.xdmf with @p fields of the file NAME.h5 at @p path, and
   * NAME-phases.xdmf: ParaView does not read nodal vectors and cell data from one
   * file. */
  virtual void show(const std::string &path,
                    const std::vector<XdmfField> &fields,
                    const std::vector<double> &times) const = 0;
  /** @} */

  const ContactParameters parameters; ///< all parameters, checked

protected:
  /** @throws UserError if the number of damping constants differs from the number of
   * phases */
  void check_damping() const;

  /** Stores @p parameters. */
  explicit GivenBody(const ContactParameters &parameters);

  /** Adds the phases with mean dilatation to the lines of facts(). */
  void add_lines_on_cells();

  /** Adds warnings on values that look like another unit: @p ranges, friction, contact
   * springs, a static load and facts().phases, relative to @p scales. */
  void add_implausible(std::vector<std::string> &sentences,
                       std::vector<PlausibleRange> ranges,
                       const BodyScales &scales) const;

  /** Springs, dashpots and masses at the nodes of top and sides, for statics and
   * modes. */
  Foundation foundation() const;

  BodyFacts<dim> known; ///< returned by facts(); set by derived classes
};

/** The body that @p parameters and their files give. Collective.
 * @throws UserError for input that no analysis supports, or if the memory is
 * insufficient */
template <int dim>
std::unique_ptr<GivenBody<dim>> make_given_body(const ContactParameters &parameters);
} // namespace mesoslip

#endif
