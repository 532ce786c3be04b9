mesoslip_test(unit material LIBS mesoslip_material)
