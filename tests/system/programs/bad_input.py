"""Bad input ends with exit status 2 and one sentence that names what is wrong."""

import os
import re
import tempfile

from scenes import ENVIRONMENT, PHASES, SMALL_GRID, SMALL_RVE as RVE, TOP, Folder, prm, sets

IMAGE = PHASES + SMALL_GRID + prm({"Microstructure/Type": "image"})
HOMOGENEOUS = PHASES + SMALL_GRID + prm({"Microstructure/Type": "homogeneous"})
LOADED = RVE + prm({"Loads/Names": "pull", "Loads/pull/Stress xx": 1e8})
MODAL = "set Analysis = modal\n"
LOCAL = prm({"Input/RVE file": "rve.h5"})
BODY = prm({"Body/Cells": "20, 10", "Body/Size": "0.002, 0.001"})
STATIC = "set Analysis = static contact\n" + BODY
CONTACT = BODY + prm({"Time/End time": 1e-6})

# program, text of the .prm, settings or other options, words that have to be in the sentence
CASES = [
    ("rve_homogenization", RVE + "set Colour = red\n", [], ["Colour", ":"]),
    ("rve_homogenization", RVE, ["Grid/Cels=3, 4"], ["Cels", "Cells"]),
    ("rve_homogenization", RVE, ["Phases/matrix/Poisson ratio=0.5"], ["Poisson ratio"]),
    ("rve_homogenization", RVE, ["Phases/matrix/Young modulus=-1"], ["Young modulus"]),
    ("rve_homogenization", RVE, ["Microstructure/Random fibres/Area fraction=1.5"], ["Area fraction"]),
    ("rve_homogenization", RVE, ["Microstructure/Random fibres/Fibre width=1e-6"], ["Fibre width"]),
    ("rve_homogenization", RVE, ["Homogenization/Boundary conditions=KUBD"], ["Boundary conditions", "KUBC"]),
    ("rve_homogenization", RVE, ["Homogenization/Effective=PBC"], ["Effective", "PBC"]),
    ("rve_homogenization", LOADED, ["Loads/pull/Strain xx=1e-3"], ["Loads/pull/Strain xx", "Stress xx", "both", "remove one"]),
    ("rve_homogenization", LOADED, ["Loads/pull/Stress xx=nan"], ["Loads/pull/Stress xx", "nan"]),
    ("rve_homogenization", LOADED, ["Loads/pull/Stress xx=0"], ["Loads/pull", "not 0", "Stress xx"]),
    ("rve_homogenization", LOADED, ["Loads/pull/Stress xx=1e-320"], ["Loads/pull/Stress xx", "1e-320", "from 1e-100 to 1e100"]),
    ("rve_homogenization", LOADED, ["Loads/pull/Stress zz=1e6"], ["Loads/pull/Stress zz", "plane strain", "remove it"]),
    ("rve_homogenization", LOADED, ["Loads/pull/Stres yy=1e6"], ["Stres yy", "Stress yy"]),
    ("rve_homogenization", LOADED, ["Loads/Names=pull, pull"], ["Loads/Names", "two loads named 'pull'"]),
    ("rve_homogenization", LOADED, ["Loads/Boundary conditions=PBC"], ["Loads/Boundary conditions", "PBC", "Homogenization/Boundary conditions"]),
    ("rve_homogenization", LOADED, ["Loads/Von Mises limit=1e6, 2e6, 3e6"], ["Loads/Von Mises limit", "3 numbers for 2 phases"]),
    ("rve_homogenization", LOADED.replace("set Young modulus = 30e9", "", 1), ["Loads/Von Mises limit=1e6", "Phases/matrix/Type=stiffness", "Phases/matrix/Stiffness=3e10, 1e10, 3e10, 1e10"],
     ["Von Mises limit", "sigma_zz", "Phases/matrix/Type"]),
    ("rve_homogenization", RVE, ["Loads/Von Mises limit=1e6"], ["Loads/Von Mises limit", "no loads", "Loads/Names"]),
    ("rve_homogenization", IMAGE, ["Microstructure/File=no.png"], ["no.png"]),
    # To open a pipe would wait for who writes to it.
    *((program, text, [setting], ["pipe", "is a pipe or a device", "save it as one"]) for program, text, setting in (
        ("rve_homogenization", IMAGE, "Microstructure/File=pipe"), ("rve_homogenization", PHASES, "Mesh/File=pipe"),
        ("contact_dynamics", CONTACT, "Body/RVE file=pipe"), ("stress_localization", LOCAL, "Input/RVE file=pipe"))),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=table", "Friction/Table=pipe"], ["pipe", "is a pipe or a device"]),
    ("rve_homogenization", "subsection Phases\n set Names = " + ", ".join(f"p{k}" for k in range(20000)) + "\nend\n", [],
     ["Phases/Names", "there are 20000 phases"]),
    ("contact_dynamics", CONTACT, ["Body/RVE file=no.h5"], ["RVE file", "no.h5", "rve_homogenization"]),
    ("contact_dynamics", CONTACT, ["Body/Material=heterogeneous"], ["RVE file"]),
    ("contact_dynamics", CONTACT, ["Body/RVE file=rve.h5", "Phases/Names=a"], ["section Phases has no effect", "Body/RVE file"]),
    ("contact_dynamics", CONTACT, ["Performance/Instruction set=generic"], ["'generic' on this kind of processor", "auto"]),
    ("contact_dynamics", CONTACT, ["Body/RVE file=case.prm"], ["case.prm", "HDF5"]),
    ("contact_dynamics", CONTACT, ["Time/Time step=1e-7"], ["Time step", "critical"]),
    ("contact_dynamics", CONTACT, ["Time/Beta2=0.3"], ["Beta2"]),
    ("contact_dynamics", CONTACT, ["Body/Stiffness=1e9, 2e9, 1e9, 1e9"], ["Body/Stiffness", "1e+09, 2e+09", "positive definite", "D12^2"]),
    ("contact_dynamics", CONTACT, ["Body/Size=0.01"], ["Size"]),
    ("contact_dynamics", CONTACT, ["Flat/Expression=2*frog(t)"], ["Expression"]),
    ("contact_dynamics", CONTACT, ["Flat/Expression=2,5"], ["Flat/Expression", "2,5", "point"]),
    ("contact_dynamics", CONTACT, ["Supports/Top/Expression=0,5e6*t"], ["Supports/Top/Expression", "0,5", "point"]),
    ("contact_dynamics", CONTACT, ["Supports/Top/Expression=min(0,5, t)"], ["Supports/Top/Expression", "0,5", "min()", "point"]),
    ("contact_dynamics", CONTACT, ["Observation/Steady from=1"], ["Steady from: 1 s", "End time, 1e-06 s", "earlier"]),
    ("contact_dynamics", CONTACT, ["Observation/Steady from=9.9e-7", "Observation/History interval=1"], ["Steady from: 9.9e-07 s", "three samples"]),
    ("contact_dynamics", CONTACT, ["Observation/Probes=A"], ["Observation/A/Position", "missing"]),
    ("contact_dynamics", CONTACT, ["Time/Rayleigh beta=44"], ["memory", "Rayleigh beta = 44 s", "times shorter", "times are in s"]),
    ("contact_dynamics", CONTACT, ["Time/Time step=1e-18"], ["memory", "1e+12 steps of 1e-18 s (Time/Time step)"]),
    ("contact_dynamics", "# no key at all\n", [], ["case.prm", "no key"]),
    ("rve_homogenization", IMAGE, [], ["Microstructure/File", "no file is named", "image"]),
    ("rve_homogenization", SMALL_GRID, [], ["'Phases/matrix/Young modulus' is 0", "Type = orthotropic", "Type = stiffness", "void"]),
    ("rve_homogenization", RVE, ["Grid/Size=1e-300, 1e-300"], ["Grid/Size", "in [1e-15, 1e+09]"]),
    ("contact_dynamics", CONTACT, ["Body/Size=1e-300, 1e-300"], ["Body/Size", "in [1e-15, 1e+09]"]),
    ("contact_dynamics", CONTACT, ["Body/Size=1e300, 1e300"], ["Body/Size", "in [1e-15, 1e+09]"]),
    ("contact_dynamics", CONTACT, ["Body/Stiffness=1e300, 0, 1e300, 1e300"], ["Body/Stiffness", "in [-1e+20, 1e+20]"]),
    ("contact_dynamics", CONTACT, ["Body/Density=1e-300"], ["Body/Density", "in [1e-09, 1e+12]"]),
    ("contact_dynamics", CONTACT, ["Flat/Expression=2*rand()"], ["Flat/Expression", "rand()", "same in every run"]),
    ("contact_dynamics", CONTACT, ["Supports/Top/Expression=rand_seed (3)"], ["Supports/Top/Expression", "rand_seed()"]),
    ("contact_dynamics", CONTACT, ["Flat/Expression=t=3"], ["Flat/Expression", "'t=3'", "'=='"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient from=phases"], ["Coefficient from"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=Stribeck", "Friction/Kinetic coefficient=-1"], ["Kinetic coefficient", ">= 0"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=Stribeck", "Friction/Critical velocity=0"], ["Critical velocity", "> 0"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=Stribeck", "Friction/Stribeck exponent=0.5"], ["Stribeck exponent"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=Stribeck", "Friction/Coefficient=0"], ["Friction/Coefficient", "refers to it"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=rate and state", "Friction/Rate and state/Length=0"], ["Length", "> 0"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=rate and state", "Friction/Rate and state/Length=nan"], ["Length", "> 0"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=table", "Friction/Table=none.csv"], ["none.csv"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=expression", "Friction/Coefficient expression=0,3"], ["Coefficient expression", "decimals have a point"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=expression", "Friction/Coefficient expression=0.3 + y"], ["is not an expression in V, D, p, t, x"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=expression", "Friction/Coefficient expression=0.3 - V"], ["speed of the flat", "negative"]),
    ("contact_dynamics", BODY, ["Analysis=static contact", "Friction/Coefficient law=expression", "Friction/Coefficient expression=0.3 + x"], ["place", "transient run"]),
    ("contact_dynamics", BODY, ["Analysis=static contact", "Flat/Velocity=0", "Friction/Coefficient law=rate and state"], ["no coefficient at rest", "Flat/Velocity"]),
    ("contact_dynamics", CONTACT, ["Observation/Reference x=1"], ["Reference x"]),
    ("contact_dynamics", CONTACT + "subsection Observation\n set Probes = A\n subsection A\n set Position = 1, 1\n end\nend\n",
     [], ["A/Position", "outside"]),
    ("contact_dynamics", CONTACT + "subsection Time\n set End time = 2e-6\nend\n", [], ["End time", "again"]),
    ("contact_dynamics", "subsection Time\n", [], ["case.prm"]),
    ("contact_dynamics", "", [], ["case.prm"]),
    ("stress_localization", "subsection Input\n set RVE file = no.h5\nend\n", [], ["RVE file", "no.h5"]),
    # Files of another program. One that has sections of its own as well is not.
    ("contact_dynamics", RVE, [], ["case.prm:", "file of rve_homogenization", "'Grid'", "run rve_homogenization"]),
    ("stress_localization", RVE, ["--print-parameters"], ["file of rve_homogenization"]),
    ("rve_homogenization", CONTACT, ["--validate"], ["case.prm:1: ", "file of contact_dynamics", "'Body'"]),
    ("stress_localization", CONTACT, [], ["file of contact_dynamics"]),
    ("contact_dynamics", LOCAL, [], ["file of stress_localization", "'Input'"]),
    ("rve_homogenization", LOCAL, [], ["file of stress_localization"]),
    ("contact_dynamics", CONTACT + SMALL_GRID, [], ["there is no subsection 'Grid'"]),
    ("contact_dynamics", SMALL_GRID + LOCAL, [], ["there is no subsection 'Grid'"]),
    # More than the machine has, found before anything is computed.
    ("rve_homogenization", RVE, ["Grid/Cells=40000, 40000"], ["memory", "Grid/Cells"]),
    ("contact_dynamics", CONTACT, ["Body/Cells=1000000, 1000000"], ["memory", "Body/Cells"]),
    ("contact_dynamics", CONTACT, ["Time/End time=1e4"], ["memory", "History interval"]),
    ("contact_dynamics", CONTACT, ["Time/End time=1", "Observation/History interval=1000000000", "Observation/Energy interval=0", "Snapshots/Interval=1e-12", "Body/Cells=2000, 1000"],
     ["the disk of the output folder", "free", "Snapshots/Interval"]),
    ("contact_dynamics", CONTACT, ["Snapshots/Interval=1e-8", "Snapshots/From=2e-6"],
     ["Snapshots/From", "earlier"]),
    ("contact_dynamics", BODY, ["Analysis=modal", "Modal/Number of modes=500"],
     ["Modal/Number of modes", "500 modes of only 421 free degrees of freedom", "half of them"]),
    ("contact_dynamics", CONTACT, ["Body/Density=1e-9", "Body/Size=1e-15, 1e-15"], ["Time/End time", "1.356e+38 steps", "kg/m^3"]),
    ("contact_dynamics", CONTACT, ["Body/Stiffness=1e-320, 0, 1e-320, 1e-320"], ["Body/Stiffness", "from 1e-100 to 1e100"]),
    ("contact_dynamics", BODY, ["Analysis=static contact", "Friction/Coefficient=5", "Supports/Top/Kind=pressure", "Supports/Top/Held=u_x"], ["tips", "Friction/Coefficient", "half the width"]),
    ("contact_dynamics", STATIC, ["Supports/Top/Kind=held"], ["Supports/Top/Kind"]),
    ("contact_dynamics", CONTACT, ["Supports/Top/Kind=held", "Supports/Top/Pressure=1e5"], ["Supports/Top/Pressure", "has no effect", "Kind"]),
    ("contact_dynamics", CONTACT, ["Supports/Top/Expression=1/t"], ["Supports/Top/Expression", "at t = 0", "inf"]),
    ("contact_dynamics", CONTACT, ["Supports/Top/Pressure=1e300"], ["Supports/Top/Pressure", "from 1e-100 to 1e100"]),
    ("contact_dynamics", STATIC, ["Supports/Top/Kind=pressure", "Flat/Velocity=1"], ["Nothing holds the body"]),
    ("contact_dynamics", STATIC, ["Supports/Top/Kind=pressure", "Supports/Top/Pressure=-1"], ["Supports/Top/Pressure"]),
    ("contact_dynamics", STATIC, ["Supports/Top/Kind=pressure", "Flat/Gap=1e-6"], ["Flat/Gap"]),
    ("contact_dynamics", CONTACT, ["--output", "case.prm"], ["case.prm", "not a folder", "--output"]),
    ("contact_dynamics", CONTACT, ["--output", "case.prm/below"], ["case.prm", "not a folder", "--output"]),
]


# One key of CONTACT in another unit, and words of the sentence about it.
SLIPS = [
    ("Body/Density=1.77", ["Body/Density is 1.77 kg/m^3", "g/cm^3"]),
    ("Friction/Regularization time=1500", ["Friction/Regularization time is 1500 s", "the whole run (1e-06 s)", "times are in s"]),
    ("Friction/Coefficient=25", ["Friction/Coefficient is 25,", "per cent"]),
    ("Flat/Normal stiffness=100", ["Flat/Normal stiffness is 100 Pa/m", "by 5e+04 m", "1e14 Pa/m"]),
    ("Supports/Top/Pressure=5", ["Supports/Top/Pressure is 5 Pa", "by 1.058e-10 only", "MPa"]),
    ("Supports/Top/Pressure=6e8", ["Supports/Top/Pressure is 6e+08 Pa", "by 1.27 %"]),
    ("Supports/Top/Pressure=-5e6", ["Supports/Top/Pressure is -5e+06 Pa", "pulls the body off"]),
    ("Supports/Top/Pressure=0", ["Supports/Top/Pressure is 0", "nothing presses"]),
    ("Supports/Top/Expression=5e6*cos(2*pi*1e6*t)", ["the smallest value of Supports/Top/Expression is -5e+06 Pa"]),
    ("Supports/Top/Hold from=0.1", ["Supports/Top/Hold from is 0.1 s", "never held"]),
    ("Supports/Top/Platen mass=1e4", ["Supports/Top/Platen mass is 1e+04 kg/m", "0.00354 kg/m"]),
    ("Flat/Velocity=2000", ["Flat/Velocity is 2000 m/s", "38.71 % of the speed of waves", "mm/s"]),
    ("Flat/Velocity=1e-12", ["Flat/Velocity is 1e-12 m/s", "atom"]),
    ("Flat/Expression=2e12*t*t*1e3", ["the largest value of Flat/Expression is 2000 m/s"]),
    ("Flat/Gap=0.001", ["Flat/Gap is 0.001 m", "by 1.412e-06 m at most", "never touches"]),
    ("Body/Initial velocity=500, 0", ["Body/Initial velocity along x is 500 m/s", "9.676 %"]),
    ("Time/Time step=1e-12", ["Time/Time step is 1e-12 s", "thousandth of the critical"]),
    ("Observation/History interval=100000", ["Observation/History interval is 1e+05 steps"]),
    ("Snapshots/Interval=1e-3", ["Snapshots/Interval is 0.001 s", "one snapshot only"]),
]
RVE_SLIPS = [
    ("Phases/matrix/Density=1.77", ["Phases/matrix/Density is 1.77 kg/m^3", "g/cm^3"]),
    ("Phases/fibre/Friction coefficient=25", ["Phases/fibre/Friction coefficient is 25,"]),
]
# Keys that others leave without effect: program, text, what is set, words. Not one word about them before.
UNUSED = [
    ("rve_homogenization", RVE, ["Phases/fibre/Young moduli=1e9, 2e9, 3e9"],
     ["Phases/fibre/Young moduli has no effect, as Phases/fibre/Type is 'isotropic'; remove it, or set Phases/fibre/Type = orthotropic"]),
    ("rve_homogenization", RVE, ["Microstructure/Type=homogeneous"], ["case.prm:", "Random fibres/Minimum height", "Random fibres/Maximum height"]),
    ("rve_homogenization", RVE, ["Ensemble/Confidence=0.9"], ["Ensemble/Confidence", "set Ensemble/Members"]),
    ("rve_homogenization", RVE, ["Grid/Spacing=1e-6"], ["case.prm:", "Grid/Size", "20 x 10 um", "leave Grid/Spacing empty"]),
    ("contact_dynamics", CONTACT, ["Analysis=modal"], ["case.prm:", "Time/End time", "Analysis = transient"]),
    ("contact_dynamics", MODAL, ["Supports/Top/Pressure=1e6", "Friction/Coefficient=0.1"], ["Supports/Top/Pressure", "Friction/Coefficient", "Analysis = transient or static contact"]),
    ("contact_dynamics", MODAL, ["Supports/Top/Expression=5e6*t", "Snapshots/Interval=1e-6"], ["Supports/Top/Expression", "Snapshots/Interval", "Analysis = transient"]),
    ("contact_dynamics", MODAL, ["Static contact/Iterations=3"], ["Static contact/Iterations", "Analysis is 'modal'"]),
    ("contact_dynamics", "set Analysis = static contact\n", ["Flat/Expression=2*t"], ["Flat/Expression", "Analysis = transient"]),
    ("contact_dynamics", "set Analysis = friction homogenization\n", ["Body/Cells=2, 2"], ["Body/Cells", "Analysis is 'friction homogenization'"]),
    ("contact_dynamics", CONTACT, ["Modal/Number of modes=2"], ["Modal/Number of modes", "Analysis = modal"]),
    ("contact_dynamics", CONTACT, ["Friction homogenization/Calibrate=true"], ["Calibrate", "Analysis = friction homogenization"]),
    ("contact_dynamics", CONTACT, ["Performance/Static solver=jacobi"], ["Static solver", "Analysis = modal or static contact"]),
    ("contact_dynamics", "subsection Body\n  set RVE file = rve.h5\nend\n", ["Body/Stiffness=1e10, 0, 1e10, 4e9", "Body/Density=2000"],
     ["Body/Stiffness", "Body/Density", "leave Body/RVE file empty"]),
    ("contact_dynamics", CONTACT, ["Body/Stiffness from=KUBC"], ["Stiffness from", "Body/RVE file is empty"]),
    ("contact_dynamics", "subsection Body\n  set RVE file = rve.h5\n  set Material = heterogeneous\nend\n", ["Body/Stiffness from=KUBC"],
     ["Stiffness from", "Body/Material = homogeneous"]),
    ("contact_dynamics", CONTACT, ["Time/Time step=1e-9", "Time/Safety factor=0.5"], ["Safety factor", "Time/Time step = auto"]),
    ("contact_dynamics", CONTACT, ["Supports/Top/Expression=5e6", "Supports/Top/Ramp=linear"], ["Supports/Top/Ramp", "leave Supports/Top/Expression empty"]),
    ("contact_dynamics", CONTACT, ["Flat/Ramp=smooth"], ["Flat/Ramp time", "it is 0, so that the velocity acts at once", "Ramp = step"]),
    ("contact_dynamics", CONTACT, ["Flat/Ramp time=1e-7"], ["Flat/Ramp time", "Flat/Ramp = linear or smooth"]),
    ("contact_dynamics", CONTACT, ["Supports/Top/Held=u_x"], ["Supports/Top/Held", "Supports/Top/Kind = free or pressure"]),
    ("contact_dynamics", CONTACT, ["Supports/Top/Kind=pressure", "Supports/Top/Platen mass=1"], ["Supports/Top/Platen mass", "Supports/Top/Kind = platen"]),
    ("contact_dynamics", CONTACT, ["Supports/Top/Kind=held", "Supports/Top/Hold from=1e-7"], ["Supports/Top/Hold from", "Supports/Top/Kind = pressure or platen"]),
    ("contact_dynamics", CONTACT, ["Friction/Law=coulomb", "Friction/Regularization time=1e-6"], ["Regularization time", "Law = constant time"]),
    ("contact_dynamics", CONTACT, ["Friction/Length=1e-6"], ["Friction/Length", "Law = slip rate"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient from=phases", "Friction/Coefficient=0.1"], ["Friction/Coefficient has", "from = constant"]),
    ("contact_dynamics", CONTACT, ["Friction/Critical slip=1e-6"], ["Critical slip", "Coefficient law = linear slip weakening"]),
    ("contact_dynamics", CONTACT, ["Friction/Rate and state/Direct effect=0.1"], ["Direct effect", "Coefficient law = rate and state"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=Stribeck", "Friction/Healing=none"], ["Friction/Healing", "slip weakening"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=table"], ["Friction/Table", "it is empty"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=expression", "Friction/Coefficient=0.3"], ["Friction/Coefficient has", "say it all"]),
    ("contact_dynamics", CONTACT, ["Friction/Normal stress time=2e-6"], ["Normal stress time", "Normal stress = constant time"]),
    ("contact_dynamics", CONTACT, ["Friction/Node rule=mean"], ["Node rule", "Coefficient from = phases"]),
    ("contact_dynamics", CONTACT, ["Observation/Probe interval=3"], ["Probe interval", "there are no probes"]),
    ("contact_dynamics", CONTACT, ["Snapshots/From=1e-7"], ["Snapshots/From", "set Snapshots/Interval"]),
    ("stress_localization", LOCAL, ["Comparison/Surface depth=1e-3"], ["Surface depth", "Input/Direct run"]),
    ("stress_localization", LOCAL, ["Localization/Fields=mean stress", "Localization/Out-of-plane ratio=0"], ["Out-of-plane ratio", "mean von Mises"])]


# What may be meant as it is, but hardly is: run and --validate say so, and the run ends well.
UNDAMPED = "Time/Rayleigh beta=0"
DARK = ["Microstructure/File=dark.txt", "Microstructure/Image values=0, 1"]
ASKED = [
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=expression", "Friction/Coefficient expression=30"],
     ["the largest friction coefficient, of Friction/Coefficient law at the speed of the flat, is 30", "per cent"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=Stribeck", "Friction/Critical velocity=5000"], ["Friction/Critical velocity is 5000 m/s", "mm/s"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=linear slip weakening", "Friction/Critical slip=0.01"],
     ["Friction/Critical slip is 0.01 m", "more than ten times what the flat moves in the whole run (1e-06 s), 2e-06 m", "lengths are in m"]),
    ("contact_dynamics", CONTACT, ["Friction/Coefficient law=rate and state", "Friction/Rate and state/Length=1"], ["Friction/Rate and state/Length is 1 m"]),
    ("rve_homogenization", IMAGE, DARK, ["phase 'fibre'", "fills no cell"]),
    ("rve_homogenization", RVE, ["Phases/matrix/Young modulus=30", "Phases/fibre/Young modulus=120"],
     ["phase 'matrix'", "less than soft rubber", "in Pa"]),
    ("rve_homogenization", RVE, ["Phases/matrix/Young modulus=1e6", "Phases/fibre/Young modulus=2e12"],
     ["phase 'fibre' is 2e+06 times as stiff as phase 'matrix'", "in Pa"]),
    ("rve_homogenization", RVE, ["Phases/matrix/Poisson ratio=0.4999", "Homogenization/Mean dilatation=never"], ["phase 'matrix' is nearly incompressible", "0.4999", "for n = 20", "Mean dilatation = auto prevents it"]),
    ("contact_dynamics", CONTACT, ["Body/Stiffness=50.2e9, 50e9, 50.2e9, 0.1e9", "Body/Mean dilatation=never"],
     ["nearly incompressible", "fully integrated cells lock"]),
    ("rve_homogenization", HOMOGENEOUS, ["Grid/Size=20, 0.001"], ["Grid/Size along x is 20 m", "mm"]),
    ("contact_dynamics", CONTACT, ["Body/Stiffness=36.5, 9.1, 47.3, 13.8", "Supports/Top/Pressure=5e-3"], ["32.8 Pa", "in Pa"]),
    ("contact_dynamics", CONTACT, ["Body/Size=8, 4"], ["ends before the wave is back", "Body/Size"]),
    ("contact_dynamics", CONTACT, ["Time/Rayleigh beta=1e-6"], ["Rayleigh beta = 1e-06 s", "times shorter"]),
    ("contact_dynamics", CONTACT, [UNDAMPED, "Friction/Law=coulomb"], ["neither regularization", "no grid is fine enough"]),
    ("contact_dynamics", CONTACT, [UNDAMPED, "Friction/Regularization time=0", "Flat/Expression=cos(1e6*t)"],
     ["arning", "neither regularization"]),
    *(("contact_dynamics", CONTACT, [setting], words) for setting, words in SLIPS),
    *(("rve_homogenization", RVE, [setting], words) for setting, words in RVE_SLIPS)]
# What --validate says: program, text, settings, words, words that are not to be there. What is as it should be is not asked
# about; what does not slide, or has damping or regularization, gets no warning about waves of the grid.
MATERIAL = ["Body/Stiffness=1e10, 3e9, 1e10, 3.5e9", "Body/Density=2500", "Time/End time=1e-3"]
VALIDATED = [
    ("rve_homogenization", RVE, [], ["of 0.1 x 0.1 mm, 2 x 1 mm"], ["arning"]),
    ("contact_dynamics", CONTACT, [*MATERIAL, "Body/Size=0.032, 0.016"],
     ["of 1.6 x 1.6 mm, 32 x 16 mm", "0.008 ms from the flat to the top, the run 1 ms", "of memory"], ["ends before"]),
    ("contact_dynamics", CONTACT, [*MATERIAL, "Body/Size=32, 16"],  # ends before the top has felt anything: 16 m at 2000 m/s
     ["of 1.6 x 1.6 m, 32 x 16 m\n", "8 ms from the flat", "it ends before", "Body/Size"], []),
    ("contact_dynamics", "# a pin\r" + CONTACT.replace("\n", "\r"), [], ["20 x 10 cells"], []),
    *(("contact_dynamics", text, settings, [], ["arning"]) for text, settings in (
        (CONTACT, []), (BODY, ["Analysis=modal"]), (BODY, ["Analysis=static contact"]), (CONTACT, ["Flat/Ramp=smooth", "Flat/Ramp time=1e-6"]),
        (CONTACT, ["Flat/Expression=2*cos(2*pi*1e6*t)"]), (CONTACT, ["Supports/Top/Kind=held"]))),
    *(("contact_dynamics", CONTACT, settings, [], ["neither regularization"]) for settings in (
        ["Friction/Law=coulomb"], [UNDAMPED], [UNDAMPED, "Friction/Law=slip rate"], [UNDAMPED, "Friction/Law=coulomb", "Flat/Velocity=0"],
        [UNDAMPED, "Friction/Law=coulomb", "Friction/Coefficient=0"]))]


def lacks(words, said, no_words=()):
    return [f"'{word}'" for word in words if word.lower() not in said.lower()] + [f"no '{word}'" for word in no_words if word in said]


def start(program, text, settings=(), *options):
    """(exit status, output, errors, names of what is new) of a program on a case.prm in a folder of its own."""
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path, {"case": text})
        folder.write("dark.txt", "\ufeff" + "0 0\n")
        os.mkfifo(folder("pipe"))
        before = set(os.listdir(path))
        return *folder.end(program, "case.prm", *sets(settings), *options), set(os.listdir(path)) - before


def refused(program, text, options, words):
    """Exit status 2 and one sentence with the words, and nothing is created."""
    plain = options[0].startswith("--") if options else False
    status, _, err, left = start(program, text, () if plain else options, *(options if plain else ()))
    if status != 2 or err.count("\n") != 1 or not err.startswith(program + ": ") or left or lacks(words, err):
        yield f"{program} {options or repr(text[-40:])}: exit status {status}, left {left}, lacks {lacks(words, err)} in: {err}"


def asked(program, text, settings, words):
    for validate in ([], ["--validate"]):
        status, out, err, _ = start(program, text, settings, *validate)
        if status or lacks(words, out if validate else err):
            yield f"{program} {settings} {validate}: exit status {status}, lacks {lacks(words, out + err)} in: {out}{err}"


def validated(program, text, settings, words, no_words):
    status, out, err, _ = start(program, text, settings, "--validate")
    if status or lacks(words, out + err, no_words):
        yield f"{program} {settings}: exit status {status}, lacks {lacks(words, out + err, no_words)} in: {out}{err}"


def large_strain():
    """A macroscopic strain of 500 %, and a stress that makes one."""
    for load in ("Strain xx = 5", "Stress xx = 1e12"):
        status, _, err, _ = start("rve_homogenization", LOADED.replace("Stress xx = 100000000.0", load))
        if status or err.count("beyond small strains") != 2 or "Load pull, KUBC" not in err:
            yield f"{load}: exit status {status}, {err}"


def same_mesh():
    """A mesh and its copy are no ensemble."""
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path, {"rve": PHASES + prm({"Mesh/File": "a.msh, b.msh"})})
        for name in "ab":
            folder.write(name + ".msh", "$MeshFormat\n")
        status, _, err = folder.end("rve_homogenization", "rve.prm", "--validate")
        if status != 2 or lacks(["a.msh", "b.msh are one mesh", "members of an ensemble"], err):
            yield f"the same mesh twice: exit status {status}, {err}"


def morphology_against_body():
    """The grid of rve.h5 against the pin's: once a file is there."""
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path, {"rve": RVE, "contact": CONTACT})
        folder.run(0, "rve_homogenization", "rve.prm", "--output", "rve")
        before = sorted(os.walk(path))
        for settings, words in (
                (["Body/Size=0.001, 0.001"], ["Body/Size", "0.001 x 0.001", "0.002 x 0.001", "leave Size empty"]),
                (["Body/Size=0.003, 0.001", "Body/Material=heterogeneous"], ["Body/Size", "0.003 x 0.001", "homogeneous body may be larger"]),
                (["Body/Material=heterogeneous", "Body/Cells=30, 10"], ["Body/Cells", "30 x 10", "20 x 10", "multiple"]),
                (["Body/Stiffness from=PBC"], ["/stiffness/PBC", "missing", "boundary conditions"])):
            status, _, err = folder.end("contact_dynamics", "contact.prm", *sets(["Body/RVE file=rve/rve.h5", *settings]))
            if status != 2 or err.count("\n") != 1 or lacks(words, err) or sorted(os.walk(path)) != before:
                yield f"{settings}: exit status {status}, lacks {lacks(words, err)} in: {err}, or files were created"


def sections_of_one_program():
    """Those in lib/program/other_program.cc are those that doc/parameters has for one program alone; but for Phases, which contact_dynamics has on meshes."""
    programs = ("rve_homogenization", "contact_dynamics", "stress_localization")
    has = {program: set(re.findall("^subsection (.+)$", Folder(TOP).read("doc", "parameters", program + ".prm").decode(), re.M)) for program in programs}
    source = Folder(TOP).read("lib", "program", "other_program.cc").decode().split("own_sections()")[1].split("return all")[0]
    for program in programs:
        alone = has[program] - {"Phases"}.union(*(has[other] for other in programs if other != program))
        said = set(re.findall('"([^"]+)"', re.search(rf'"{program}",\s*{{(.*?)}}', source, re.S)[1]))
        if said != alone:
            yield f"{program} alone has {sorted(alone)}; other_program.cc says {sorted(said)}"


def command_lines():
    """A file with all keys, as every run leaves it, is accepted, though some of them have no effect; arguments that are wrong."""
    for program, text in (("rve_homogenization", RVE), ("contact_dynamics", CONTACT), ("contact_dynamics", MODAL)):
        yield from validated(program, start(program, text, (), "--print-parameters")[1], [], [], [])
    for program in ("rve_homogenization", "contact_dynamics", "stress_localization"):
        for arguments in (["missing.prm"], ["/"], ["--unknown"], []):
            with tempfile.TemporaryDirectory() as path:
                status, _, err = Folder(path).end(program, *arguments)
                if status != 2 or err.count("\n") != 1 or os.listdir(path):
                    yield f"{program} {arguments}: exit status {status}, {err}, created {os.listdir(path)}"


def unknown_kernels():
    """An instruction set that does not exist is refused before anything runs."""
    for program, text in (("rve_homogenization", RVE), ("contact_dynamics", CONTACT)):
        with tempfile.TemporaryDirectory() as path:
            status, _, err = Folder(path, {"a": text}).end(program, "a.prm", "--validate", env={**ENVIRONMENT, "MESOSLIP_ISA": "fast"})
            if status != 2 or "MESOSLIP_ISA" not in err or "'fast'" not in err:
                yield f"{program} with MESOSLIP_ISA=fast: exit status {status}, {err}"


def main():
    problems = [p for check, table in ((refused, CASES + UNUSED), (asked, ASKED), (validated, VALIDATED)) for case in table for p in check(*case)]
    problems += [*morphology_against_body(), *large_strain(), *same_mesh(), *command_lines(), *sections_of_one_program(), *unknown_kernels()]
    assert not problems, "\n".join(problems)


if __name__ == "__main__":
    main()
