#include "emit/write_files.hpp"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "support/shell_command.hpp"

namespace dashpot::compiler {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

// Fails if files are not written as they are, or a folder that is missing is not made.
TEST(WriteFiles, WritesAllAndMakesTheFolder) {
  const testing::TemporaryFolder folder;
  const fs::path target = folder.path() / "a" / "b";
  Diagnostics diagnostics;
  ASSERT_TRUE(write_files(target.string(), {{"one.hpp", "1\n"}, {"two.hpp", ""}}, diagnostics));
  EXPECT_EQ(names_in(target), (std::vector<std::string>{"one.hpp", "two.hpp"}));
  EXPECT_EQ(testing::text_of(target / "one.hpp"), "1\n");
}

// Fails if an older, longer file shines through, or half-written ones are left beside it.
TEST(WriteFiles, ReplacesWholeFiles) {
  const testing::TemporaryFolder folder;
  Diagnostics diagnostics;
  ASSERT_TRUE(write_files(folder.path().string(), {{"x.hpp", "a long text\n"}}, diagnostics));
  ASSERT_TRUE(write_files(folder.path().string(), {{"x.hpp", "short\n"}}, diagnostics));
  EXPECT_EQ(testing::text_of(folder.path() / "x.hpp"), "short\n");
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"x.hpp"});
}

// Fails if one file that cannot be written does not keep all others from being replaced.
TEST(WriteFiles, WritesNoneWhereOneCannotBeWritten) {
  const testing::TemporaryFolder folder;
  testing::write_text(folder.path() / "good.hpp", "before\n");
  fs::create_directory(folder.path() / "bad.hpp");
  Diagnostics diagnostics;
  EXPECT_FALSE(write_files(folder.path().string(), {{"good.hpp", "after\n"}, {"bad.hpp", "x\n"}}, diagnostics));
  EXPECT_TRUE(diagnostics.has_errors());
  EXPECT_EQ(testing::text_of(folder.path() / "good.hpp"), "before\n");
  EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"bad.hpp", "good.hpp"}));
}

// Fails if folders that were made for files which cannot be written stay, or one that was there before goes.
TEST(WriteFiles, LeavesNoFolderBehind) {
  const testing::TemporaryFolder folder;
  fs::create_directory(folder.path() / "before");
  fs::create_directory(folder.path() / "bad.hpp");
  Diagnostics diagnostics;
  EXPECT_FALSE(write_files(folder.path().string(),
                           {{"a/b/good.hpp", "x\n"}, {"before/good.hpp", "x\n"}, {"bad.hpp", "x\n"}}, diagnostics));
  EXPECT_EQ(names_in(folder.path()), (std::vector<std::string>{"bad.hpp", "before"}));
}

// Fails if a link to a file becomes a file of its own.
TEST(WriteFiles, FollowsLinks) {
  const testing::TemporaryFolder folder;
  testing::write_text(folder.path() / "far.csv", "before\n");
  fs::create_symlink("far.csv", folder.path() / "near.csv");
  Diagnostics diagnostics;
  ASSERT_TRUE(write_files(folder.path().string(), {{"near.csv", "after\n"}}, diagnostics));
  EXPECT_TRUE(fs::is_symlink(folder.path() / "near.csv"));
  EXPECT_EQ(testing::text_of(folder.path() / "far.csv"), "after\n");
}

// Fails if a pipe or a device, /dev/stdout for one, is replaced by a file.
TEST(WriteFiles, WritesIntoPipes) {
  const testing::TemporaryFolder folder;
  const std::string pipe = (folder.path() / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  Diagnostics diagnostics;
  ASSERT_TRUE(write_files("", {{pipe, "through\n"}}, diagnostics));
  char read[16] = {};
  EXPECT_EQ(::read(reader, read, sizeof read), 8);
  EXPECT_STREQ(read, "through\n");
  EXPECT_TRUE(fs::is_fifo(pipe));
  ::close(reader);
}

// Fails if a folder that cannot be made is not reported.
TEST(WriteFiles, ReportsAFolderThatCannotBeMade) {
  const testing::TemporaryFolder folder;
  testing::write_text(folder.path() / "file", "");
  Diagnostics diagnostics;
  EXPECT_FALSE(write_files((folder.path() / "file" / "inside").string(), {{"x.hpp", ""}}, diagnostics));
  EXPECT_TRUE(diagnostics.has_errors());
}

}  // namespace
}  // namespace dashpot::compiler
