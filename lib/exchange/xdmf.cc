#include "exchange/xdmf.h"

#include "base/files.h"
#include "base/text.h"
#include "exchange/mesh_datasets.h"
#include "material/voigt.h"

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

template <typename T>
std::string joined(const std::vector<T> &values)
{
  std::ostringstream text;
  for (std::size_t i = 0; i < values.size(); ++i)
    text << (i > 0 ? " " : "") << values[i];
  return text.str();
}

/** Common part of all fields: XML of topology and geometry, and shape of a field. */
struct Geometry
{
  std::string xml;
  Shape shown;  ///< shape of nodes or cells in ParaView, slowest axis first
  Shape stored; ///< shape of nodes or cells in the datasets
};

/**
 * Works around ParaView's reader (5.11): it puts 2DCoRectMesh into the y-z plane, loses
 * coordinates and some cells of a 2DRectMesh, and loses the cell data of a 3DCoRectMesh
 * one node thick. Plane grids are therefore 3DCoRectMesh, one node thick for nodal data
 * and one cell thick for cell data.
 */
template <int dim>
Geometry geometry_of(const UniformGrid<dim> &grid, const bool of_nodes)
{
  Geometry result;
  Shape n_nodes(3 - dim, of_nodes ? 1 : 2);
  std::vector<std::string> origin(3 - dim, "0"),
    spacing(3 - dim, to_text(grid.spacing[0]));
  for (unsigned int d = dim; d-- > 0;)
    {
      n_nodes.push_back(grid.cells[d] + 1);
      result.stored.push_back(grid.cells[d] + (of_nodes ? 1 : 0));
      origin.push_back(to_text(grid.origin[d]));
      spacing.push_back(to_text(grid.spacing[d]));
    }
  result.shown = Shape(3 - dim, 1);
  result.shown.insert(result.shown.end(), result.stored.begin(), result.stored.end());
  std::ostringstream out;
  out << "<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"" << joined(n_nodes)
      << "\"/>\n<Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n";
  for (const auto *numbers : {&origin, &spacing})
    out << "<DataItem Dimensions=\"" << numbers->size()
        << "\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">" << joined(*numbers)
        << "</DataItem>\n";
  out << "</Geometry>\n";
  result.xml = out.str();
  return result;
}

template <int dim>
Geometry geometry_of(const Mesh<dim> &mesh, const bool of_nodes, const std::string &file)
{
  std::ostringstream out;
  out << "<Topology TopologyType=\"Mixed\" NumberOfElements=\"" << mesh.cells.size()
      << "\">\n<DataItem Dimensions=\"" << topology_size(mesh)
      << "\" NumberType=\"UInt\" Precision=\"4\" Format=\"HDF\">" << escaped(file)
      << ":/mesh/topology</DataItem>\n</Topology>\n<Geometry GeometryType=\""
      << (dim == 2 ? "XY" : "XYZ") << "\">\n<DataItem Dimensions=\"" << mesh.points.size()
      << " " << dim << "\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">"
      << escaped(file) << ":/mesh/points</DataItem>\n</Geometry>\n";
  const Shape n = {of_nodes ? mesh.points.size() : mesh.cells.size()};
  return {out.str(), n, n};
}

