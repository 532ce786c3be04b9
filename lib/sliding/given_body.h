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

/** What is told of a body, and what its runs are planned by; the same on all ranks, but for lines and
 * warnings, which rank 0 has. */
template <int dim>
struct BodyFacts
{
  std::vector<std::string> lines;    ///< for the log: shape, materials, boundaries
  std::vector<std::string> warnings; ///< sentences on what looks like a slip
  std::uint64_t n_points = 0;        ///< of the whole body
  bool heterogeneous     = false;    ///< whether it is made of several phases
  bool has_simplices =
    false; ///< whether some cells are triangles or tetrahedra, on rank 0
  std::vector<Phase<dim>> phases; ///< without their orientations

  std::vector<double> volume_fractions; ///< of the phases, on rank 0
  std::string rve_digest;               ///< of the RVE file; empty without one
  BodyMemory memory;                    ///< of the analysis without histories
  BodySize size;                        ///< what statistics and results need to know
  PlaceText place;                      ///< "cell 12 around x = 1.25 mm, y = 0.05 mm"

  /** What loads, times and lengths are compared with; of a run with the largest frequency. */
  BodyScales scales;

  double shortest_side = 0.; ///< m

  /** Lines on the content of its files, in which a run that is resumed has to agree. */
  std::string contents;

  std::vector<ProbePoint> probes; ///< where they are

  /** Heights of the contact nodes above the lowest (m); empty: all are as high. */
  std::vector<double> contact_height;

  /** x and, in 3D, y of the contact nodes (m). */
  std::array<std::vector<double>, 2> contact_place;

  /** Between the contact nodes, where there is a second body. */
  std::vector<SurfaceFacet> contact_facets;

  std::vector<unsigned int>
    contact_points; ///< their numbers in the mesh; empty: it is a grid

  double long_run = 0.; ///< steps times cells that keep a core busy for some seconds
  unsigned int most_ranks = 1; ///< by which a longer run ends sooner, on idle cores
};

/** Nodes of the top or of a loaded side that a rank has. */
struct SupportNodes
{
  std::vector<NodeIndex> nodes; ///< of ElasticBody fields
  SideNodes carried;            ///< what each stands for
};

/** What a face of the contact carries. */
struct ContactCell
{
  unsigned int phase = 0;  ///< of the cell behind it
  double area        = 0.; ///< along the normal of the flat (m^2, in 2D m)
  double pressure    = 0.; ///< -sigma_nn of the mean strain of the cell (Pa)
};

/** What a rank writes of a field: some rows of the second axis of the dataset. */
struct FieldRows
{
  std::size_t first = 0;      ///< of its rows
  std::vector<double> values; ///< components of a node together
};

/** Displacements of a body that a file has and ParaView shows. */
struct ShownFields
{
  std::string name;                               ///< that ParaView shows
  std::string dataset;                            ///< in the file
  std::vector<const NodalField<double> *> fields; ///< of elastic() or vibrating()
  std::string unit;                               ///< empty: none
};

/** A body in its initial state on the flat, and what is read of it. */
template <int dim>
struct BodyInMotion
{
  std::unique_ptr<SlidingBody<dim>> body; ///< all of it that moves
  std::unique_ptr<ProbeRecorder> probes;  ///< refer to the body; null without any

  /** The displacement as it is now, of all ranks together once. Collective. */
  std::function<FieldRows()> displacement;
};

/**
 * The body that parameters and files give, and what analyses ask of it: what it is made of, what
 * holds it, how it is advanced and solved for, and how its files look. GivenGrid is a plane grid,
 * GivenMesh a mesh or a box. Members are called by all ranks unless said otherwise.
 */
template <int dim>
class GivenBody
{
public:
  virtual ~GivenBody() = default;

  GivenBody(const GivenBody &)            = delete; ///< is referred to
  GivenBody &operator=(const GivenBody &) = delete; ///< see the constructor

  /** What is told of it. */
  const BodyFacts<dim> &facts() const
  {
    return known;
  }

  /** Prints lines, degrees of freedom, memory and warnings for --validate. */
  void describe(std::ostream &out, const double more_memory = 0.) const;

  /** Lines, and those of supports. */
  std::vector<std::string> told() const;

  /** Writes lines and warnings to the log. */
  void log(RunContext &context) const;

  /** Where the contact nodes are. */
  ContactPlaces contact_nodes() const;

  /** Adds to lines and warnings what is to be told of the flat. @throws UserError, see look_at_profile() */
  void look_at_flat();

  /** Puts analysis, material and size of the body into summary.json. */
  void summarize(const std::string &analysis, RunContext &context) const;

  /** The body at the start of a run, above @p counter if there is one; this, @p counter and @p context must outlive it. */
  virtual BodyInMotion<dim> start(const SlidingSetup &setup,
                                  RunContext &context,
                                  CounterMotion<dim> *counter) const = 0;

  /** A counter body in its initial state; of a plane grid on rank 0 alone. */
  virtual CounterMotion<dim> start_below(const SlidingSetup &setup,
                                         RunContext &context) const = 0;

  /** On rank 0: writes into the group /contact of a run where the nodes of the contact are. */
  virtual void write_contact(Hdf5File &file) const = 0;

  /**
   * @name Statics and modes
   * @{
   */
  /** Makes the body that elastic() is from then on, with whole fields on all ranks if @p whole;
   * contact nodes are then in the order of ElasticBody::surface(). */
  virtual void make_elastic(const MPI_Comm communicator, const bool whole = false) = 0;

  virtual const ElasticBody<dim> &elastic() const = 0; ///< see make_elastic()

