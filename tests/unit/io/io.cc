// Parameters and what else needs no files.
#include "io_testing.h"

#include "base/files.h"
#include "base/text.h"
#include "parameters/keys.h"

#include <cmath>
#include <map>
#include <sstream>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
/** A few keys in two levels of sections. */
struct SomeKeys
{
  int cells       = 10;
  double fraction = 1. / 3., size = std::nan("");
  std::vector<double> output = {1e-90, 0.1};
  std::string file, kind = "one";
  bool big = false;

  void bind(Keys &keys)
  {
    keys.bind("Cells", cells, 1, 1000, "Cells [-]");
    {
      const auto section = keys.section("Time step");
      keys.bind("Fraction", fraction, Range::left_open(0., 1.), "Of the limit [-]");
      keys.bind_or_auto("Size", size, Range::positive(), "Step [s]");
      keys.bind_list("Output", output, Range::positive(), "Times [s]", 2, 3);
    }
    const auto section = keys.section("Input/Deep");
    keys.bind_input("Image file", file, "Image");
    keys.bind("Kind", kind, {"one", "two words"}, "Kind");
    keys.bind("Weight", big, {"small", "big"}, "Weight");
  }
};

void apply(Keys &keys)
{
  SomeKeys().bind(keys);
  keys.apply();
}

SomeKeys read(Keys &keys)
{
  apply(keys);
  SomeKeys values;
  values.bind(keys);
  return values;
}

std::string error_of_text(const std::string &text)
{
  return user_error([&]() {
    Keys keys(RawParameters::parse(text, "run.prm"));
    apply(keys);
  });
}
} // namespace

TEST(Parameters, ReadsWhatIsSet)
{
  RawParameters raw =
    RawParameters::parse("\xef\xbb\xbfset Cells = 1\\\r\n7 # comment\r\n"
                         "SUBSECTION  Time   step\n set Fraction=+.25\nEND\n"
                         "subsection Input\nsubsection Deep\n"
                         "set Kind = two words\nset Image file = a/b.png\n"
                         "set Weight = big\n"
                         "end\nend\n",
                         "/some/where/run.prm");
  raw.override_with("Time step/Size = 2e-9");
  Keys keys(raw);
  const SomeKeys values = read(keys);
  EXPECT_EQ(values.cells, 17);
  EXPECT_EQ(values.fraction, 0.25);
  EXPECT_EQ(values.size, 2e-9);
  EXPECT_EQ(values.output, (std::vector<double>{1e-90, 0.1}));
  EXPECT_EQ(values.kind, "two words");
  EXPECT_TRUE(values.big);
  EXPECT_EQ(values.file, "/some/where/a/b.png");
  expect_error("A: there is no file /some/where/a/b.png; draw it",
               [&] { require_readable_file("A: ", values.file, "draw it"); });
  EXPECT_THROW(keys.value("Undeclared"), std::logic_error);
}

TEST(Parameters, DefaultsKeepAllDigitsAndPrintingReadsBack)
{
  RawParameters raw;
  raw.override_with("Time step/Fraction=0.1234567890123456");
  raw.override_with("Input/Deep/Image file=/a #1/b\\#.png");
  Keys keys(raw);
  apply(keys);
  std::ostringstream text;
  print_parameters(keys, text);
  expect_contains(text.str(), "default: 0.3333333333333333");
  Keys again(RawParameters::parse(text.str(), "printed.prm"));
  const SomeKeys values = read(again);
  EXPECT_EQ(canonical_parameters(keys), canonical_parameters(again));
  EXPECT_EQ(values.file, "/a #1/b\\#.png");
  EXPECT_EQ(values.fraction, 0.1234567890123456);
  EXPECT_TRUE(std::isnan(values.size));
}

TEST(Parameters, AHashBehindABackslashBeginsNoComment)
{
  const RawParameters raw =
    RawParameters::parse("set File = a\\#1/b # comment \\# too\n", "run.prm");
  EXPECT_EQ(raw.find("File")->value, "a#1/b");
}

TEST(Parameters, DifferencesAreNamed)
{
  Keys keys;
  apply(keys);
  const std::string all = canonical_parameters(keys);
  expect_contains(all, "Time step/Fraction = 0.3333333333333333\n");
  const std::string rest = canonical_parameters(keys, {"Time step/"});
  EXPECT_EQ(rest.find("Time step/"), std::string::npos);
  EXPECT_EQ(canonical_parameters(keys, {"Time step"}), all);

  EXPECT_EQ(parameter_differences("A/b = 1\nc = x y\n", "A/b = 1\nc = x y\n"), "");
  EXPECT_EQ(
    parameter_differences("A/b = 2\nc = \nnew = 3\n", "A/b = 1\nc = x y\nold = \n"),
    "A/b is 2 instead of 1, c is empty instead of x y, new is new (3), old is gone "
    "(empty)");
  EXPECT_EQ(
    parameter_differences("", "a = 1\nb = 1\nc = 1\nd = 1\ne = 1\nf = 1\ng = 1\n"),
    "a is gone (1), b is gone (1), c is gone (1), d is gone (1), e is gone (1) and 2 "
    "more");
}

