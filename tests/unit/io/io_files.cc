// Tables, checkpoints, whole files.
#include "io_testing.h"

#include "base/files.h"
#include "base/object_exchange.h"
#include "exchange/xdmf.h"
#include "io/checkpoint.h"
#include "io/drafts.h"
#include "io/table.h"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <boost/serialization/vector.hpp>
#include <boost/version.hpp>

#include <cmath>

using namespace mesoslip;
using namespace mesoslip_tests;

TEST(Tables, ReadBackUnchanged)
{
  const TemporaryFolder folder;
  const std::string path = folder / "t.csv";
  {
    TableWriter table(path, {"time [s]", "a, \"b\" [m]"});
    for (int i = 0; i < 20000; ++i)
      table.add_row({i / 3., std::sqrt(2. * i)});
  }
  CsvTable table           = CsvTable::read(path);
  std::vector<double> time = table.numbers("time [s]"), b = table.numbers("a, \"b\" [m]");
  ASSERT_EQ(time.size(), 20000u);
  for (int i = 0; i < 20000; ++i)
    ASSERT_TRUE(time[i] == i / 3. && b[i] == std::sqrt(2. * i));
  {
    TableWriter few(path, {"time [s]", "a, \"b\" [m]"});
    few.add_row({7., std::nan("")});
    few.flush();
  }
  EXPECT_EQ(read_file(path), "time [s],\"a, \"\"b\"\" [m]\"\n7,\n");
  expect_error("t.csv:2: column 'a, \"b\" [m]' holds ''",
               [&] { CsvTable::read(path).numbers("a, \"b\" [m]"); });
}

TEST(Tables, SemicolonsComeWithDecimalCommas)
{
  const TemporaryFolder folder;
  const std::string path = folder / "s.csv";
  write_file(path, "grain;phi1 [degrees]\r\n1;30,5\r\n2;-1.25\r\n");
  EXPECT_EQ(CsvTable::read(path).numbers("phi1 [degrees]"),
            (std::vector<double>{30.5, -1.25}));
  write_file(path, "grain,phi1\n1,\"30,5\"\n");
  expect_error("holds '30,5'", [&] { CsvTable::read(path).numbers("phi1"); });
}

TEST(Tables, DraftsAreRefused)
{
  const TemporaryFolder folder;
  const std::string path = folder / "d.csv";
  {
    const DraftMark mark(true);
    TableWriter table(path, {"x [m]"});
    table.add_row(std::vector<double>{1.});
    table.flush();
  }
  EXPECT_EQ(read_file(path), std::string(draft_line) + "\nx [m]\n1\n");
  expect_error("d.csv is a draft, made with --try", [&] { CsvTable::read(path); });
  write_file(path, "# draft: mine\nx [m]\n1\n");
  EXPECT_EQ(CsvTable::read(path).numbers("x [m]"), std::vector<double>{1.});
}

TEST(Tables, NameWhatIsWrong)
{
  const TemporaryFolder folder;
  const std::string path = folder / "r.csv";
  const auto message     = [&](const std::string &text) {
    write_file(path, text);
    return user_error([&]() { CsvTable::read(path).numbers("x"); });
  };
  expect_contains(message("x,y\n\n# comment\n1,2\n1\n"),
                  "r.csv:5: 1 values, but the heading has 2 columns");
  expect_contains(message("x,y\n1,2\n1e,3\n"), "r.csv:3: column 'x' holds '1e'");
  expect_contains(message("x,y\nnan,3\n"), "r.csv:2: column 'x' holds 'nan'");
  expect_contains(message("y,z\n1,2\n"),
                  "there is no column 'x'; the heading line has y, z");
  expect_contains(message("x\ty\n1\t2\n"), "not tabs");
  expect_contains(message("x,y,x\n1,2,3\n"), "two columns are called 'x'");
  expect_contains(message("x\n\"1\n"), "r.csv:2: a quotation mark is not closed");
  expect_contains(message("\n"), "is empty");
  expect_error("there is no file", [&] { CsvTable::read(folder / "no.csv"); });
  expect_error("is a folder", [&] { CsvTable::read(folder.path); });
}

