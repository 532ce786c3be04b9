#ifndef mesoslip_localization_mean_concentration_h
#define mesoslip_localization_mean_concentration_h

#include "base/text.h"
#include "material/engineering_constants.h"
#include "material/plausibility.h"
#include "material/voigt.h"

#include <string>

namespace mesoslip
{
/**
 * Warning on inaccurate concentration tensors L of @p condition with the volume mean
 * @p mean; empty: none. The mean is I for KUBC and PBC up to the accuracy of the solver.
 * MUBC prescribe only its orthotropic part: the rest vanishes if the coordinate axes are
 * axes of orthotropy (doc/theory.md). @p file is named as the source.
 */
template <int dim>
std::string concentration_warning(const std::string &file,
                                  const std::string &condition,
                                  const VoigtMatrix<dim> &mean)
{
  constexpr double largest_defect = 1e-6, largest_coupling = 0.01;
  const VoigtMatrix<dim> prescribed =
    condition == "MUBC" ? orthotropic_part<dim>(mean) : mean;
  const double defect = (prescribed - VoigtMatrix<dim>::Identity()).cwiseAbs().maxCoeff();
  const std::string tensors =
    file + ": the mean of the concentration tensors " + condition;
  if (!(defect <= largest_defect))
    return tensors + " differs from the identity by " + to_text(defect) +
           ", so that localized stresses are off by about this share";
  const double coupling = (mean - prescribed).cwiseAbs().maxCoeff();
  if (!(coupling <= largest_coupling))
    return tensors + " couples shear to other strains by " + brief_text(2, coupling) +
           ", so that mean strains differ from those of the body by about this share; "
           "MUBC "
           "are for volumes with the axes of orthotropy along those of space. PBC and "
           "KUBC "
           "have no such error, but a larger one in grains that free sides cut";
  return "";
}
} // namespace mesoslip

#endif