TEST(Parameters, LineEndsOfAnySystem)
{
  for (const std::string end : {"\n", "\r\n", "\r"})
    {
      const RawParameters raw = RawParameters::parse(
        "# of another system" + end + "set Cells = 1\\" + end + "7" + end + "# end",
        "a.prm");
      EXPECT_EQ(raw.find("Cells")->value, "17");
      expect_contains(error_of_text("#" + end + end + "set Cels = 1" + end),
                      "run.prm:3: ");
    }
}

TEST(Parameters, NamesWhatIsWrong)
{
  expect_contains(
    error_of_text("set Cels = 1"),
    "run.prm:1: there is no key 'Cels' at the top level; did you mean 'Cells'?");
  expect_contains(
    error_of_text("\nsubsection Tme step\nend"),
    "run.prm:2: there is no subsection 'Tme step' at the top level; did you "
    "mean 'Time step'?");
  expect_contains(error_of_text("set Kind = one"), "did you mean 'Input/Deep/Kind'?");
  expect_contains(error_of_text("subsection Deep\nend"), "did you mean 'Input/Deep'?");
  expect_contains(error_of_text("subsection Input\nsubsection Time step\nend\nend"),
                  "there is no subsection 'Time step' in 'Input'; it stands at the top");
  expect_contains(error_of_text("subsection Time step\nset Zzzzzzzzz = 1\nend"),
                  "the keys here are Fraction, Size, Output");
  expect_contains(error_of_text("set Cells = 1\n\nset Cells = 2"),
                  "run.prm:3: Cells is set again; line 1 has set it already");
  expect_contains(error_of_text("set Cells = 0"),
                  "run.prm:1: Cells is '0' but must be a whole number in [1, 1000]");
  expect_contains(error_of_text("set Cells = 3.5"), "whole number");
  expect_contains(error_of_text("set Cells ="), "Cells is ''");
  for (const std::string value : {"0", "1.0001", "nan", "inf", "0.5 m", "0,5", "1e999"})
    expect_contains(
      error_of_text("subsection Time step\nset Fraction = " + value + "\nend"),
      "run.prm:2: Time step/Fraction is '" + value + "' but must be a number in (0, 1]");
  expect_contains(error_of_text("set Cells = 30 GPa"), "write numbers without a unit");
  expect_contains(error_of_text("subsection Time step\nset Output = 0,003, 0,002\nend"),
                  "write decimals with a point");
  expect_contains(error_of_text("subsection Time step\nset Output = 1\nend"),
                  "2 to 3 comma separated numbers > 0");
  const std::string deep = "subsection Input\nsubsection Deep\n";
  expect_contains(error_of_text(deep + "set Kind = three\nend\nend"),
                  "one of one, two words");
}

TEST(Parameters, LinesOfAnotherFile)
{
  std::string many;
  for (unsigned int k = 0; k < 1001; ++k)
    many += "include empty.inc\n";
  const std::map<std::string, std::string> files = {
    {"case/load.inc", "subsection Top\nset Pressure = 1\nend\ninclude deep/more.inc\n"},
    {"case/deep/more.inc", "set Table = a.csv\n"},
    {"case/itself.inc", "include ./itself.inc\n"},
    {"case/open.inc", "\nsubsection Top\n"},
    {"case/closes.inc", "end\n"},
    {"case/empty.inc", "#\n"},
    {"case/many.inc", many}};
  const auto parse = [&](const std::string &text) {
    return RawParameters::parse(text, "case/run.prm", [&](const std::string &name) {
      const auto found = files.find(name);
      if (found == files.end())
        throw UserError("there is no file " + name);
      return found->second;
    });
  };
  const RawParameters raw =
    parse("subsection Body\ninclude load.inc # the same\nend\nset Z = 1");
  const RawParameters::Entry *const table = raw.find("Body/Table");
  ASSERT_TRUE(raw.find("Body/Top/Pressure") && raw.find("Z") && table);
  EXPECT_EQ(RawParameters::origin(*raw.find("Body/Top/Pressure")), "case/load.inc:2");
  EXPECT_EQ(RawParameters::origin(*raw.find("Z")), "case/run.prm:4");
  EXPECT_EQ(RawParameters::folder(*table), "case/deep");
  EXPECT_EQ(raw.files(), (std::vector<std::string>{"case/run.prm", "case/load.inc",
                                                   "case/deep/more.inc"}));
  EXPECT_EQ(raw.text(),
            "subsection Body\n# include load.inc\nsubsection Top\nset Pressure = 1\n"
            "end\n# include deep/more.inc\nset Table = a.csv\nend\nset Z = 1\n");

  const auto error = [&](const std::string &what, const std::string &text) {
    expect_error(what, [&] { parse(text); });
  };
  error("case/run.prm:1: 'include' names no file", "include");
  error("case/run.prm:2: 'include': there is no file case/none.inc",
        "\ninclude none.inc");
  error("case/itself.inc:1: case/itself.inc includes itself", "include itself.inc");
  error("case/run.prm:1: case/run.prm includes itself", "include run.prm");
  error("more than 1000 files are included", "include many.inc");
  error("case/load.inc:2: Top/Pressure is set again; the file is included twice",
        "include load.inc\ninclude load.inc");
  error("case/open.inc:2: the subsection 'Top' has no 'end'", "include open.inc\nend");
  error("case/closes.inc:1: 'end' without", "subsection Top\ninclude closes.inc");
  error("case/run.prm:3: Top/Pressure is set again; case/load.inc:2 has set it already",
        "include load.inc\nsubsection Top\nset Pressure = 2\nend");
}

