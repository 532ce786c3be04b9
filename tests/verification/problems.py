"""The verification problems: what has to come out, which tests assert it, and in which order errors have to fall."""

_UNIT, _UNIT_RANKS, _SERIAL, _RANKS = "unit_serial: ", "unit_ranks: ", "verification_serial: ", "verification_ranks: "

# (problem, what has to come out, tests)
PROBLEMS = [
    ("Cell", "eigenvalues of the square cell; rigid motion and constant strain; sum of the lumped masses; growth just above the critical time step, none below",
     [_UNIT_RANKS + "Element.EigenvaluesOfTheSquare", _UNIT_RANKS + "UniformGridOperator.RigidMotionAndConstantStrain",
      _UNIT_RANKS + "UniformMaterial.MassAndChecks", _UNIT_RANKS + "CriticalTimeStep.ObservedStability"]),
    ("Modes of the rectangle", "f = c/2 sqrt((m/L)^2 + ((2n+1)/(2H))^2): order 2 in h and, at beta2 = 1/2, in dt; order 1 in dt at beta2 > 1/2; decay by "
     "beta and beta2 from the product of the scheme's eigenvalues; energy constant to 1e-12",
     [_SERIAL + "Rectangle.FrequenciesConvergeWithOrderTwo", _SERIAL + "Rectangle.MotionConvergesWithOrderTwoInSpaceAndTime",
      _SERIAL + "Rectangle.OrderInTime", _SERIAL + "Rectangle.DecaysByBetaAndByBeta2", _SERIAL + "Rectangle.EnergyBoundedWithoutTrend",
      _SERIAL + "Modes.OfTheRectangleConvergeWithOrderTwo"]),
    ("Bar on a rigid wall", "contact from 0.5 to 1.1667, pressure rho c v, initial speed afterwards (Doyen, Ern, Piperno 2011); energy lost O(h) at beta2 = 1/2, "
     "O(sqrt h) at beta2 = 1",
     [_SERIAL + "Bar.HitsTheWallAndLeaves", _SERIAL + "Bar.EnergyLossOfOneImpact"]),
    ("Box of bricks on a rigid wall", "impact, energy lost and first bounce under gravity as for the plane bars, with equal orders",
     [_SERIAL + "BoxBar." + name for name in ("HitsTheWallAndLeaves", "EnergyLossOfOneImpact", "FirstBounceUnderGravity")]),
    ("Bar bouncing under gravity", "pressure rho c (v + g t) and impulse of the first bounce; later bounces gain no energy",
     [_SERIAL + "Bar.FirstBounceUnderGravity", _SERIAL + "Bar.BouncingUnderGravityGainsNoEnergy"]),
    ("Friction at a point", "step of the normal stress (figure 2), ramp and the mean of eq. (11) exact; harmonic force of order 2 in dt; plain Coulomb; block thrown on a plane stops after v^2/(2 mu g)",
     [_UNIT + "FrictionLaw.RelaxesAfterANormalStressStepAsFigure2", _UNIT + "FrictionLaw.LagsBehindARamp",
      _UNIT + "FrictionLaw.MeanOverAContactIsThatOfEquation11", _UNIT + "FrictionLaw.SlipRateThatChangesFromStepToStep",
      _UNIT + "FrictionLaw.FiltersAHarmonicNormalForce", _UNIT + "FrictionLaw.CoulombAtOnce", _UNIT + "Block.ThrownOnAPlane"]),
    ("Column thrown along the flat", "slides with v - a, v - 3 a, ... (a = mu P / (rho c)) for a round trip of the shear wave each, then sticks; slip of order 1 "
     "(wave fronts), work of friction mu P times the slip", [_SERIAL + "Column.BrakesInStepsAndSticks"]),
    ("Growth of steady sliding", "growth rate and frequency from the exact dispersion relation, within 1 % at H/80; order 2 in h and dt; error of the time step "
     "alone from the relation discrete in time", [_SERIAL + "Growth." + name for name in ("Coulomb", "RegularizedAndDamped", "OfOrderTwoInTheTimeStep")]),
    ("Sliding with neither damping nor regularization", "waves of the size of the cells grow at the eigenvalue of the grid's surface wave, in proportion to 1/h; the "
     "paper's beta or delta stops them", [_SERIAL + "Growth.OfTheGridWithoutDampingAndRegularization"]),
    ("Sliding boxes of bricks", "the column, thrown at an angle to the axes, and the growth of the layer, with the orders of 2D; waves at 0, 30, 45 and 60 degrees to "
     "the motion within 1 %, at 45 degrees refined along all three axes: order 2",
     [_SERIAL + "BoxColumn.BrakesInStepsAndSticks"] + [_SERIAL + "BoxGrowth." + name for name in ("Coulomb", "RegularizedAndDamped", "OfOrderTwoInTheTimeStep")]
     + [_SERIAL + "BoxWaves." + name for name in ("AtAllAngles", "OfOrderTwoInTheCellSize")]),
    ("Energy balance", "closes to 1e-12 of the largest energy with each term from its own formula: tops, stops, damping, gravity, free vibration; error below 1e-3 of "
     "the friction work in a coarse pin at 5 MPa sampled every 50 steps",
     [_SERIAL + "Energy." + name for name in ("ClosesUnderEveryTop", "ClosesOverAProfile", "ClosesOnSpringsAlongTheFlat", "ClosesWhenTheTopIsStopped", "ClosesWithEverythingElse",
                                                "FreeVibrationLosesNothing", "EveryTermWhereItBelongs",
                                                "DampingIsBetaTimesTheWorkOfTheOperator", "ClosesWithSparseSamples")]),
    ("Supports of the top", "column on springs, with mass and under a platen on springs: Z omega tan(omega H/c) = k - m omega^2, order 2; a dashpot z reflects "
     "((Z - z)/(Z + z))^2 of the energy, the impedances of a turned solid below 1e-3; a driven far end; energy balance to 1e-12; a block that sticks and slips; growth "
     "of a layer on springs and dashpots, order 2",
     [_SERIAL + "Supports." + name for name in ("ColumnOnSpringsHasItsFrequency", "DashpotsReflectByTheirImpedance", "TurnedSolidsAreAbsorbed", "FarEndDrivesTheColumn",
                                                "MovesWithItsFarEnd", "EnergyCloses", "BlockOnASpringSticksAndSlips")]
     + [_RANKS + "ComplexModes.OfTheLayerThatHangsOnSprings"]),
    ("Profile of the flat", "pressure of a sine profile that moves below a half-space at 700 and 1500 m/s, order 2",
     [_SERIAL + "Profile.MovesAWaveOfKnownPressureThroughTheBody"]),
    ("Springs along the flat", "a column sticks on springs: tan(q H) = -q G/k_t, order 2, its energy loss falls with order 3; loss of slow sliding to and fro",
     [_SERIAL + "TangentialSprings." + name for name in ("ColumnVibratesOnThem", "LoopOfSlowSlidingHasItsArea")]),
    ("Momentum", "its rate equals the forces at top and bottom to 1e-12", [_SERIAL + "Momentum.IsWhatTheForcesAtTopAndBottomSay"]),
    ("Homogenization", "homogeneous volume; laminate, also turned; equal shear moduli (order 2 except for a logarithm); Hill-Mandel, symmetry, phase means; Reuss <= SUBC "
     "<= PBC <= KUBC <= Voigt; refinement softens; eq. (10)",
     [_RANKS + "Homogenization." + name for name in ("HomogeneousVolumeReturnsItsStiffness", "PeriodicLaminate", "EqualShearModuli",
                                                              "IdentitiesOfEverySolve", "RefinementSoftens",
                                                              "PaperPin")] + [_RANKS + "RandomMicrostructures.KeepOrderAndIdentities"]),
    ("Localization", "a uniform macroscopic strain gives the solution of the RVE; strains interpolated with order 2",
     ["unit_serial: Localize.UniformMacroscopicStrainGivesTheSolutionOfTheRve", "unit_serial: StrainInterpolation.SecondOrder"]),
    ("The paper's pin", "first modes, bottom free and held (figure 8)", [_SERIAL + "Modes.OfThePaperPin"]),
    ("Column under a platen with mass", "bottom held: r a tan a = 1, bottom free: r a + tan a = 0, a = 2 pi f H / c_L, r = mass of the platen over that of the column; order 2 in h",
     [_SERIAL + "Modes.OfAColumnUnderAPlatenWithMass"]),
    ("Static contact", "uniform compression, sliding layer, laminate under a platen, partial separation, balance of forces",
     [_SERIAL + "StaticContact." + name for name in ("UniformCompression", "SlidingLayer", "LaminateUnderPlaten", "FibresUnderPlatenBalance",
                                                      "PartialSeparation", "RestingFlat")]),
    ("Operator against a mesh of deal.II", "equal products on random fields, materials and grids",
     [_UNIT_RANKS + "MeshBody.EqualsGridBody", _RANKS + "Homogenization.EqualsMeshOfTheSameCells"]),
    ("Ranks", "any number of ranks gives the same run (here one rank, in `./test.sh` up to five)",
     [_UNIT_RANKS + "Partition.AnyNumberOfRanksAndStepsInFlightBitForBit"]),
    ("Restart", "bitwise the uninterrupted run", [_SERIAL + "Restart.ContinuesBitByBit"]),
    ("Turned, mirrored, scaled", "a turned body vibrates turned; a reversed flat gives the mirror image; lengths in millimetres change nothing; pressure "
     "and velocity times s give the motion times s",
     [_SERIAL + "Symmetry.TurnedBodyVibratesTurned", _SERIAL + "Symmetry.ReversedFlatGivesTheMirrorImage",
      _SERIAL + "Symmetry.MillimetresAndTonnes", _SERIAL + "Scaling.PressureAndVelocityTogether",
      _RANKS + "Homogenization.TurnedMorphologyGivesTurnedStiffness",
      _RANKS + "Homogenization.MirroredMorphologyGivesMirroredStiffness", _RANKS + "Homogenization.UnitsChangeNothing"]),
    ("Random microstructures", "fractions, gaps, bounds and identities of random morphologies",
     [_RANKS + "RandomMicrostructures.KeepTheirRules", _RANKS + "RandomMicrostructures.KeepOrderAndIdentities"]),
    ("Random statics", "stiffnesses of random volumes (contrast to 1e6, nu to 0.4999, cells to 1:60, 1 x 1 to 64 x 64 cells, soft pores) equal those of a sparse "
     "direct solution to 1e-5, or a warning tells how many digits hold; the energy is of second order in the error of the solver",
     [_RANKS + "RandomStatics." + name for name in ("EqualADirectSolution", "AdverseVolumesEqualADirectSolution",
                                                             "StiffInclusionHoldsItsDigits", "EnergiesAreOfSecondOrder")]),
    ("Complex modes", "growth rate and frequency of the sliding layer from the exact dispersion relation, order 2 in h; growth equals the power of friction "
     "less the power of damping",
     [_RANKS + "ComplexModes." + name for name in ("OfTheLayerWithCoulombFriction", "OfTheRegularizedAndDampedLayer",
                                                     "GrowthIsThePowerOfFrictionLessDamping")]),
    ("Friction laws", "every formula and its slopes; velocity weakening and rate and state of order 2 in dt; a step of velocity; slip weakening turns kinetic energy into "
     "work; a block on a spring sticks and slips; Prakash and Clifton's normal stress after a step; each law with every regularization against the method of "
     "Runge and Kutta",
     [_UNIT + "CoefficientLaw." + name for name in ("Formulas", "SlopesAndTheirBounds", "VelocityWeakeningIsOfOrderTwo", "SlipWeakeningTurnsKineticEnergyIntoWork",
                                                "RateAndStateAfterAStepOfVelocity", "RateAndStateIsOfOrderTwo", "SpringAndBlockStickAndSlip")]
     + [_UNIT + "NormalStressMemory.RelaxesAfterAStepOfTheNormalForce", _UNIT + "LawRegularization.EveryLawWithEveryRegularization"]),
    ("Maps of the contact", "a wave in the map has the velocity of the dispersion relation; a map changes no step",
     [_SERIAL + "ContactMap." + name for name in ("WavesTravelAsTheDispersionRelationSays", "TakesPartInNoStep")]),
    ("Meshes: waves of the sliding layer", "growth on distorted quadrilaterals and triangles of order 2; in 3D waves across the motion and oblique to it, at 30, 45 and 60 degrees",
     [_SERIAL + "MeshGrowth." + name for name in ("OnQuadrilaterals", "OnTriangles")]
     + [_SERIAL + "MeshWaves." + name for name in ("AcrossTheMotionOfTheFlat", "AcrossTheMotionOfTheFlatWhereTheBodyIsHeldAlongIt",
                                                        "AtAnAngleToTheMotionOfTheFlat", "AtAnAngleUnderFrictionThatLags")]),
    ("Meshes: sliding", "energy balance closes; results equal those of the grid, of an extruded body those of the plane body; a block thrown askew "
     "runs straight and stops after v^2/(2 mu g); a flat that moves askew turns the solution; the gap follows the shape",
     [_RANKS + "MeshSliding." + name for name in ("EnergiesClose", "EqualsTheGrid", "ExtrudedBodyEqualsThePlaneOne",
                                                          "BlockThrownAskewStopsAfterItsDistance", "TheGapFollowsTheShape")]
     + [_RANKS + "FlatAskew." + name for name in ("TurnsTheSolution", "BlockIsTakenAlong")]),
    ("Meshes: statics and modes", "patch test; six rigid motions; modes of a prism equal those of a chain; layers between periodic sides: waves of order 2, uniform under pressure",
     [_RANKS + "MeshStatics." + name for name in ("PatchTest", "SixRigidMotions", "ModesOfAPrismAreThoseOfAChain")]
     + [_RANKS + "PeriodicLayer." + name for name in ("ModesConvergeToThoseOfWaves", "PressedOnASlidingFlatIsUniform")]),
    ("Meshes: homogenization", "patch test and laminate exact on every kind of cell; a grid as a mesh; plane strain of an extruded volume",
     [_RANKS + "MeshVolume." + name for name in ("PatchTestAndLaminateAreExact", "GridAsMesh", "ExtrudedIsPlaneStrain")]),
    ("Voxels", "operator and solutions equal those of the assembled matrix; homogeneous boxes exact; iterations bounded; the explicit step equals the step of a mesh "
     "with the same cells; the bound of the time step of a cube is exact",
     ["unit_ranks: VoxelSolver." + name for name in ("OperatorIsTheAssembledMatrix", "SolutionsAreThoseOfTheAssembledMatrix", "HomogeneousBoxesAreExact",
                                                            "IterationsAreBounded")]
     + ["unit_ranks: Brick." + name for name in ("ProductEqualsThatOfTheMesh", "StepsEqualThoseOfTheMesh", "LargestFrequencyIsThatOfTheMesh",
                                                 "BoundOfACubeIsExact")]),
]

