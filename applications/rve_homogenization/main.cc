#include "homogenization/rve_program.h"

int main(int argc, char **argv)
{
  return mesoslip::run_program(argc, argv, mesoslip::rve_homogenization_program());
}
