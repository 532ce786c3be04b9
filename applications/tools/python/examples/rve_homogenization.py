# %% [markdown]
# # Where is a composite under transverse tension stressed most?
# Runs `rve_homogenization` on random fibres under three macroscopic loads and looks at the stresses of one of them.
# From the root of the project, with mesoslip installed, and the folder of the programs named, as doc/python.md says.

# %%
import matplotlib

matplotlib.use("Agg")  # leave this out in a notebook
import matplotlib.pyplot as plt

import mesoslip

# %% A coarser grid than in the file makes it a matter of a second; fibres are one cell wide then, too few for their peaks.
coarse = {"Grid/Cells": [140, 80]}
volume = mesoslip.run("prm/examples/loads.prm", coarse, output="output/example_volume")
print(volume)

# %% The effective stiffness, in GPa, between the bounds of Voigt and Reuss.
print(volume["stiffness/effective"].to("GPa").round(2))
for phase in volume.summary["phases"]:
    print(f"{phase['name']}: {100 * phase['volume_fraction']:.2f} % of the volume")

# %% The fields of the loads are in loads.h5 beside rve.h5.
loads = mesoslip.open("output/example_volume/loads.h5")
stress = "loads/tension across/PBC/stress"
for name, mean in loads.phase_means(stress).items():
    print(f"{name}: mean stress xx, yy, xy = {mean.to('MPa').round(1)} MPa")
for name, mean in loads.phase_means(loads.von_mises(stress)).items():
    print(f"{name}: mean von Mises stress {mean.to('MPa'):.1f} MPa")

# %% A map of the largest principal stress.
x, y = loads.grid.nodes()
largest = loads.principal(stress)[..., 0]
figure, axes = plt.subplots(figsize=(8, 4.4), layout="constrained")
colours = axes.pcolormesh(x.to("mm"), y.to("mm"), largest.to("MPa"), cmap="viridis")
axes.set(xlabel="x (mm)", ylabel="y (mm)", aspect="equal", title="Tension across the fibres: largest principal stress")
figure.colorbar(colours, label="stress (MPa)", shrink=0.8)
figure.savefig("output/example_volume/largest_principal_stress.png", dpi=120)
