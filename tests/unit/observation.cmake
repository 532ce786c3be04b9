mesoslip_test(unit observation LIBS mesoslip_observation)
mesoslip_test(unit steady_state LIBS mesoslip_observation)
