#include "sliding/contact_program.h"

int main(int argc, char **argv)
{
  return mesoslip::run_program(argc, argv, mesoslip::contact_dynamics_program());
}
