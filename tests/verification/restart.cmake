mesoslip_test(verification restart LIBS mesoslip_sliding)
