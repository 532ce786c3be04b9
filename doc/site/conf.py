"""Settings of Sphinx for the site that make.py writes."""

project = "mesoslip"
copyright = "the authors of mesoslip, LGPL-2.1-or-later"  # pylint: disable=redefined-builtin
extensions = ["myst_parser"]
myst_heading_anchors = 4  # headings have the anchors that code forges give them
html_theme = "furo"
html_title = "mesoslip"
html_copy_source = False
html_show_sphinx = False
