// Tables, checkpoints, whole files.
#include "io_testing.h"

#include "base/exchange.h"
#include "base/files.h"
#include "io/checkpoint.h"
#include "io/table.h"

#include <boost/serialization/vector.hpp>

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
  expect_contains(message("x\n\"1\n"), "r.csv:2: a quotation mark is not closed");
  expect_contains(message("\n"), "is empty");
  expect_error("there is no file", [&] { CsvTable::read(folder / "no.csv"); });
  expect_error("is a folder", [&] { CsvTable::read(folder.path); });
}

TEST(Checkpoints, ComeBackOrSayWhyNot)
{
  const TemporaryFolder folder;
  const std::string path = folder / "run.checkpoint";
  CheckpointHeader header;
  header.kind = "contact_dynamics";
  const std::string payload("state\0with zero", 15);
  const auto message = [&](const CheckpointHeader &expected) {
    return user_error([&]() { read_checkpoint(path, expected); });
  };
  expect_contains(message(header), "there is no checkpoint to resume from");
  write_checkpoint(path, header, {"old"});
  write_checkpoint(path, header, {payload.substr(0, 7), "", payload.substr(7)});
  EXPECT_EQ(read_checkpoint(path, header), payload);
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));

  CheckpointHeader other = header;
  other.kind             = "modal";
  expect_contains(message(other), "is a mesoslip-checkpoint of contact_dynamics, 2D, "
                                  "layout 1, little endian, but this run needs a ");
  other     = header;
  other.dim = 3;
  expect_contains(message(other), "2D, layout 1");
  other         = header;
  other.version = 2;
  expect_contains(message(other), "layout 1, ");

  const std::string good = read_file(path);
  const auto spoilt      = [&](const std::string &bytes) {
    write_file(path, bytes);
    return message(header);
  };
  expect_contains(spoilt(""), "is not a checkpoint");
  expect_contains(spoilt(good.substr(0, 30)), "but this run needs");
  expect_contains(spoilt(good.substr(0, good.size() - 1)),
                  "the state was written as 15 bytes, ");
  expect_contains(spoilt(good + "x"), "and has 16 bytes");
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
