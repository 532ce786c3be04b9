"""Texts of .prm files that several tests run."""

SMALL_RVE = """
subsection Grid
  set Cells = 20, 10
  set Size = 0.002, 0.001
end
subsection Microstructure
  subsection Random fibres
    set Minimum height = 2e-4
    set Maximum height = 4e-4
  end
end
"""
