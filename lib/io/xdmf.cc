#include "io/xdmf.h"

#include "io/files.h"
#include "io/parameters.h"

#include <sstream>
#include <stdexcept>

namespace mesoslip
{
namespace
{
std::string escaped(const std::string &text)
{
  std::string out;
  for (const char c : text)
    switch (c)
      {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
      }
  return out;
}

std::string number_attributes(const XdmfField::Number number)
{
  switch (number)
    {
    case XdmfField::Number::float64:
      return "NumberType=\"Float\" Precision=\"8\"";
    case XdmfField::Number::float32:
      return "NumberType=\"Float\" Precision=\"4\"";
    case XdmfField::Number::int32:
      return "NumberType=\"Int\" Precision=\"4\"";
    case XdmfField::Number::uint8:
      return "NumberType=\"UChar\" Precision=\"1\"";
    }
  throw std::logic_error("unknown number type");
}

/** Extents of a field on the grid, z first. */
std::vector<std::size_t> extents(const XdmfGrid &grid, const XdmfField &field)
{
  std::vector<std::size_t> result;
  for (unsigned int d = grid.dim; d-- > 0;)
    result.push_back(grid.cells[d] + (field.centre == XdmfField::Centre::node ? 1 : 0));
  return result;
}

template <typename T>
std::string joined(const std::vector<T> &values)
{
  std::ostringstream text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text << (i > 0 ? " " : "") << values[i];
  return text.str();
}

/** Writes the XML; knows the grid and how many times there are. */
class Writer
{
public:
  Writer(const XdmfGrid &g, const std::size_t n)
    : grid(g)
    , n_times(n)
  {
  }

  std::ostringstream out;

  void write_grid(const std::vector<XdmfField> &fields,
                  const std::size_t step,
                  const double time)
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
  void write_geometry()
  {
    const std::string dim = std::to_string(grid.dim) + "D";
    std::vector<std::size_t> nodes;
    std::vector<std::string> origin, spacing;
    for (unsigned int d = grid.dim; d-- > 0;)
      {
        nodes.push_back(grid.cells[d] + 1);
        origin.push_back(to_text(grid.origin[d]));
        spacing.push_back(to_text(grid.spacing[d]));
      }
    const auto triple = [&](const std::vector<std::string> &values) {
      out << "<DataItem Dimensions=\"" << grid.dim
          << "\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">" << joined(values)
          << "</DataItem>\n";
    };
    out << "<Topology TopologyType=\"" << dim << "CoRectMesh\" Dimensions=\""
        << joined(nodes) << "\"/>\n<Geometry GeometryType=\"ORIGIN_"
        << (grid.dim == 3 ? "DXDYDZ" : "DXDY") << "\">\n";
    triple(origin);
    triple(spacing);
    out << "</Geometry>\n";
  }

  void begin_attribute(const XdmfField &field, const std::string &name, const char *type)
  {
    out << "<Attribute Name=\"" << escaped(name) << "\" AttributeType=\"" << type
        << "\" Center=\"" << (field.centre == XdmfField::Centre::node ? "Node" : "Cell")
        << "\">\n";
  }

  void write_field(const XdmfField &field, const std::size_t step)
  {
    if (field.components == 0)
      {
        begin_attribute(field, field.name, "Scalar");
        write_item(field, step, 0);
        out << "</Attribute>\n";
      }
    else if (field.components == grid.dim)
      write_vector(field, step);
    else
      for (unsigned int c = 0; c < field.components; ++c)
        {
          begin_attribute(field, field.name + "_" + std::to_string(c), "Scalar");
          write_item(field, step, c);
          out << "</Attribute>\n";
        }
  }

  /** ParaView's vectors have three components: the third of a plane one is zero. */
  void write_vector(const XdmfField &field, const std::size_t step)
  {
    begin_attribute(field, field.name, "Vector");
    out << "<DataItem ItemType=\"Function\" Function=\""
        << (grid.dim == 2 ? "JOIN($0, $1, 0 * $0)" : "JOIN($0, $1, $2)")
        << "\" Dimensions=\"" << joined(extents(grid, field)) << " 3\">\n";
    for (unsigned int c = 0; c < grid.dim; ++c)
      write_item(field, step, c);
    out << "</DataItem>\n</Attribute>\n";
  }

  /** One component at one time: all of the dataset, or a slab of it. */
  void
  write_item(const XdmfField &field, const std::size_t step, const unsigned int component)
  {
    const auto shape               = extents(grid, field);
    std::vector<std::size_t> whole = shape, start(shape.size(), 0), count = shape;
    if (field.time_series)
      {
        whole.insert(whole.begin(), n_times);
        start.insert(start.begin(), step);
        count.insert(count.begin(), 1);
      }
    if (field.components > 0)
      {
        whole.push_back(field.components);
        start.push_back(component);
        count.push_back(1);
      }
    const bool slab = whole.size() > shape.size();
    if (slab)
      out << "<DataItem ItemType=\"HyperSlab\" Dimensions=\"" << joined(shape)
          << "\" Type=\"HyperSlab\">\n<DataItem Dimensions=\"3 " << whole.size()
          << "\" NumberType=\"Int\" Format=\"XML\">" << joined(start) << "  "
          << joined(std::vector<int>(whole.size(), 1)) << "  " << joined(count)
          << "</DataItem>\n";
    out << "<DataItem Dimensions=\"" << joined(whole) << "\" "
        << number_attributes(field.number) << " Format=\"HDF\">" << escaped(field.file)
        << ":" << escaped(field.dataset) << "</DataItem>\n";
    if (slab)
      out << "</DataItem>\n";
  }

  const XdmfGrid &grid;
  const std::size_t n_times;
};
} // namespace

void write_xdmf(const std::string &path,
                const XdmfGrid &grid,
                const std::vector<XdmfField> &fields,
                const std::vector<double> &times)
{
  if (grid.dim != 2 && grid.dim != 3)
    throw std::logic_error("XDMF grids have two or three dimensions");
  Writer writer(grid, times.size());
  writer.out << "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n"
                "<Xdmf Version=\"2.0\">\n<Domain>\n";
  if (times.empty())
    writer.write_grid(fields, 0, 0.);
  else
    {
      writer.out << "<Grid Name=\"series\" GridType=\"Collection\" "
                    "CollectionType=\"Temporal\">\n";
      for (std::size_t step = 0; step < times.size(); ++step)
        writer.write_grid(fields, step, times[step]);
      writer.out << "</Grid>\n";
    }
  writer.out << "</Domain>\n</Xdmf>\n";
  write_file(path, writer.out.str());
}
} // namespace mesoslip
