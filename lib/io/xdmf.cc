#include "io/xdmf.h"

#include "base/files.h"
#include "parameters/parameters.h"

#include <deal.II/base/exceptions.h>

#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <sstream>
#include <utility>

namespace mesoslip
{
namespace
{
std::string escaped(std::string text)
{
  for (const auto &[character, name] :
       {std::make_pair("&", "&amp;"), std::make_pair("<", "&lt;"),
        std::make_pair(">", "&gt;"), std::make_pair("\"", "&quot;")})
    boost::algorithm::replace_all(text, character, name);
  return text;
}

std::string number_attributes(const XdmfField::Number number)
{
  static const std::pair<const char *, int> types[] = {{"Float", 8}, {"UChar", 1}};
  const auto &[type, bytes] = types[static_cast<unsigned int>(number)];
  return std::string("NumberType=\"") + type + "\" Precision=\"" + std::to_string(bytes) +
         "\"";
}

template <typename T>
std::string joined(const std::vector<T> &values)
{
  std::ostringstream text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text << (i > 0 ? " " : "") << values[i];
  return text.str();
}

/**
 * Writes the XML. The detours are those of ParaView's reader, tried with 5.11: it puts
 * 2DCoRectMesh into the y-z plane, leaves out the coordinates and some cells of a
 * 2DRectMesh, and the cell data of a 3DCoRectMesh one node thick. So plane grids are
 * 3DCoRectMesh: one node thick with data of nodes, one cell with data of cells.
 */
class Writer
{
public:
  Writer(const XdmfGrid &g, const std::vector<XdmfField> &f, const std::size_t n)
    : grid(g)
    , fields(f)
    , n_times(n)
  {
    Assert(!fields.empty() && (grid.dim == 2 || grid.dim == 3),
           dealii::ExcInternalError());
    Assert(grid.dim == 3 || std::all_of(fields.begin(), fields.end(),
                                        [&](const XdmfField &field) {
                                          return field.centre == fields.front().centre;
                                        }),
           dealii::ExcMessage("ParaView cannot show data of nodes and of cells on one "
                              "plane grid"));
  }

  std::ostringstream out;

  void write_grid(const std::size_t step, const double time)
  {
    out << "<Grid Name=\"grid\" GridType=\"Uniform\">\n";
    if (n_times > 0)
      out << "<Time Value=\"" << to_text(time) << "\"/>\n";
    write_geometry();
    for (const XdmfField &field : fields)
      write_field(field, step);
    out << "</Grid>\n";
  }

private:
  /** Extents of what is shown, z first. */
  std::vector<std::size_t> extents(const XdmfField::Centre centre) const
  {
    const bool nodes = centre == XdmfField::Centre::node;
    const bool thick = fields.front().centre == XdmfField::Centre::cell;
    std::vector<std::size_t> result(3 - grid.dim, nodes && thick ? 2 : 1);
    for (unsigned int d = grid.dim; d-- > 0;)
      result.push_back(grid.cells[d] + (nodes ? 1 : 0));
    return result;
  }

  void write_numbers(const std::vector<std::string> &numbers)
  {
    out << "<DataItem Dimensions=\"" << numbers.size()
        << "\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">" << joined(numbers)
        << "</DataItem>\n";
  }

  void write_geometry()
  {
    std::vector<std::string> origin(3 - grid.dim, "0"),
      spacing(3 - grid.dim, to_text(grid.spacing[0]));
    for (unsigned int d = grid.dim; d-- > 0;)
      {
        origin.push_back(to_text(grid.origin[d]));
        spacing.push_back(to_text(grid.spacing[d]));
      }
    out << "<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\""
        << joined(extents(XdmfField::Centre::node))
        << "\"/>\n<Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n";
    write_numbers(origin);
    write_numbers(spacing);
    out << "</Geometry>\n";
  }

  void write_field(const XdmfField &field, const std::size_t step)
  {
    const auto attribute = [&](const std::string &name, const char *type,
                               const unsigned int first, const unsigned int count) {
      out << "<Attribute Name=\"" << escaped(name) << "\" AttributeType=\"" << type
          << "\" Center=\"" << (field.centre == XdmfField::Centre::node ? "Node" : "Cell")
          << "\">\n";
      write_item(field, step, first, count);
      out << "</Attribute>\n";
    };
    if (field.components == 0)
      attribute(field.name, "Scalar", 0, 1);
    else if (field.components == grid.dim)
      attribute(field.name, "Vector", 0, field.components); // plane ones get a third, 0
    else
      for (unsigned int c = 0; c < field.components; ++c)
        attribute(field.name + "_" +
                    (c < field.component_names.size() ? field.component_names[c]
                                                      : std::to_string(c)),
                  "Scalar", c, 1);
  }

  /** Components [first, first + n) at one time: all of the dataset, or a slab of it. */
  void write_item(const XdmfField &field,
                  const std::size_t step,
                  const unsigned int first,
                  const unsigned int n)
  {
    const auto shape = extents(field.centre);
    std::vector<std::size_t> stored(shape.end() - static_cast<int>(grid.dim),
                                    shape.end());
    std::vector<std::size_t> start(grid.dim, 0), count = stored, shown = shape;
    if (field.time_series)
      {
        stored.insert(stored.begin(), n_times);
        start.insert(start.begin(), step);
        count.insert(count.begin(), 1);
      }
    if (field.columns > 0) // a matrix, of which one entry is shown
      {
        stored.insert(stored.end(), {field.components / field.columns, field.columns});
        start.insert(start.end(), {first / field.columns, first % field.columns});
        count.insert(count.end(), {1, 1});
      }
    else if (field.components > 0)
      {
        stored.push_back(field.components);
        start.push_back(first);
        count.push_back(n);
      }
    if (n > 1)
      shown.push_back(n);
    const bool slab = stored.size() > grid.dim;
    if (slab)
      out << "<DataItem ItemType=\"HyperSlab\" Dimensions=\"" << joined(shown)
          << "\" Type=\"HyperSlab\">\n<DataItem Dimensions=\"3 " << stored.size()
          << "\" NumberType=\"Int\" Format=\"XML\">" << joined(start) << "  "
          << joined(std::vector<int>(stored.size(), 1)) << "  " << joined(count)
          << "</DataItem>\n";
    out << "<DataItem Dimensions=\"" << joined(slab ? stored : shown) << "\" "
        << number_attributes(field.number) << " Format=\"HDF\">" << escaped(field.file)
        << ":" << escaped(field.dataset) << "</DataItem>\n";
    if (slab)
      out << "</DataItem>\n";
  }

  const XdmfGrid &grid;
  const std::vector<XdmfField> &fields;
  const std::size_t n_times;
};
} // namespace

void write_xdmf(const std::string &path,
                const XdmfGrid &grid,
                const std::vector<XdmfField> &fields,
                const std::vector<double> &times)
{
  Writer writer(grid, fields, times.size());
  writer.out << "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
                "<Xdmf Version=\"2.0\">\n<Domain>\n";
  if (times.empty())
    writer.write_grid(0, 0.);
  else
    {
      writer.out << "<Grid Name=\"series\" GridType=\"Collection\" "
                    "CollectionType=\"Temporal\">\n";
      for (std::size_t step = 0; step < times.size(); ++step)
        writer.write_grid(step, times[step]);
      writer.out << "</Grid>\n";
    }
  writer.out << "</Domain>\n</Xdmf>\n";
  write_file(path, writer.out.str());
}
} // namespace mesoslip
