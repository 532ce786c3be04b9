// Names of the pictures of a stack, and what they have in common.
#include "io_testing.h"

#include "base/files.h"
#include "io/slice_names.h"
#include "io/voxel_file.h"

using namespace mesoslip;
using namespace mesoslip_tests;

TEST(SliceNames, OrderIsThatOfTheNumbers)
{
  const auto refusal = [](const std::vector<std::string> &names) {
    return user_error([&]() { require_slices_in_order("stack", names); });
  };
  expect_contains(refusal({"s1", "s10", "s2"}), "s10 comes before s2, against their");
  expect_contains(
    refusal({"S1.png", "S3.png", "s0.png", "s2.png"}),
    "S3.png comes before s0.png, against their numbers; write all names with "
    "small letters");
  expect_contains(refusal({"z-1", "z-2", "z0", "z1"}), "number them from 0 on");
  expect_contains(refusal({"s01.png", "s1.png", "s2.png"}), "have the same number");
  for (const std::vector<std::string> &names :
       std::vector<std::vector<std::string>>{{"z-1", "z0", "z1"},
                                             {"a-1", "a-2"},
                                             {"2-1", "2-2", "21"},
                                             {"z9.5.png", "z9.7.png"},
                                             {"A1", "a2"},
                                             {"one"},
                                             {"a", "b", "d"}})
    EXPECT_NO_THROW(require_slices_in_order("stack", names)) << names[0];
}

TEST(SliceNames, GapsAreNamed)
{
  const auto refusal = [](const std::vector<std::string> &names) {
    return user_error([&]() { require_slices_in_order("stack", names); });
  };
  expect_contains(refusal({"s0.png", "s1.png", "s3.png"}),
                  "stack: s2.png is missing between s1.png and s3.png");
  expect_contains(refusal({"v2_008", "v2_009", "v2_013"}), "v2_010 is missing");
  expect_contains(refusal({"s00", "s10", "s40"}), "s20 is missing");
  // Every tenth slice, and rounded steps of 12.5.
  require_slices_in_order("stack", {"s10", "s20", "s30"});
  require_slices_in_order("stack", {"s000", "s013", "s025", "s038"});
}

TEST(SliceNames, HiddenFilesAreNone)
{
  const TemporaryFolder folder;
  for (const char *name : {"._s0.png", "s0.png", "s1.png"})
    write_file(folder / name, "");
  VoxelSource source;
  source.path = folder.path;
  EXPECT_EQ(source.files(),
            (std::vector<std::string>{folder / "s0.png", folder / "s1.png"}));
}
