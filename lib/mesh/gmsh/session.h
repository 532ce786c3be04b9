#ifndef mesoslip_mesh_gmsh_session_h
#define mesoslip_mesh_gmsh_session_h

#include <gmsh.h>

namespace mesoslip
{
/**
 * Starts and stops the Gmsh library, without models and without console output. If it
 * already runs (MPI_InitFinalize of deal.II 9.8 starts it), it keeps running afterwards.
 */
class GmshSession
{
public:
  GmshSession()
    : is_own(!is_started())
  {
    if (is_own)
      gmsh::initialize(0, nullptr, false);
    else
      forget();
    gmsh::option::setNumber("General.Terminal", 0);
  }

  GmshSession(const GmshSession &)            = delete;
  GmshSession &operator=(const GmshSession &) = delete;

  ~GmshSession()
  {
    if (is_own)
      gmsh::finalize();
    else
      forget();
  }

private:
// Earlier versions have no isInitialized(), and deal.II does not start them.
#if GMSH_API_VERSION_MAJOR > 4 || GMSH_API_VERSION_MINOR >= 12
  static bool is_started()
  {
    return gmsh::isInitialized() != 0;
  }

  static void forget()
  {
    gmsh::clear();
    gmsh::option::restoreDefaults();
  }
#else
  static bool is_started()
  {
    return false;
  }

  static void forget()
  {
  }
#endif

  const bool is_own;
};
} // namespace mesoslip

#endif
