mesoslip_test(unit observation LIBS mesoslip_observation)
