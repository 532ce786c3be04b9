// Files of a body with a counter body.
#include "exchange/datasets.h"
#include "exchange/run_description.h"
#include "sliding/pair/given_pair.h"

namespace mesoslip
{
template <int dim>
Hdf5File GivenPair<dim>::create_file(const std::string &path,
                                     const std::string &format) const
{
  return above->create_file(path, format);
}

template <int dim>
Shape GivenPair<dim>::vectors_shape() const
{
  return above->vectors_shape();
}

/** The part of body 0 or 1 in fields of elastic(), or of vibrating() if it exists. */
template <int dim>
std::vector<NodalField<double>>
GivenPair<dim>::fields_of(const std::size_t body,
                          const std::vector<const NodalField<double> *> &fields) const
{
  std::vector<NodalField<double>> all;
  for (const NodalField<double> *field : fields)
    all.push_back((moving ? *moving : *at_rest).parts(*field)[body]);
  return all;
}

namespace
{
std::vector<const NodalField<double> *>
pointers_to(const std::vector<NodalField<double>> &fields)
{
  std::vector<const NodalField<double> *> pointers;
  for (const NodalField<double> &field : fields)
    pointers.push_back(&field);
  return pointers;
}
} // namespace

template <int dim>
void GivenPair<dim>::write_fields(
  std::optional<Hdf5File> &file,
  const std::string &path,
  const std::string &name,
  const std::vector<const NodalField<double> *> &fields) const
{
  const std::vector<NodalField<double>> own = fields_of(0, fields);
  above->write_fields(file, path, name, pointers_to(own));
}

template <int dim>
void GivenPair<dim>::write_below(const std::string &path,
                                 const std::string &format,
                                 const std::vector<ShownFields> &shown,
                                 const std::vector<double> &numbers,
                                 const RunConditions &conditions) const
{
  std::vector<ShownFields> own = shown;
  std::vector<std::vector<NodalField<double>>> parts;
  for (ShownFields &fields : own)
    {
      parts.push_back(fields_of(1, fields.fields));
      fields.fields = pointers_to(parts.back());
    }
  std::optional<Hdf5File> file = below->create_file(path, format);
  if (!conditions.empty())
    {
      write_run_conditions(*file, conditions_below(conditions));
      write_dataset(*file, "/snapshots/time", {numbers.size()}, numbers, "s");
    }
  below->write_and_show(file, path, own, numbers);
}

template <int dim>
void GivenPair<dim>::show(const std::string &path,
                          const std::vector<XdmfField> &fields,
                          const std::vector<double> &times) const
{
  above->show(path, fields, times);
}

#define MESOSLIP_INSTANTIATE(dim)                                               \
  template Hdf5File GivenPair<dim>::create_file(const std::string &,            \
                                                const std::string &) const;     \
  template Shape GivenPair<dim>::vectors_shape() const;                         \
  template void GivenPair<dim>::write_fields(                                   \
    std::optional<Hdf5File> &, const std::string &, const std::string &,        \
    const std::vector<const NodalField<double> *> &) const;                     \
  template void GivenPair<dim>::write_below(                                    \
    const std::string &, const std::string &, const std::vector<ShownFields> &, \
    const std::vector<double> &, const RunConditions &) const;                  \
  template void GivenPair<dim>::show(const std::string &,                       \
                                     const std::vector<XdmfField> &,            \
                                     const std::vector<double> &) const;
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
