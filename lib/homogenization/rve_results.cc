#include "exchange/rve_file.h"
#include "homogenization/rve_program.h"
#include "io/json.h"
#include "program/run_context.h"

namespace mesoslip
{
using nlohmann::json;

template <int dim>
void write_rve_results(RveResults<dim> &results, RunContext &context)
{
  RveContent<dim> &content       = results.first;
  content.summary                = context.summary().dump();
  content.stiffness["effective"] = results.effective;
  for (const HomogenizedResponse<dim> &response : results.members[0].responses)
    content.stiffness[to_string(response.condition)] = response.stiffness;
  content.expansion = results.expansion;
  for (const auto &[of, k] : results.conductivity)
    content.conductivity[of] = std::vector<double>(k.data(), k.data() + k.size());
  write_rve_file(context.file("rve.h5"), content);
}

bool restore_rve_summary(RunContext &context)
{
  auto stored = json::parse(read_rve_summary(context.file("rve.h5")), nullptr, false);
  if (!stored.is_object() || !stored.contains("stiffness"))
    return false;
  for (const auto &warning : stored.value("warnings", json::array()))
    if (warning.is_string())
      context.warn(warning.get<std::string>());
  stored.erase("warnings");
  context.summary().update(stored);
  return true;
}

template void write_rve_results<2>(RveResults<2> &, RunContext &);
template void write_rve_results<3>(RveResults<3> &, RunContext &);
} // namespace mesoslip