TEST(Parameters, NamesWhatIsNoParameterFile)
{
  expect_contains(error_of_text("Cells = 1"), "run.prm:1: 'Cells = 1' is not understood");
  expect_contains(error_of_text("set Cells 1"), "has no '='");
  expect_contains(error_of_text("set = 1"), "a key has no name");
  expect_contains(error_of_text("end"), "run.prm:1: 'end' without an open subsection");
  expect_contains(error_of_text("\nsubsection Time step\nset Fraction = 1"),
                  "run.prm:2: the subsection 'Time step' has no 'end'");
  expect_contains(error_of_text(std::string("\x89HDF\0\0", 6)), "not a text file");
}

TEST(Parameters, OtherEncodingsThanUtf8AreNamed)
{
  const auto parse = [](const std::string &text) { RawParameters::parse(text, "a.prm"); };
  expect_error("a.prm:2: the line is not UTF-8",
               [&] { parse("# x\nset Names = Tr\xe4ger"); });
  parse("set Names = Tr\u00e4ger # Tr\xe4ger"); // comments may be anything
}

TEST(Parameters, RawTextDecidesSections)
{
  RawParameters raw = RawParameters::parse("subsection Phases\nset Names = a,  b c\n"
                                           "subsection b c\nend\nend\n",
                                           "run.prm");
  ASSERT_EQ(raw.subsections().size(), 2u);
  EXPECT_EQ(raw.subsections()[1].path, "Phases/b c");
  EXPECT_EQ(raw.find("Phases/Count"), nullptr);
  raw.override_with("Phases/Names=x");
  EXPECT_EQ(raw.find("Phases/Names")->value, "x");
}

// Found by a fuzzer: names that were accepted and printed, but not read again.
TEST(Parameters, NamesOfSubsectionsCanBeTyped)
{
  const auto read = [](const std::string &list) {
    Keys keys(RawParameters::parse("set Names = " + list + "\n", "run.prm"));
    std::vector<std::string> names;
    keys.bind_names("Names", names, "phase", "");
    return names;
  };
  EXPECT_EQ(read("a, b c"), (std::vector<std::string>{"a", "b c"}));
  for (const std::string name : {"b  c", "b\tc", "a/b", "a =", "a\"", ".", "..", ""})
    expect_error("Names: '" + name +
                   "' cannot be the name of a phase; use letters, "
                   "digits and single blanks",
                 [&] { read("x, " + name); });
}

TEST(Parameters, ConditionsAndRenamedKeys)
{
  const auto read = [](const std::string &text) {
    Keys keys(RawParameters::parse(text, "run.prm"));
    double low = 1., high = 2.;
    std::string solver = "ml";
    const auto bind    = [&]() {
      keys.bind("Low", low, Range::any(), "");
      keys.bind("High", high, Range::any(), "");
      keys.bind("Solver", solver, {"jacobi", "ml"}, "");
      keys.renamed("Lowest", "Low");
      keys.renamed("Solver = assembled", "ml");
      keys.require(low <= high, "Low", "it is above High");
    };
    bind();
    keys.apply();
    bind();
  };
  read("set High = 1");
  EXPECT_EQ(user_error([&]() { read("set Low = 3"); }), "Low: it is above High");
  EXPECT_EQ(user_error([&]() { read("set Lowest = 3"); }),
            "run.prm:1: the key Lowest is called 'Low' now; rename it");
  EXPECT_EQ(user_error([&]() { read("set Solver = assembled"); }),
            "run.prm:1: Solver = assembled is called 'ml' now; set Solver = ml");
}

TEST(TextOfNumbers, ReadsBack)
{
  for (const double x : {1. / 3., 4.4e-9, 5e-324, -0., 1e22})
    {
      double back;
      ASSERT_TRUE(parse_number(to_text(x), back));
      EXPECT_EQ(x, back);
    }
}
