// What limits of control groups leave.
#include "base/memory.h"

#include <fstream>
#include <limits>

#include "support.h"

namespace defray::test::memory_test {
namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(Memory, TheLeastLimitOfAGroupAndThoseAboveItCounts) {
  const Folder folder;
  const std::filesystem::path tree = folder / "";
  write(tree / "job/memory.max", "3000\n");
  write(tree / "job/step/memory.max", "max\n");
  write(tree / "memory/memory.limit_in_bytes", "9223372036854771712\n");
  write(tree / "memory/old/memory.limit_in_bytes", "5000\n");
  EXPECT_EQ(control_group_limit("1:cpu:/x\n0::/job/step\n", tree), 3000u);
  EXPECT_EQ(control_group_limit("3:cpu:/x\n2:memory:/old/task\n0::/\n", tree), 5000u);
  EXPECT_EQ(control_group_limit("2:memory:/\n", tree), 9223372036854771712u);
  EXPECT_EQ(control_group_limit("", tree), std::numeric_limits<std::uint64_t>::max());
  write(tree / "memory.max", "1000\n");
  EXPECT_EQ(control_group_limit("0::/job/step\n", tree), 1000u);
}

TEST(Memory, ThereIsSome) {
  EXPECT_GT(usable_memory(), std::uint64_t{1} << 28);
  EXPECT_LT(usable_memory(), std::uint64_t{1} << 50);
}

}  // namespace
}  // namespace defray::test::memory_test
