mesoslip_test(unit multigrid LIBS mesoslip_elasticity)
