#include "localization/localization_program.h"

int main(int argc, char **argv)
{
  return mesoslip::run_program(argc, argv, mesoslip::stress_localization_program());
}