TEST(Xdmf, NamesDatasetsAndExtents)
{
  const TemporaryFolder folder;
  const UniformGrid<2> grid = {{{4, 3}}, {{0.1, 0.2}}, {{1., 2.}}};
  const XdmfField phase     = {"phase <&>", "/phase/id", XdmfField::Values::phases};
  const std::string dataset = "/snapshots/displacement";
  write_xdmf(folder / "d.xdmf", "d.h5", grid,
             {{"displacement", dataset, XdmfField::Values::nodes, {2}}}, {0.5, 1. / 3.});
  boost::property_tree::ptree tree;
  read_xml(folder / "d.xdmf", tree);
  const auto &series = tree.get_child("Xdmf.Domain.Grid");
  EXPECT_EQ(series.count("Grid"), 2u);
  const auto &last = series.rbegin()->second;
  EXPECT_EQ(last.get<std::string>("Time.<xmlattr>.Value"), "0.3333333333333333");
  EXPECT_EQ(last.get<std::string>("Topology.<xmlattr>.Dimensions"), "1 4 5");
  EXPECT_EQ(last.get<std::string>("Geometry.DataItem"), "0 2 1");
  EXPECT_EQ(last.get<std::string>("Attribute.<xmlattr>.AttributeType"), "Vector");
  const auto &slab = last.get_child("Attribute.DataItem");
  EXPECT_EQ(slab.get<std::string>("<xmlattr>.Dimensions"), "1 4 5 2");
  EXPECT_EQ(slab.get<std::string>("DataItem"), "1 0 0 0  1 1 1 1  1 4 5 2");
  EXPECT_EQ(slab.rbegin()->second.get<std::string>("<xmlattr>.Dimensions"), "2 4 5 2");
  EXPECT_EQ(slab.rbegin()->second.data(), "d.h5:/snapshots/displacement");

  write_xdmf(folder / "c.xdmf", "c.h5", grid,
             {phase, {"stress", "/stress", XdmfField::Values::cells, {3}}});
  boost::property_tree::ptree cells;
  read_xml(folder / "c.xdmf", cells);
  const auto &only = cells.get_child("Xdmf.Domain.Grid");
  EXPECT_EQ(only.get<std::string>("Topology.<xmlattr>.Dimensions"), "2 4 5");
  EXPECT_EQ(only.get<std::string>("Attribute.<xmlattr>.Name"), "phase <&>");
  EXPECT_EQ(only.get<std::string>("Attribute.DataItem.<xmlattr>.Dimensions"), "1 3 4");
  EXPECT_EQ(only.rbegin()->second.get<std::string>("<xmlattr>.Name"), "stress_xy");
  EXPECT_EQ(only.rbegin()->second.get<std::string>("DataItem.DataItem"),
            "0 0 2  1 1 1  3 4 1");
}

TEST(Checkpoints, ComeBackOrSayWhyNot)
{
  const TemporaryFolder folder;
  const std::string path = folder / "run.checkpoint";
  const std::string kind = "contact_dynamics, 2D, layout 1";
  const std::string payload("state\0with zero", 15);
  const auto message = [&](const std::string &expected) {
    return user_error([&]() { read_checkpoint(path, expected); });
  };
  expect_contains(message(kind), "there is no checkpoint to resume from");
  write_checkpoint(path, kind, "old");
  write_checkpoint(path, kind, payload);
  EXPECT_EQ(read_checkpoint(path, kind), payload);
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));

  expect_contains(
    message("modal, 2D, layout 1"),
    "is a mesoslip-checkpoint of contact_dynamics, 2D, layout 1, Boost " BOOST_LIB_VERSION
    ", little endian, but this run needs a mesoslip-checkpoint of modal, ");

  const std::string good = read_file(path);
  const auto spoilt      = [&](const std::string &bytes) {
    write_file(path, bytes);
    return message(kind);
  };
  expect_contains(spoilt(""), "is not a checkpoint");
  expect_contains(
    spoilt("mesoslip-checkpoint of " + kind + ", Boost 1_2, little endian: 1"),
    "Boost 1_2, little endian, but this run needs");
  expect_contains(spoilt(good.substr(0, 30)), "but this run needs");
  expect_contains(spoilt(good.substr(0, good.size() - 1)),
                  "it was written with 15 bytes, ");
  expect_contains(spoilt(good + "x"), "and now has 16 bytes");
  std::string flipped = good;
  flipped.back() ^= 1;
  expect_contains(spoilt(flipped), "is truncated or damaged");
}

TEST(Archives, SayWhenTheyAreDamaged)
{
  std::vector<double> values(100, 0.1), back;
  const std::string state = save_state(values);
  load_state(state, back, "file");
  EXPECT_EQ(back, values);
  for (const std::string &bytes :
       {std::string(), state.substr(0, 30), state.substr(0, 200)})
    expect_error("file is damaged: the state in it cannot be read",
                 [&] { load_state(bytes, back, "file"); });
}

TEST(Files, AreReplacedInOneGo)
{
  const TemporaryFolder folder;
  write_file(folder / "a", "one");
  write_file(folder / "a", std::string("t\0o", 3));
  EXPECT_EQ(read_file(folder / "a"), std::string("t\0o", 3));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.part"));
  expect_error("cannot be written", [&] { write_file(folder / "no/a", ""); });
}
