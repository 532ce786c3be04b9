# %% [markdown]
# # How does a body slide under three pressures?
# Homogenizes the picture of `prm/examples/image`, then runs the homogenized body under three pressures.
# From the root of the project, with mesoslip installed, and the folder of the programs named, as doc/python.md says.

# %%
import os

import matplotlib

matplotlib.use("Agg")  # leave this out in a notebook
import matplotlib.pyplot as plt

import mesoslip

CASES, OUTPUT = "prm/examples/image/", "output/example_pressures/"

# %% The stiffness of the volume is what the body needs.
volume = mesoslip.run(CASES + "10-rve_homogenization.prm", output=OUTPUT + "volume")
print(volume["stiffness/effective"].to("GPa").round(2))

# %% Paths in settings start at the current folder.
runs = {}
for pressure in (2.5e6, 5e6, 10e6):
    settings = {"Body/RVE file": os.path.abspath(volume.path), "Supports/Top/Pressure": pressure, "Snapshots/From": 0, "Snapshots/Interval": 0}
    runs[pressure] = mesoslip.run(CASES + "20-contact_dynamics-homogeneous.prm", settings, output=f"{OUTPUT}{pressure / 1e6:g}_MPa")

# %% Key numbers are in the summary.
for pressure, run in runs.items():
    print(f"{pressure / 1e6:g} MPa: mu_inter = {run.summary['global_interface_friction_coefficient']:.4f}, "
          f"slip {100 * run.summary['slip_fraction']:.1f} % of the time, separation {100 * run.summary['separation_fraction']:.1f} %")

# %% Histories are arrays with units.
figure, (top, bottom) = plt.subplots(2, 1, figsize=(8, 5.5), sharex=True, layout="constrained")
for pressure, run in runs.items():
    history = run.history
    time = history["time"].to("ms")
    top.plot(time, history["contact_normal_force"].to("kN/m"), lw=0.7, label=f"{pressure / 1e6:g} MPa")
    bottom.plot(time, history["top_displacement"].to("nm") / (pressure / 1e6), lw=0.9)
top.set(ylabel="normal force (kN/m)", title="Contact under three pressures")
top.legend(frameon=False, ncols=3)
bottom.set(title="The three curves lie on one another", xlabel="time (ms)", ylabel="displacement of the platen\nper pressure (nm/MPa)")
figure.savefig(OUTPUT + "pressures.png", dpi=120)

# %% Nearly all nodes slip all the time, so that the displacement grows in proportion to the pressure.
means = {pressure: float(run.history["top_displacement"].mean()) / pressure for pressure, run in runs.items()}
print({f"{pressure / 1e6:g} MPa": f"{1e15 * mean:.2f} nm/MPa" for pressure, mean in means.items()})
