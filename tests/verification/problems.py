"""The verification problems: what has to come out, which tests assert it, and in which order errors have to fall."""

_UNIT, _UNIT_RANKS, _SERIAL, _RANKS = "unit_serial: ", "unit_ranks: ", "verification_serial: ", "verification_ranks: "

# (problem, what has to come out, tests)
PROBLEMS = [
    ("Cell", "eigenvalues of the square cell; rigid motion and constant strain; sum of the lumped masses; growth just above the limit and none below it",
     [_UNIT_RANKS + "Element.EigenvaluesOfTheSquare", _UNIT_RANKS + "UniformGridOperator.RigidMotionAndConstantStrain",
      _UNIT_RANKS + "UniformMaterial.MassAndChecks", _UNIT_RANKS + "CriticalTimeStep.ObservedStability"]),
    ("Modes of the rectangle", "f = c/2 sqrt((m/L)^2 + ((2n+1)/(2H))^2): order 2 in h and, at beta2 = 1/2, in dt; order 1 beyond; decay by beta and beta2 from "
     "the product of the scheme's eigenvalues; energy constant to 1e-12",
     [_SERIAL + "Rectangle.FrequenciesConvergeWithOrderTwo", _SERIAL + "Rectangle.MotionConvergesWithOrderTwoInSpaceAndTime",
      _SERIAL + "Rectangle.OrderInTime", _SERIAL + "Rectangle.DecaysByBetaAndByBeta2", _SERIAL + "Rectangle.EnergyBoundedWithoutTrend",
      _SERIAL + "Modes.OfTheRectangleConvergeWithOrderTwo"]),
    ("Bar on a rigid wall", "contact from 0.5 to 1.1667, pressure rho c v, leaves as it came (Doyen, Ern, Piperno 2011); energy lost O(h) at beta2 = 1/2, O(sqrt h) at 1",
     [_SERIAL + "Bar.HitsTheWallAndLeaves", _SERIAL + "Bar.EnergyLossOfOneImpact"]),
    ("Box of bricks on a rigid wall", "the same bar in 3D, with the orders of that in the plane: impact, energy lost, first bounce under gravity",
     [_SERIAL + "BoxBar." + name for name in ("HitsTheWallAndLeaves", "EnergyLossOfOneImpact", "FirstBounceUnderGravity")]),
    ("Bar bouncing under gravity", "pressure rho c (v + g t) and impulse of the first bounce; later bounces gain no energy",
     [_SERIAL + "Bar.FirstBounceUnderGravity", _SERIAL + "Bar.BouncingUnderGravityGainsNoEnergy"]),
    ("Friction at a point", "step of the normal stress (figure 2), ramp and the mean of eq. (11) exact; harmonic force of order 2 in dt; plain Coulomb; block thrown on a plane stops after v^2/(2 mu g)",
     [_UNIT + "FrictionLaw.RelaxesAfterANormalStressStepAsFigure2", _UNIT + "FrictionLaw.LagsBehindARamp",
      _UNIT + "FrictionLaw.MeanOverAContactIsThatOfEquation11", _UNIT + "FrictionLaw.SlipRateThatChangesFromStepToStep",
      _UNIT + "FrictionLaw.FiltersAHarmonicNormalForce", _UNIT + "FrictionLaw.CoulombAtOnce", _UNIT + "Block.ThrownOnAPlane"]),
    ("Column thrown along the flat", "slides with v - a, v - 3 a, ... (a = mu P / (rho c)) for a round trip of the shear wave each, then sticks and swings: slip of order 1 "
     "(fronts), work of friction mu P times the slip", [_SERIAL + "Column.BrakesInStepsAndSticks"]),
    ("Growth of steady sliding", "growth rate and frequency from the exact dispersion relation, within 1 % at H/80; order 2 in h and dt; the time step alone as the relation "
     "discrete in time says", [_SERIAL + "Growth." + name for name in ("Coulomb", "RegularizedAndDamped", "OfOrderTwoInTheTimeStep")]),
    ("Sliding with neither damping nor regularization", "grows on the grid itself at the eigenvalue of its surface wave, at a rate proportional to 1/h; beta or delta of the "
     "paper stop it", [_SERIAL + "Growth.OfTheGridWithoutDampingAndRegularization"]),
    ("Sliding boxes of bricks", "the column, thrown at an angle to the axes, and the growth of the layer, with the orders of those in the plane; waves at 0, 30, 45 and "
     "60 degrees to the motion within 1 %, at 45 degrees refined along all three axes: order 2",
     [_SERIAL + "BoxColumn.BrakesInStepsAndSticks"] + [_SERIAL + "BoxGrowth." + name for name in ("Coulomb", "RegularizedAndDamped", "OfOrderTwoInTheTimeStep")]
     + [_SERIAL + "BoxWaves." + name for name in ("AtAllAngles", "OfOrderTwoInTheCellSize")]),
    ("Energy balance", "closes to 1e-12 of the largest energy with every term from its own formula: tops, stops, damping, gravity, free vibration; below 1e-3 of the "
     "friction work in a coarse pin at 5 MPa sampled every 50 steps",
     [_SERIAL + "Energy." + name for name in ("ClosesUnderEveryTop", "ClosesOverAProfile", "ClosesOnSpringsAlongTheFlat", "ClosesWhenTheTopIsStopped", "ClosesWithEverythingElse",
                                                "FreeVibrationLosesNothing", "EveryTermWhereItBelongs",
                                                "DampingIsBetaTimesTheWorkOfTheOperator", "ClosesWithSparseSamples")]),
    ("Supports of the top", "column on springs, with mass and under a platen on springs: Z omega tan(omega H/c) = k - m omega^2, order 2; a dashpot z sends back "
     "((Z - z)/(Z + z))^2 of the energy, the impedances of a turned solid below 1e-3; a driven far end; balance to 1e-12; a block that sticks and slips; growth of a "
     "layer on springs and dashpots, order 2",
     [_SERIAL + "Supports." + name for name in ("ColumnOnSpringsHasItsFrequency", "DashpotsReflectByTheirImpedance", "TurnedSolidsAreAbsorbed", "FarEndDrivesTheColumn",
                                                "MovesWithItsFarEnd", "EnergyCloses", "BlockOnASpringSticksAndSlips")]
     + [_RANKS + "ComplexModes.OfTheLayerThatHangsOnSprings"]),
    ("Profile of the flat", "pressure of a sine that moves below a half space at 700 and 1500 m/s, of order two",
     [_SERIAL + "Profile.MovesAWaveOfKnownPressureThroughTheBody"]),
    ("Springs along the flat", "a column sticks on springs: tan(q H) = -q G/k_t, order 2, its loss falls with order 3; loss of slow sliding to and fro",
     [_SERIAL + "TangentialSprings." + name for name in ("ColumnVibratesOnThem", "LoopOfSlowSlidingHasItsArea")]),
    ("Momentum", "its rate is the forces at top and bottom, to 1e-12", [_SERIAL + "Momentum.IsWhatTheForcesAtTopAndBottomSay"]),
    ("Homogenization", "homogeneous volume; laminate and its turned copy; equal shear moduli (order 2 but for a logarithm); Hill-Mandel, symmetry, phase means; Reuss <= SUBC "
     "<= PBC <= KUBC <= Voigt; refinement softens; eq. (10)",
     [_RANKS + "Homogenization." + name for name in ("HomogeneousVolumeReturnsItsStiffness", "PeriodicLaminate", "EqualShearModuli",
                                                              "IdentitiesOfEverySolve", "RefinementSoftens",
                                                              "PaperPin")] + [_RANKS + "RandomMicrostructures.KeepOrderAndIdentities"]),
    ("Localization", "a uniform macroscopic strain returns the solution of the RVE; strains interpolated with order 2",
     ["unit_serial: Localize.UniformMacroscopicStrainGivesTheSolutionOfTheRve", "unit_serial: StrainInterpolation.SecondOrder"]),
    ("The paper's pin", "first modes, bottom free and held (figure 8)", [_SERIAL + "Modes.OfThePaperPin"]),
    ("Column under a platen with mass", "bottom held: r a tan a = 1, bottom free: r a + tan a = 0, a = 2 pi f H / c_L, r = mass of the platen over that of the column; order 2 in h",
     [_SERIAL + "Modes.OfAColumnUnderAPlatenWithMass"]),
    ("Static contact", "uniform compression, sliding layer, laminate under a platen (table 4), partial separation, balance of forces",
     [_SERIAL + "StaticContact." + name for name in ("UniformCompression", "SlidingLayer", "LaminateUnderPlaten", "FibresUnderPlatenBalance",
                                                      "PartialSeparation", "RestingFlat")]),
    ("Operator against a mesh of deal.II", "the same product on random fields, materials and grids (seeds printed)",
     [_UNIT_RANKS + "MeshBody.EqualsGridBody", _RANKS + "Homogenization.EqualsMeshOfTheSameCells"]),
    ("Ranks", "one, two and more ranks give the same run (this page runs on one; `./test.sh` on two as well, and the programs on up to five)",
     [_UNIT_RANKS + "Partition.AnyNumberOfRanksAndStepsInFlightBitForBit"]),
    ("Restart", "bit by bit the uninterrupted run", [_SERIAL + "Restart.ContinuesBitByBit"]),
    ("Turned, mirrored, scaled", "a turned body vibrates turned; a reversed flat gives the mirror image; metres to millimetres change nothing; (s u, s P, s V)",
     [_SERIAL + "Symmetry.TurnedBodyVibratesTurned", _SERIAL + "Symmetry.ReversedFlatGivesTheMirrorImage",
      _SERIAL + "Symmetry.MillimetresAndTonnes", _SERIAL + "Scaling.PressureAndVelocityTogether",
      _RANKS + "Homogenization.TurnedMorphologyGivesTurnedStiffness",
      _RANKS + "Homogenization.MirroredMorphologyGivesMirroredStiffness", _RANKS + "Homogenization.UnitsChangeNothing"]),
    ("Random microstructures", "fractions, gaps, bounds and identities for drawn morphologies (seeds printed)",
     [_RANKS + "RandomMicrostructures.KeepTheirRules", _RANKS + "RandomMicrostructures.KeepOrderAndIdentities"]),
    ("Random statics", "stiffnesses of drawn volumes (contrast to 1e6, nu to 0.4999, cells to 1:60, 1 x 1 to 64 x 64 cells, soft pores) equal those of a sparse "
     "direct solution to 1e-5, or a warning says how many digits hold; the energy is of second order in the error of the solver",
     [_RANKS + "RandomStatics." + name for name in ("EqualADirectSolution", "AdverseVolumesEqualADirectSolution",
                                                             "StiffInclusionHoldsItsDigits", "EnergiesAreOfSecondOrder")]),
    ("Complex modes", "growth rate and frequency of the sliding layer from the exact dispersion relation, order 2 in h; growth is the power of friction less that of damping",
     [_RANKS + "ComplexModes." + name for name in ("OfTheLayerWithCoulombFriction", "OfTheRegularizedAndDampedLayer",
                                                     "GrowthIsThePowerOfFrictionLessDamping")]),
    ("Friction laws", "every formula and its slopes; velocity weakening and rate and state of order 2 in dt; a step of velocity; slip weakening turns kinetic energy into "
     "work; a block on a spring sticks and slips; Prakash and Clifton's normal stress after a step; each with every regularization of friction and normal stress "
     "against Runge and Kutta's method",
     [_UNIT + "SlipLaw." + name for name in ("Formulas", "SlopesAndTheirBounds", "VelocityWeakeningIsOfOrderTwo", "SlipWeakeningTurnsKineticEnergyIntoWork",
                                                "RateAndStateAfterAStepOfVelocity", "RateAndStateIsOfOrderTwo", "SpringAndBlockStickAndSlip")]
     + [_UNIT + "NormalStressMemory.RelaxesAfterAStepOfTheNormalForce", _UNIT + "LawRegularization.EveryLawWithEveryRegularization"]),
    ("Maps of the contact", "a wave travels through the map as the dispersion relation says; a map changes no step",
     [_SERIAL + "ContactMap." + name for name in ("WavesTravelAsTheDispersionRelationSays", "TakesPartInNoStep")]),
    ("Meshes: waves of the sliding layer", "growth on distorted quadrilaterals and triangles of order 2; in 3D waves across the motion and oblique to it, at 30, 45 and 60 degrees",
     [_SERIAL + "MeshGrowth." + name for name in ("OnQuadrilaterals", "OnTriangles")]
     + [_SERIAL + "MeshWaves." + name for name in ("AcrossTheMotionOfTheFlat", "AcrossTheMotionOfTheFlatWhereTheBodyIsHeldAlongIt",
                                                        "AtAnAngleToTheMotionOfTheFlat", "AtAnAngleUnderFrictionThatLags")]),
    ("Meshes: sliding", "energies close; equal to the grid of the same cells and to the plane body that is extruded; a block thrown askew runs straight and stops after "
     "v^2/(2 mu g); a flat that moves askew turns the solution; the gap follows the shape",
     [_RANKS + "MeshSliding." + name for name in ("EnergiesClose", "EqualsTheGrid", "ExtrudedBodyEqualsThePlaneOne",
                                                          "BlockThrownAskewStopsAfterItsDistance", "TheGapFollowsTheShape")]
     + [_RANKS + "FlatAskew." + name for name in ("TurnsTheSolution", "BlockIsTakenAlong")]),
    ("Meshes: statics and modes", "patch test; six rigid motions; a prism as a chain; layers between periodic sides: waves of order 2, uniform under pressure",
     [_RANKS + "MeshStatics." + name for name in ("PatchTest", "SixRigidMotions", "ModesOfAPrismAreThoseOfAChain")]
     + [_RANKS + "PeriodicLayer." + name for name in ("ModesConvergeToThoseOfWaves", "PressedOnASlidingFlatIsUniform")]),
    ("Meshes: homogenization", "patch test and laminate exact on every kind of cell; a grid handed in as a mesh; an extruded volume is plane strain",
     [_RANKS + "MeshVolume." + name for name in ("PatchTestAndLaminateAreExact", "GridAsMesh", "ExtrudedIsPlaneStrain")]),
    ("Voxels", "operator and solutions are those of the assembled matrix; homogeneous boxes exact; iterations bounded; the explicit step equals that of the mesh of the "
     "same cells; the bound of the time step of a cube is exact",
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

Written by `./run.sh verification`, which runs the tests named here and inserts what they measured; it stops when one fails. The same tests run in
`./test.sh`, where each asserts what this page says has to come out.

## Problems, predicted and observed

{problems}

"a for b": a measured, b from theory or from an independent path. "holds": every assertion of the tests does; there is no single number.

## Orders of convergence

![convergence](verification/convergence.png)

{orders}

From the two finest refinements; dotted lines in the picture have the predicted order. The stiffness with equal shear moduli converges as h^2 (log(1/h) + c): its order is below 2 on any grid, and the test checks the
logarithm. Data: [convergence.csv](verification/convergence.csv).

## The paper's pin on a mesh of deal.II

Largest differences, over the largest value, between ML on a mesh of deal.II that METIS divides and multigrid on the
grid, through the programs with `prm/paper` at its full 560 x 160 cells. They have to be below 1e-8: stiffnesses are
of second order in the tolerance of the solver (1e-8), forces of the static contact of first order. Five minutes of
CPU time; `system/programs/ranks` does the same with smaller bodies.

{pin}

## Beside these

* Predicted and observed limit of the time step, settings under stress, a million steps, refinement, sensitivity: [stability](stability/README.md).
* Error over cost, with extrapolated limits: [work and precision](performance/work_precision.md).
* Numbers of the paper: [paper](paper/README.md).
* Localized stress of the statically compressed pin against the direct solution, below 1 % in the interior: `verification/contact/static_localization`.
* Stiffness and modes of random phase maps, under every kind of condition and top, against a dense finite element code
  written apart in Python, to 1e-8: `verification/volumes/independent_finite_elements`.
* Phases that hardly change their volume (Poisson's ratio 0.4999): frequencies of a free block within 0.5 % of those
  of quadratic cells (`verification/dynamics/mean_dilatation`), shears of round inclusions within 0.14 % of Eshelby's
  (`verification/volumes/mesh_inclusions`); quadratic cells of all kinds against a code written apart, to 1e-9
  (`verification/volumes/quadratic_cells`).
* Largest strains against those of a column that is compressed alone and of a free body in equilibrium: `verification/contact/large_strains`.
* Meshes of round bodies: the hexagonal cell of code_aster's HPLV106 (`verification/volumes/hexagonal_cell`), one round or spherical inclusion,
  and the strains of Lame's thick ring and shell in the coat of a hole or a core, of order 2 (`verification/volumes/mesh_inclusions`), Hertz
  (`verification/contact/hertz`, `hertz_sphere`): the radius of the contact is off by 0.42, 0.09 and 0.02 % with 8, 16 and 32 cells across it in 2D (order 2), by 3.4, 0.37
  and 0.14 % with 3, 6 and 12 in 3D, the peak pressure on the finest meshes by 0.02 and 0.2 %; Spence's indenter with friction (`verification/contact/spence`).
* Stiffness of voxels against [FANS](https://github.com/DataAnalyticsEngineering/FANS) 0.6.2 (commit d3ff337), the solver by Fourier transforms of another group, with the
  same trilinear elements (HEX8), periodic: all 21 entries of spheres of contrast 8 and 100 and of three phases at random differ by 5e-14 to 4e-12 of the largest one,
  and each entry by at most 2e-10 of itself ([table](performance/fans.csv), [entries](performance/fans-entries.csv)); `./run.sh benchmarks fans --fans FANS` repeats it.
* Boxes of voxels against a finite element code in scipy (`verification/voxels/voxels`), every kind of voxel file against NumPy (`verification/voxels/voxel_files`), ensembles
  and turned phases (`verification/voxels/voxel_random`), orientations by cell (`verification/voxels/voxel_orientations`, `system/sliding/oriented_boxes`).
* Macroscopic loads and mixed uniform conditions against dense NumPy: `verification/volumes/macroscopic_loads`, `verification/volumes/mixed_conditions`.
* Complex modes of heterogeneous pins against scipy, and their growth in runs: `system/sliding/complex_modes`, `system/pages/prediction`;
  at an angle to the sliding in 3D against a closed form and numpy: `verification/contact/oblique_modes`.
* Two bodies: random pairs against dense matrices, step by step, at rest, in modes and complex modes, with nodes that match or not (`verification/contact/random_pairs`, `random_surfaces`, `random_pairs_at_rest`);
  growing waves of two layers and of half-spaces (`two_layers`, `half_spaces`); Hertz and Cattaneo and Mindlin of two bodies (`hertz_pair`, `equal_bodies`); Weertman's pulse at
  the generalized Rayleigh speed, within 0.5 % (`interface_pulse`); when a rupture arrives along a fault with the material, stresses and friction of SCEC's TPV3, within 0.5 % of
  a spectral boundary integral code (`rupture_times`).

## Not covered

* The published curves of SCEC's benchmarks of rupture: initial stresses that differ along a fault are no input here, and TPV3 and TPV5 are problems in 3D. A plane rupture of their kind is compared
  with another method (above).
* Growth of sliding is compared in the linear range. What follows the first separation has no exact solution; for it there are refinement, the
  energy balance and the paper.
* The order at corners of fibres is known for the stiffness, not for the stresses, which do not converge there.
"""