  /** The same as it vibrates: displacements at its contact are absolute. */
  virtual const ElasticBody<dim> &vibrating() const
  {
    return elastic();
  }

  /** Modes of elastic() below this @p top, with the contact held along the normal of the flat or free. Collective.
   * @throws as vibration_modes() */
  virtual VibrationModes<dim> modes(const TopSetup &top,
                                    const bool contact_held,
                                    const VibrationModesOptions &options) const;

  /** Stiffness and masses of the body with phases_of_damping() for its own, in whole fields as those of vibrating().
   * Collective. */
  virtual DampingByPhase make_damping(const StepParameters &step,
                                      const MPI_Comm communicator) const = 0;

  /** What supports and @p top hold of elastic(), all components of what platens move; with
   * @p contact_held the contact along the normal of the flat. */
  virtual DofMask held(const TopSetup &top, const bool contact_held) const = 0;

  /** The platens of top and sides, which move nodes of elastic(). */
  std::vector<Platen> platens(const TopSetup &top) const;

  /** In how many components they move. */
  std::size_t n_platen_moves(const TopSetup &top) const;

  /** The nodes of the top that this rank has. */
  virtual SupportNodes top_nodes() const = 0;

  /** Sides of the body, and of one below it, that are loaded; platens first. */
  virtual std::vector<SideSupport> loaded_sides() const
  {
    return parameters.loaded_sides();
  }

  /** The nodes of each of loaded_sides(). */
  virtual std::vector<SupportNodes> side_nodes() const = 0;

  /** The nodes of the contact in elastic(), of a counter body of its upper side. */
  virtual std::vector<NodeIndex> contact_of_elastic() const
  {
    return elastic().surface(ElasticBody<dim>::bottom).nodes;
  }

  /** A first guess of the displacement (m) under a uniform strain along the normal of the flat, where
   * all of the contact touches; else zero. */
  virtual NodalField<double> compressed(const double strain) const = 0;

  /** On rank 0: the cells behind the faces of the contact under a displacement. */
  virtual std::vector<ContactCell> contact_cells(const NodalField<double> &u) const = 0;

  /** On rank 0: where the contact nodes are (m), along the dim axes, of a plane grid along x. */
  virtual std::vector<std::vector<double>> contact_places() const = 0;

  /** Share of each phase in the tributary area of each contact node, and their names. */
  virtual ContactParts contact_parts() const = 0;

  /** Strains and rotations of the cells under a displacement. */
  virtual Deformation deformation(const NodalField<double> &u) const = 0;

  /** Number of components that all this leaves free, without a platen. */
  virtual std::size_t n_free(const TopSetup &top, const bool contact_held) const = 0;
  /** @} */

  /**
   * @name Files
   * @{
   */
  /** On rank 0: begins a file of contact_dynamics with header, cells and materials. */
  virtual Hdf5File create_file(const std::string &path,
                               const std::string &format) const = 0;

  /** On rank 0: extents of a displacement of the nodes in a file. */
  virtual Shape vectors_shape() const = 0;

  /** Writes displacements of elastic() as dataset @p name into @p file at @p path, which rank 0 has. */
  virtual void
  write_fields(std::optional<Hdf5File> &file,
               const std::string &path,
               const std::string &name,
               const std::vector<const NodalField<double> *> &fields) const = 0;

  /** Writes @p shown into @p file at @p path, which rank 0 has, closes it and shows it, with @p numbers as times. */
  void write_and_show(std::optional<Hdf5File> &file,
                      const std::string &path,
                      const std::vector<ShownFields> &shown,
                      const std::vector<double> &numbers) const;

  /** The counter body of a pair; null without one. */
  virtual const GivenBody *lower() const
  {
    return nullptr;
  }

  /** On rank 0: writes what a counter body has of fields into the file at @p path, of this @p format and shows it, with @p numbers as
   * times, and with the @p conditions of a run, unless there are none; nothing without a counter body. */
  virtual void write_below(const std::string & /*path*/,
                           const std::string & /*format*/,
                           const std::vector<ShownFields> & /*shown*/,
                           const std::vector<double> & /*numbers*/,
                           const RunConditions & /*conditions*/) const
  {
  }

  /** On rank 0: writes NAME.xdmf with @p fields of the file NAME.h5 at @p path, and NAME-phases.xdmf,
   * as ParaView does not read vectors of nodes and data of cells from one. */
  virtual void show(const std::string &path,
                    const std::vector<XdmfField> &fields,
                    const std::vector<double> &times) const = 0;
  /** @} */

  const ContactParameters parameters; ///< all of them, checked

protected:
  /** @throws UserError if there are not as many constants of damping as phases */
  void check_damping() const;

  /** Of these parameters. */
  explicit GivenBody(const ContactParameters &parameters);

  /** Adds which phases have mean dilatation to the lines of facts(). */
  void add_lines_on_cells();

  /** Adds sentences on @p ranges, friction, springs of the contact, a static load and facts().phases that
   * look like another unit, in a body of these @p scales. */
  void add_implausible(std::vector<std::string> &sentences,
                       std::vector<PlausibleRange> ranges,
                       const BodyScales &scales) const;

  /** What nodes of top and sides stand on in statics and modes. */
  Foundation foundation() const;

  BodyFacts<dim> known; ///< see facts(); for derived classes to set
};

/** The body that @p parameters and their files give. Collective. @throws UserError for input that no
 * analysis can work with, or without the memory for it */
template <int dim>
std::unique_ptr<GivenBody<dim>> make_given_body(const ContactParameters &parameters);
} // namespace mesoslip

#endif
