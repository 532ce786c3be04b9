# %% [markdown]
# # What do the grains bear, and how far is localized stress to be trusted?
# Runs the chain of `prm/examples/image` (a picture, its homogenized body, the body with every grain, localization) and
# compares localized with direct stresses. From the root of the project, with mesoslip installed, and the folder of the programs named, as doc/python.md says.

# %%
import matplotlib

matplotlib.use("Agg")  # leave this out in a notebook
import matplotlib.pyplot as plt
import numpy as np

import mesoslip

# %% About ten seconds. What is up to date is not run again.
chain = mesoslip.run_chain("prm/examples/image", output="output/example_chain", report=False)
print(chain)
volume, localized = chain["rve"], chain["localization"]

# %% localization.h5 has no phases: they are those of the volume.
for name, mean in localized.phase_means("mean_stress", volume).items():
    direct = localized.phase_means("direct/mean_stress", volume)[name]
    print(f"{name}: mean sigma_yy {mean.to('MPa')[1]:.2f} MPa localized, {direct.to('MPa')[1]:.2f} MPa direct")

# %% Error over the body, relative to the direct run (L2).
error = np.linalg.norm(localized["difference/mean_stress"]) / np.linalg.norm(localized["direct/mean_stress"])
print(f"mean stress: relative error {100 * error:.1f} %")

# %% Von Mises' stress of the mean stress, and a probe over time.
x, y = localized.grid.nodes()
figure, (upper, lower) = plt.subplots(2, 1, figsize=(8, 7), height_ratios=[3, 2], layout="constrained")
colours = upper.pcolormesh(x.to("mm"), y.to("mm"), localized.von_mises("mean_stress", volume).to("MPa"), cmap="viridis")
upper.set(xlabel="x (mm)", ylabel="y (mm)", aspect="equal", title="Von Mises stress of the localized mean stress")
figure.colorbar(colours, ax=upper, label="stress (MPa)")
probe = localized.probes["bulk"]
for dataset, label in (("direct_stress", "direct"), ("stress", "localized")):
    lower.plot(probe["time"].to("ms"), probe[dataset][:, 1].to("N/mm^2"), lw=0.8, label=label)
lower.set(xlabel="time (ms)", ylabel="sigma_yy (N/mm$^2$)", title="In a grain in the middle of the body")
lower.legend(frameon=False)
figure.savefig("output/example_chain/localized.png", dpi=120)
chain.close()
