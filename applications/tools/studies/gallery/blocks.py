"""The picture of blocks.prm: how both blocks move in the limit cycle."""

import disc
from report.base.figures import plt


def draw(folder, path):
    """Draws the run in `folder`."""
    figure, axes = plt.subplots(2, 1, figsize=(6.4, 6.6))
    for axis, component, panel in zip(axes, "yx", "ab"):
        disc.draw_motion(axis, folder, "blocks", component, f"({panel}) vibration along {component}")
    figure.savefig(path)
    plt.close(figure)