# Expected order of each series of errors.
ORDERS = {
    (2, ", bodies"): ("frequency, mode 1 0 shear", "frequency, mode 2 1 shear", "frequency, mode 1 0 pressure", "frequency, mode 0 1 pressure",
                      "motion, shear", "motion, pressure", "time step, beta2 = 0.5", "stiffness, equal shear moduli"),
    (2, ", sliding"): ("growth, Coulomb", "growth, regularized", "growth, the law in time", "growth, time step", "friction under a harmonic force"),
    (1, ""): ("time step, beta2 = 0.6", "time step, beta2 = 1.0", "loss of an impact, beta2 = 0.5", "pressure of a bounce under gravity",
              "slip of a braked column"),
    (0.5, ""): ("loss of an impact, beta2 = 1",),
}

PAGE = """# Verification

`./run.sh verification` runs the tests of the first table and writes this page; `./test.sh` runs all tests.

## Problems, predicted and observed

{problems}

Expected values are from theory or an independent computation.

* "a for b": measured a, expected b
* "numbers within": largest deviation from the expected values; [numbers.csv](verification/numbers.csv) has all values
* "order" with values: orders of convergence ([errors](verification/convergence.csv)); without: see the next table
* "holds": all assertions of the tests hold; there is no single number

## Orders of convergence

![convergence](verification/convergence.png)

{orders}

Orders are those of the two finest refinements; dotted: predicted order. The stiffness with equal shear moduli converges as h^2 (log(1/h) + c), with an order below 2 on any grid.

## The paper's pin on a mesh of deal.II

The programs compute `prm/paper` with its 560 x 160 cells twice, with ML on a mesh of deal.II and with multigrid on the grid. The table has the largest differences over the largest value; the limit is 1e-8. `system/programs/ranks` does the same with smaller bodies.

{pin}

## Meshes and voxels

"Grid as mesh": a grid that is read as a Gmsh file. Tests that do not begin with `system` are in `tests/verification`.

| volumes | compared with | agreement | test |
| --- | --- | --- | --- |
| grid as mesh, 1 to 3 ranks | grid | 1e-10 | `system/homogenization/mesh` |
| fibres in a hexagonal lattice | code_aster, HPLV106 | published digits | `volumes/hexagonal_cell` |
| equal shear moduli; coated cylinders and spheres | Hill; Hashin, Lame | order 2 | `volumes/mesh_inclusions` |
| single inclusions | Eshelby | 0.2 %, at nu = 0.4999 0.14 % | `volumes/mesh_inclusions` |
| quadratic cells; curved cells | code in Python | 1e-9; order 4 | `volumes/quadratic_cells`, `curved_cells` |
| voxels that are not cubes, KUBC, SUBC, PBC, 1 to 3 ranks | code in scipy | stiffness 1e-14, tensors 1e-12 | `voxels/voxels` |
| one layer of voxels; laminates | plane grid; exact | 1e-15; 1e-14 | `voxels/voxels` |
| voxels: contrast 1e4 and 1e-4, pores of 1e-6, nu = 0.499, 1 x 1 x 4 | code in scipy | 1e-13, SUBC at 1e4 3e-10 | `voxels/voxel_extremes` |
| voxels: bulk modulus for equal shear moduli | Hill | 3 % with 4^3, 0.1 % with 32^3 | `voxels/voxel_extremes` |
| voxels: all 21 entries, contrast 8 and 100, three phases | [FANS](https://github.com/DataAnalyticsEngineering/FANS) 0.6.2, commit d3ff337 ([table](performance/fans.csv), [entries](performance/fans-entries.csv), [time](performance/fans-time.csv)) | 5e-14 to 4e-12 of the largest, 2e-10 of each | `./run.sh benchmarks fans --fans FANS` |
| orientations by cell, up to 300 materials | code in scipy | 3e-15, tensors 1e-12 | `voxels/voxel_orientations` |
| every kind of voxel file, cropped, coarsened | NumPy | equal | `voxels/voxel_files` |
| ensembles of random inclusions | runs of their seeds | 1e-15 | `voxels/voxel_random` |

| runs and modes | compared with | agreement | test |
| --- | --- | --- | --- |
| grid as mesh, 1000 steps, 1 to 3 ranks | grid | 1e-9 | `system/sliding/mesh_dynamics` |
| blocks thrown askew | point with mass | 3e-5 | `contact/mesh_friction_vector` |
| distorted mesh in 3D, 1 to 8 ranks | one rank | run 2e-13, volume and modes 1e-11 | `contact/mesh_ranks` |
| boxes of voxels, 1 to 3 ranks; with orientations | mesh of the same cells | 1e-9; modes 1e-6 | `system/sliding/boxes`, `oriented_boxes` |
| modes of a grid as mesh, 1 and 3 ranks | grid | 1e-9 | `system/sliding/mesh_modes` |
| ring, 16 quadrilaterals, 32 triangles; torsion, 16 hexahedra across | exact | 0.0030, 0.023, 0.67 %, order 2 | `system/sliding/mesh_modes` |
| modes of a box | waves in closed form | order 2 | `voxels/box_modes` |
| chain of runs on meshes; localization at points | chain on grids; numpy | 1e-7; 1e-9 | `system/localization/mesh_localization` |
| localization on voxels | numpy; mesh of the same cells | 1e-10; 1e-8 | `system/localization/voxels` |

| static contact | compared with | agreement | test |
| --- | --- | --- | --- |
| grid as mesh; with periodic sides | grid | 1e-6; 1e-7 | `system/sliding/mesh_static_contact`, `mesh_periodic` |
| cylinder, 8, 16, 32 cells in the contact | Hertz | radius 0.42, 0.09, 0.02 %, peak 0.02 % | `contact/hertz` |
| the same on stiff springs of the flat | first order in 1/k | 5 % of the difference | `contact/hertz` |
| sphere, 3, 6, 12 cells in the contact | Hertz | radius 3.4, 0.37, 0.14 %, peak 0.2 % | `contact/hertz_sphere` |
| strip with friction on a resting flat | Spence | width 0.9 %, friction 0.26 % | `contact/spence` |
| two phases on a resting flat, 8 to 40 cells a side | Coulomb's law | 1e-6, 18 to 20 iterations | `contact/resting_flat` |

Cylinder pressed with friction in load steps (Spence): error of the friction in %, by cells in the half width of the contact (`contact/incremental_friction`):

| increments | 1 | 4 | 8 | 32 | 64 |
| --- | --- | --- | --- | --- | --- |
| 8 cells | 23 | 2.5 | 2.0 | 0.5 | 0.34 |
| 16 cells | | | | | 0.27 |
| 32 cells | | | | | 0.02 |

Friction of a cylinder and a sphere on a resting flat against Cattaneo and Mindlin (`contact/incremental_friction`, `incremental_sphere`). Their solutions hold for Poisson's ratio 1/2; the tests take 0.45, which limits the agreement.

| | cells | error |
| --- | --- | --- |
| cylinder, mu = 1: second moment of shear | | 2 % |
| cylinder: stick zone (0.77) | 8, 16 | 0.06, 0.02 |
| sphere: stick radius (0.81) | 3 to 6 | 0.12 to 0.04, too small |
| sphere: compliance | 3 to 6 | 0.2 to 5.1 % |

| example: localized stress against the direct run | difference |
| --- | --- |
| `prm/examples/mesh/round_fibres` | 4 % of von Mises stress (root mean square) |
| `prm/examples/mesh/own_body`, upper and lower half | mean von Mises stress 3.8 and 1.9 %, mean pressure 0.5 and 0.4 % |
| `prm/examples/voxels/pad`, contact surface | 24 %, in the matrix 14 % of -sigma_zz |

## Other comparisons

| what | compared with | agreement | test |
| --- | --- | --- | --- |
| stiffness and modes of random phase maps | dense code in Python | 1e-8 | `volumes/independent_finite_elements` |
| conductivity under every condition | dense NumPy | 1e-9 | `volumes/conductivity` |
| macroscopic loads, mixed conditions, thermal expansion | dense NumPy, closed forms | | `volumes/macroscopic_loads`, `mixed_conditions`, `thermal_expansion` |
| frequencies of a free block, nu = 0.4999 | quadratic cells | 0.5 % | `dynamics/mean_dilatation` |
| speed of waves across layers, extrapolated | Rytov's relation | 1e-6 | `dynamics/layers` |
| decay of a column of two layers | its complex frequency | | `dynamics/damped_layers` |
| plane waves at 15 to 60 degrees that an absorbing top reflects | coefficients of dashpots | order 2 | `contact/absorbing_layer` |
| times for which a block on a spring sticks and slides | closed form | 0.2, 1 % | `contact/falling_friction` |
| localized stress of the statically compressed pin | direct solution | below 1 % in the interior | `contact/static_localization` |
| largest strains | uniaxial compression, free body | | `contact/large_strains` |
| [complex modes](glossary.md#complex-modes) of heterogeneous pins, and their growth | scipy, runs | | `system/sliding/complex_modes`, `system/pages/prediction` |
| complex modes at an angle in 3D | closed form, numpy | | `contact/oblique_modes` |
| random pairs of bodies: steps, rest, modes | dense matrices | | `contact/random_pairs`, `random_surfaces`, `random_pairs_at_rest` |
| growing waves of two layers, of half-spaces | exact | | `contact/two_layers`, `half_spaces` |
| two bodies pressed, displaced | Hertz, Cattaneo and Mindlin | | `contact/hertz_pair`, `equal_bodies` |
| slip pulse between two bodies | Weertman, Rayleigh speed | 0.5 % | `contact/interface_pulse` |
| arrival of a rupture, data of SCEC's TPV3 | spectral boundary integral code | 0.5 % | `contact/rupture_times` |
| voxels exported to FANS | FANS, by hand | 1.3e-8 | |

Further comparisons: [stability](stability/README.md) (time step, a million steps, refinement), [run time against error](performance/work_precision.md), [numbers of the paper](paper/README.md).

## Not covered

* The published curves of SCEC's benchmarks of rupture: mesoslip has no input for initial stresses that differ along a fault, and TPV3 and TPV5 are 3D problems.
* Sliding after the first separation: there is no exact solution, only refinement, the energy balance and the paper.
* Stresses at corners of fibres do not converge; the order of convergence is known for the stiffness only.
"""
