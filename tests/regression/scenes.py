"""Texts of .prm files that several tests run."""

PHASES = """
subsection Phases
  subsection matrix
    set Young modulus = 30e9
    set Density = 1770
  end
  subsection fibre
    set Young modulus = 240e9
    set Density = 1770
  end
end
"""
SMALL_GRID = """
subsection Grid
  set Cells = 20, 10
  set Size = 0.002, 0.001
end
"""
SMALL_RVE = PHASES + SMALL_GRID + """
subsection Microstructure
  subsection Random fibres
    set Minimum height = 2e-4
    set Maximum height = 4e-4
  end
end
"""