/** Writes the XML. */
template <int dim>
class Writer
{
public:
  Writer(const std::string &h5,
         const Geometry &g,
         const std::vector<XdmfField> &f,
         const std::size_t n)
    : file(h5)
    , geometry(g)
    , fields(f)
    , n_times(n)
    , of_nodes(f.front().values == XdmfField::Values::nodes)
  {
    Assert(std::all_of(fields.begin(), fields.end(),
                       [this](const XdmfField &field) {
                         return (field.values == XdmfField::Values::nodes) == of_nodes;
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
    out << geometry.xml;
    for (const XdmfField &field : fields)
      write_field(field, step);
    out << "</Grid>\n";
  }

private:
  void write_field(const XdmfField &field, const std::size_t step)
  {
    const auto &names    = voigt_names<dim>;
    const auto attribute = [&](const std::string &suffix, const char *type,
                               const Shape &first, const Shape &count) {
      out << "<Attribute Name=\"" << escaped(field.name + suffix) << "\" AttributeType=\""
          << type << "\" Center=\"" << (of_nodes ? "Node" : "Cell") << "\">\n";
      write_item(field, step, first, count);
      out << "</Attribute>\n";
    };
    if (field.components.empty())
      attribute("", "Scalar", {}, {});
    else if (field.components == Shape{dim})
      attribute("", "Vector", {0}, {dim}); // plane vectors get a third component, 0
    else
      for (std::size_t r = 0; r < names.size(); ++r)
        if (field.components.size() == 1)
          attribute(std::string("_") + names[r], "Scalar", {r}, {1});
        else
          for (std::size_t c = 0; c < names.size(); ++c)
            attribute(std::string("_") + names[r] + "_" + names[c], "Scalar", {r, c},
                      {1, 1});
  }

  /** Components from @p first on at one time: the whole dataset, or a slab of it. */
  void write_item(const XdmfField &field,
                  const std::size_t step,
                  const Shape &first,
                  const Shape &n)
  {
    Shape shown = geometry.shown, stored = geometry.stored, start(stored.size(), 0),
          count                   = stored;
    const std::size_t n_grid_axes = stored.size();
    if (of_nodes)
      {
        stored.insert(stored.begin(), n_times);
        start.insert(start.begin(), step);
        count.insert(count.begin(), 1);
      }
    stored.insert(stored.end(), field.components.begin(), field.components.end());
    start.insert(start.end(), first.begin(), first.end());
    count.insert(count.end(), n.begin(), n.end());
    if (n == Shape{dim})
      shown.push_back(dim);
    const bool slab = stored.size() > n_grid_axes;
    if (slab)
      out << "<DataItem ItemType=\"HyperSlab\" Dimensions=\"" << joined(shown)
          << "\" Type=\"HyperSlab\">\n<DataItem Dimensions=\"3 " << stored.size()
          << "\" NumberType=\"Int\" Format=\"XML\">" << joined(start) << "  "
          << joined(Shape(stored.size(), 1)) << "  " << joined(count) << "</DataItem>\n";
    out << "<DataItem Dimensions=\"" << joined(slab ? stored : shown)
        << "\" NumberType=\""
        << (field.values == XdmfField::Values::phases ? "UChar\" Precision=\"1"
                                                      : "Float\" Precision=\"8")
        << "\" Format=\"HDF\">" << escaped(file) << ":" << escaped(field.dataset)
        << "</DataItem>\n";
    if (slab)
      out << "</DataItem>\n";
  }

  const std::string &file;
  const Geometry &geometry;
  const std::vector<XdmfField> &fields;
  const std::size_t n_times;
  const bool of_nodes;
};
template <int dim>
void write_document(const std::string &path,
                    const std::string &file,
                    const Geometry &geometry,
                    const std::vector<XdmfField> &fields,
                    const std::vector<double> &times)
{
  Writer<dim> writer(file, geometry, fields, times.size());
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

bool of_nodes(const std::vector<XdmfField> &fields)
{
  return fields.empty() || fields.front().values == XdmfField::Values::nodes;
}
} // namespace

template <int dim>
void write_xdmf(const std::string &path,
                const std::string &file,
                const UniformGrid<dim> &grid,
                const std::vector<XdmfField> &fields,
                const std::vector<double> &times)
{
  write_document<dim>(path, file, geometry_of(grid, of_nodes(fields)), fields, times);
}

template <int dim>
void write_xdmf(const std::string &path,
                const std::string &file,
                const Mesh<dim> &mesh,
                const std::vector<XdmfField> &fields,
                const std::vector<double> &times)
{
  write_document<dim>(path, file, geometry_of(mesh, of_nodes(fields), file), fields,
                      times);
}

template void write_xdmf(const std::string &,
                         const std::string &,
                         const UniformGrid<2> &,
                         const std::vector<XdmfField> &,
                         const std::vector<double> &);
template void write_xdmf(const std::string &,
                         const std::string &,
                         const UniformGrid<3> &,
                         const std::vector<XdmfField> &,
                         const std::vector<double> &);
template void write_xdmf(const std::string &,
                         const std::string &,
                         const Mesh<2> &,
                         const std::vector<XdmfField> &,
                         const std::vector<double> &);
template void write_xdmf(const std::string &,
                         const std::string &,
                         const Mesh<3> &,
                         const std::vector<XdmfField> &,
                         const std::vector<double> &);
} // namespace mesoslip
