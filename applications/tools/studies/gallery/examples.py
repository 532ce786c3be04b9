"""What the gallery shows of each example."""

import dataclasses
import typing

import bimaterial
import blocks
import damping
import disc
import laws
import roughness
import tribometer


@dataclasses.dataclass(frozen=True)
class Example:
    """`targets`: files or folders of prm/examples that run one after the other, files with `program`. `figure`: how the text of the
    picture in the report begins; `pictured`: the folder of the run that has it, where it is not the first one. `draw(folder of the runs,
    path)` draws a picture that no report has. `changes`: (folder, keys) of each run, where the file runs several times with other keys."""
    title: str
    text: str
    targets: tuple
    figure: str
    program: str = ""
    pictured: str = ""
    draw: typing.Callable = None
    changes: tuple = ()


RVE, CONTACT = "rve_homogenization", "contact_dynamics"
EXAMPLES = (
    Example("From a map of phases to localized stress",
            "A text file with a number for each cell becomes a composite that slides on the flat ([first steps](first_steps.md)).", ("image",), "Von Mises stress averaged over time"),
    Example("From a micrograph to localized stress",
            "The same from a grey picture with noise, which a short script segments ([guide](guide.md)).", ("micrograph",),
            "Von Mises stress of the last snapshot of the heterogeneous run"),
    Example("A pin with fibres whose friction differs",
            "Sliding, static contact (in the picture), homogenized friction, and localized stresses.", ("fibres",), "Static contact of"),
    Example("Effective stiffness of random fibres",
            "KUBC, SUBC and periodic conditions on one morphology, and the scatter over several.", ("homogenization.prm",), "Phases of", RVE),
    Example("Stresses in fibres and matrix under a load of one's own",
            "Tension, shear under pressure and confined compression ([loads](loads.md)).", ("loads.prm",),
            "Stresses in loads under the load shear under pressure", RVE),
    Example("Stresses that cooling leaves",
            "Glass spheres in epoxy: stiffness, expansion, loss factors, and stresses of 100 K of cooling "
            "([composites](composites.md)).", ("voxels/curing.prm",), "Stresses in curing under the load cold under tension", RVE),
    Example("Modes of vibration of the paper's pin", "Lowest frequencies and shapes, with the bottom free and held.", ("modal.prm",), "Lowest modes", CONTACT),
    Example("Which vibrations of sliding grow",
            "Complex modes of the pin in steady sliding ([page](complex_modes/README.md)).", ("complex_modes.prm",),
            "Modes of steady sliding", CONTACT),
    Example("A pin that squeals", "A mode of the example above grows into a limit cycle, in which nodes stick and separate ([squeal](guide/squeal.md)).",
            ("squeal.prm",), "Map of the contact", CONTACT),
    Example("Waves in the contact", "Pressure, traction, slip velocity and state of every node over time ([contact maps](contact_maps.md)).",
            ("contact_map.prm",), "The last periods of the map", CONTACT),
    Example("How sliding begins", "Slip grows from the edges of the contact until all of it slides.", ("contact_map_onset.prm",), "Map of the contact", CONTACT),
    Example("Stick and slip of a tribometer", "A pin on a spring, with the mass of its holder, is pulled over the flat ([supports](guide/supports.md)).",
            ("tribometer.prm",), "Apparent friction", CONTACT),
    Example("From stick and slip to continuous sliding",
            "The pin with a dashpot beside its spring: sixteen runs over `Supports/Top/Spring stiffness` and `Flat/Velocity`. Above each panel: the share "
            "of time in which most of the contact sticks, in brackets the share of a rigid block. Grey stripes are ruptures that begin at an edge and stop.",
            ("tribometer_map.prm",), "", CONTACT, draw=tribometer.draw, changes=tribometer.CHANGES),
    Example("A block pulled through a spring",
            "The far end of springs pulls a block with a mass over the flat at rest; mass-proportional damping shortens the jumps "
            "([supports](guide/supports.md)).", ("pulled_block.prm",), "Apparent friction", CONTACT),
    Example("Where a pin slips, sticks and separates",
            "A map of 80 runs over pressure and friction; above the black line complex modes grow ([maps](maps.md)).", ("regime_map.prm",), "Regime of the reference node", CONTACT),
    Example("Stick and slip, or sliding: two branches",
            "While the velocity of the flat rises the pin sticks and slips; while the velocity falls the pin slides steadily "
            "([maps](maps.md#branches-points-that-start-from-their-neighbours)).",
            ("branches.prm",), "Regime of the reference node (colours", CONTACT),
    Example("Ruptures under slip weakening",
            "The flat shears a pad; ruptures run through its contact and heal.",
            ("friction_laws/rupture.prm",), "Contact states", CONTACT),
    Example("A rupture in a half-space",
            "The top and sides of the body absorb waves: a rupture runs through the contact once ([supports](guide/supports.md)).", ("half_space.prm",), "Map of the contact", CONTACT),
    Example("A pin on a wavy flat",
            "The flat has waves of 4 mm and 1.1 mm length, whose crests move along the pin ([supports](guide/supports.md)).", ("rough_pin.prm",), "Map of the contact", CONTACT),
    Example("A rough contact rubbed to and fro",
            "A pin on a profile from a table, with normal springs of a power law and tangential springs; the flat swings by 2 µm "
            "([supports](guide/supports.md)).", ("roughness/hysteresis.prm",), "", CONTACT, draw=roughness.draw),
    Example("A damping layer",
            "A polymer below the holder, with damping of its own: no vibration up to 130 kHz grows any more ([supports](guide/supports.md)). "
            "Vibrations that decay faster than 30,000 1/s are not listed.",
            ("damping_layer",), "", draw=damping.draw),
    Example("A pin on a deformable disc",
            "The pin that squeals, on discs instead of the rigid flat "
            "([disc](guide/disc.md)).", ("disc.prm",), "", CONTACT, draw=disc.draw, changes=disc.CHANGES),
    Example("A pin with fibres on a disc",
            "The composite and the homogenized pin squeal on the steel disc at 115 and 117 kHz, with the same friction within 3 %.", ("disc_fibres",), "Von Mises stress averaged over time"),
    Example("Two identical blocks",
            "Endless layers of one material slide on each other without squeal; two blocks squeal at 40 kHz.", ("blocks.prm",), "", CONTACT, draw=blocks.draw),
    Example("A pulse between half-spaces that differ",
            "A short fall of friction at one place starts a pulse of slip, which runs in the slip direction of the body with the slower waves. Equal bodies "
            "have weaker pulses to both sides ([theory](theory.md), section 3).", ("bimaterial.prm",), "", CONTACT, draw=bimaterial.draw, changes=bimaterial.CHANGES),
    Example("Which vibrations grow on a disc",
            "One complex mode of the pin grows on the steel disc, six on the rigid flat.", ("disc_modes.prm",),
            "Modes of steady sliding", CONTACT),
    Example("A step of velocity under rate-and-state friction", "The friction of a block in 3D jumps and falls as the velocity of the flat rises tenfold.",
            ("friction_laws/rate_and_state.prm",), "Apparent friction", CONTACT),
    Example("Five more laws of friction",
            "Traction over pressure of nodes that slip, beside the formula of each law ([theory](theory.md), section 3).",
            tuple(f"friction_laws/{name}.prm" for name in ("static_and_kinetic", "stribeck", "slip_weakening", "table", "expression")), "", CONTACT,
            draw=laws.draw),
    Example("A pin with bevelled edges", "A mesh of Gmsh with chamfered lower edges ([meshes](meshes.md)).", ("mesh/chamfered_pin.prm",),
            "Von Mises stress of the last snapshot", CONTACT),
    Example("A cylindrical pin in 3D",
            "Sliding, modes and static contact (in the picture) of a mesh of hexahedra.",
            ("mesh/cylinder.prm", "mesh/cylinder_modes.prm", "mesh/cylinder_static.prm"), "Static contact of", CONTACT, "cylinder_static"),
    Example("Round fibres in a pin", "A mesh that follows the edges of the fibres, the homogenized pin, and localization.", ("mesh/round_fibres",),
            "Von Mises stress averaged over time"),
    Example("A body that is no box",
            "Gmsh scripts for a composite pin and its material, stresses at two points beside the direct run "
            "([meshes](meshes.md#a-body-of-your-own)).", ("mesh/own_body",), "Von Mises stress of the last snapshot of the heterogeneous"),
    Example("A periodic cell with round fibres", "Effective stiffness and concentration tensors of a mesh.", ("mesh/fibre_cell.prm",), "Von Mises stress in", RVE),
    Example("Spheres in a periodic cube", "Tetrahedra in 3D, six load cases.", ("mesh/spheres.prm",), "Von Mises stress in", RVE),
    Example("Two crossing fibres as voxels", "A `.npy` of phases in 3D ([voxels](voxels.md)).", ("voxels/two_fibres.prm",), "Von Mises stress in", RVE),
    Example("A polycrystal of copper",
            "Sixty grains of one phase, with orientations from a file ([voxels](voxels.md#orientation-of-the-cells)).",
            ("voxels/polycrystal.prm",), "Von Mises stress in", RVE),
    Example("An ensemble of random fibres in 3D", "Four seeds of periodic continuous fibres along z.", ("voxels/random_fibres.prm",), "Phases of", RVE),
    Example("A pad of short fibres in 3D",
            "Homogenization, sliding and localization of a box of voxels.", ("voxels/pad",),
            "Pressure on the contact surface, seen"),
    Example("From a tomogram to localized stress",
            "A grey scan, its phases, and a sample that slides on the flat ([tomogram](guide/tomogram.md)).", ("tomogram",),
            "Pressure on the contact surface, seen"),
)
