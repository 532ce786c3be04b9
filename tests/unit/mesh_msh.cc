#include "base/errors.h"
#include "mesh/gmsh/msh_file.h"
#include "mesh/read_gmsh.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <random>
#include <sstream>

using namespace mesoslip;

namespace
{
const std::string path = testing::TempDir() + "mesoslip_msh_test.msh";

/** Numbers in text or binary, as format 4.1 wants them. */
class Writer
{
public:
  explicit Writer(const bool binary)
    : binary(binary)
  {
    out << "$MeshFormat\n4.1 " << binary << " 8\n";
    if (binary)
      put<std::int32_t>({1});
    out << "\n$EndMeshFormat\n";
  }

  template <typename T>
  Writer &put(const std::vector<T> &values)
  {
    for (const T &value : values)
      if (binary)
        out.write(reinterpret_cast<const char *>(&value), sizeof(T));
      else
        out << value << ' ';
    return *this;
  }

  std::ostringstream out;

private:
  const bool binary;
};

using Ints  = std::vector<std::int32_t>;
using Sizes = std::vector<std::size_t>;

/** Two squares of two groups side by side, with the lower line of the first, a section that is
 * of no use, and numbers of points with gaps; the surface of the first also in @p extra. */
std::string two_squares(const bool binary, const Ints &extra = {})
{
  Writer file(binary);
  file.out << "$PhysicalNames\n3\n1 3 \"lower side\"\n2 7 \"soft\"\n2 9 \"hard\"\n"
              "$EndPhysicalNames\n$Entities\n";
  file.put<std::size_t>({1, 1, 2, 0}).put<std::int32_t>({1}).put<double>({0, 0, 0});
  file.put<std::size_t>({0});
  const std::vector<double> box(6, 0.5);
  file.put<std::int32_t>({4}).put(box).put<std::size_t>({1}).put<std::int32_t>({3});
  file.put<std::size_t>({2}).put<std::int32_t>({1, -1});
  file.put<std::int32_t>({6}).put(box).put<std::size_t>({1 + extra.size()});
  file.put<std::int32_t>({9}).put(extra).put<std::size_t>({0});
  file.put<std::int32_t>({5}).put(box).put<std::size_t>({1}).put<std::int32_t>({-7});
  file.put<std::size_t>({0});
  file.out << "\n$EndEntities\n$Nodes\n";
  file.put<std::size_t>({2, 6, 10, 90}).put<std::int32_t>({1, 4, 1});
  file.put<std::size_t>({2, 90, 20});
  for (const double x : {2., 0.})
    file.put<double>({x, 0., 1., 0.25}); // with a parameter of the line
  file.put<std::int32_t>({2, 5, 0}).put<std::size_t>({4, 30, 40, 50, 10});
  file.put<double>({2, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 1});
  file.out << "\n$EndNodes\n$Elements\n";
  file.put<std::size_t>({3, 3, 1, 3}).put<std::int32_t>({1, 4, 1});
  file.put<std::size_t>({1, 1, 20, 50}).put<std::int32_t>({2, 6, 3});
  file.put<std::size_t>({1, 2, 50, 90, 30, 10}).put<std::int32_t>({2, 5, 3});
  file.put<std::size_t>({1, 3, 20, 50, 10, 40});
  file.out << "\n$EndElements\n$Other\nwords\n$EndOther\n";
  return file.out.str();
}

template <typename Read>
std::string refusal(const std::string &content, const Read &read)
{
  std::ofstream(path, std::ios::binary) << content;
  try
    {
      read();
    }
  catch (const UserError &e)
    {
      return e.what();
    }
  return "accepted";
}

std::string refusal(const std::string &content)
{
  return refusal(content, []() { read_gmsh<2>(path, 1.); });
}

std::string replaced(std::string text, const std::string &what, const std::string &by)
{
  return text.replace(text.find(what), what.size(), by);
}
} // namespace

TEST(MshFile, TextAndBinary)
{
  for (const bool binary : {false, true})
    {
      SCOPED_TRACE(binary);
      std::ofstream(path, std::ios::binary) << two_squares(binary);
      const Mesh<2> mesh = read_gmsh<2>(path, 2.);
      EXPECT_EQ(mesh.phases, (std::vector<std::string>{"soft", "hard"}));
      EXPECT_EQ(mesh.boundaries, std::vector<std::string>{"lower side"});
      ASSERT_EQ(mesh.points.size(), 6U);
      ASSERT_EQ(mesh.cells.size(), 2U);
      ASSERT_EQ(mesh.faces.size(), 1U);
      for (unsigned int k = 0; k < 2; ++k) // soft is the left one
        {
          dealii::Point<2> sum;
          for (const unsigned int v : mesh.cells[k].vertices)
            sum += mesh.points[v];
          EXPECT_EQ(sum, dealii::Point<2>(k == 0 ? 4. : 12., 4.));
          EXPECT_EQ(mesh.cells[k].material_id, k);
        }
      for (const unsigned int v : mesh.faces[0].vertices)
        EXPECT_EQ(mesh.points[v][1], 0.);
    }
}

TEST(MshFile, FilesThatEndTooEarlyAreRefused)
{
  for (const bool binary : {false, true})
    {
      const std::string whole = two_squares(binary);
      ASSERT_EQ(refusal(whole), "accepted");
      const std::size_t complete = whole.find("$EndElements") + 12,
                        other    = whole.find("$Other") + 1,
                        at_end   = whole.find("$EndOther") + 9;
      for (std::size_t n = 0; n < at_end; n += 3)
        if (n < complete || n > other)
          {
            EXPECT_NE(refusal(whole.substr(0, n)), "accepted")
              << n << " of " << whole.size() << " bytes, binary: " << binary;
          }
    }
}

TEST(MshFile, AnyByteMayBeWrong)
{
  std::mt19937 generator(3);
  for (const bool binary : {false, true})
    for (unsigned int k = 0; k < 200; ++k)
      {
        std::string content                   = two_squares(binary);
        content[generator() % content.size()] = static_cast<char>(generator());
        // Nothing but a sentence is thrown.
        refusal(content, []() { read_msh(path, 1); });
      }
}

TEST(MshFile, RefusalsNameWhatIsWrong)
{
  const auto contains = [](const std::string &text, const std::string &part) {
    return text.find(part) != std::string::npos
             ? testing::AssertionSuccess()
             : testing::AssertionFailure() << "'" << text << "' has no '" << part << "'";
  };
  const std::string text = two_squares(false);
  EXPECT_TRUE(contains(refusal(two_squares(false, {7})),
                       "in two physical groups, 'hard' and 'soft'"));
  EXPECT_TRUE(contains(refusal(replaced(text, "4.1 0 8", "4 0 8")), "format 4;"));
  EXPECT_TRUE(contains(refusal(replaced(text, "4.1 0 8", "4.1 0 4")), "4 bytes"));
  EXPECT_TRUE(contains(refusal(replaced(text, "90 20", "90 90")), "have the number 90"));
  EXPECT_TRUE(contains(refusal(replaced(text, "3 20 50", "3 21 50")), "the point 21"));
  EXPECT_TRUE(contains(refusal(replaced(text, "0.25", "0,25")), "'0,25' is not"));
  EXPECT_TRUE(contains(refusal(replaced(text, "2 6 10 90", "2 60000 10 90")),
                       "more than the file can have"));
  EXPECT_TRUE(contains(refusal("solid x"), "does not begin with $MeshFormat"));
  const std::string binary = two_squares(true);
  EXPECT_TRUE(contains(refusal(replaced(binary, "8\n\1", "8\n\2")), "order of bytes"));
}
