"""What the paper prints: Peillex, Baillet, Berthier, Homogenization in non linear dynamics due to frictional
contact, Int. J. Solids Structures (2008). The only typed-in numbers of the page; SI units. Nothing is read off
its figures."""

# Eq. (10); Pa.
STIFFNESS = {"D11": 36.54e9, "D12": 9.1e9, "D22": 47.26e9, "D33": 13.785e9}
# Section 3.1: largest relative standard deviation over conditions and morphologies.
STIFFNESS_DEVIATION = 0.027

# Section 3.2 and the caption of figure 8: bottom free (BC1), held in y (BC2); Hz.
MODES = {"free": 40000.0, "held": 41580.0}
# Section 3.2: highest frequency of the normal contact stress above 10 % of the main amplitude; Hz.
HIGHEST_FREQUENCY = 500e3

# Section 2.3 and figure 4: how far the node leaves the flat; m.
SEPARATION = 0.2e-6
# Section 2.3, figure 5(b): relative tangential velocity of node M and flat, whose speed is 2 m/s; m/s.
RELATIVE_VELOCITY = (1.2, 2.8)
# Section 2.3, figure 5(c); Hz.
HARMONICS = (40e3, 80e3, 120e3)
# Figures 5 to 7; s.
STEADY_FROM = 2.5e-4

# Section 2.4: shares of time of an arbitrary contact node, by regime.
SLIP = {1: 0.7, 2: 0.2}
# Figure 6.
MEAN_APPARENT_FRICTION = {1: 0.21, 2: 0.17}
MAIN_FREQUENCY = {1: 41200.0, 2: 39600.0}
# Figure 7.
INTERFACE_FRICTION = {1: 0.21, 2: 0.17}

# Section 3.5, figure 11: delta at which the slope changes sign (300 time steps of 5 ns); s.
SLOPE_CHANGE = 1.5e-6

# Table 2, P = 0.5 MPa: mu_inter of the heterogeneous models by their numbers; of the homogeneous ones by delta in ns.
TABLE_2 = {"heterogeneous": {1: 0.215, 2: 0.213, 4: 0.214, 6: 0.216}, "homogeneous": {1700: 0.212, 1500: 0.220}}
# Table 3, P = 0.4 MPa.
TABLE_3 = {"heterogeneous": {1: 0.173, 2: 0.213}, "homogeneous": {1750: 0.209, 1500: 0.175}}

# Table 4, P = 0.5 MPa: static pressure repartition (SPR) and static contact analysis (SCA); Pa.
TABLE_4 = {"mu": {"fibre": 0.3, "matrix": 0.12},
           "SPR": {"fibre": 2.35e6, "matrix": 0.29e6, "mu_homo": 0.20},
           "SCA": {"fibre": 2.0e6, "matrix": 0.33e6, "mu_homo": 0.19}}
FIBRE_SHARE = 0.1  # of volume and of the contact

# Tables 5 and 6: mu_inter of the heterogeneous model with coefficients by phase, and of homogeneous ones by
# (mu_homo, delta in ns).
BY_PHASE = 0.157
TABLE_5 = {(0.2, 1500): 0.171, (0.2, 2500): 0.158}
TABLE_6 = {(0.23, 1500): 0.198, (0.23, 4000): 0.154}

# Section 5: largest errors of the localized stress. sigma_yy everywhere; sigma_xx and sigma_xy in the volume and at
# the surface; mean and standard deviation of sigma_yy.
LOCALIZATION = {"sigma_yy": 0.04, "volume": 0.04, "surface": 0.25, "mean and deviation": 0.05}
