#include "source/source_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "source/digest.hpp"
#include "source/render.hpp"
#include "source/utf8.hpp"
#include "support/temporary_folder.hpp"

namespace dashpot::compiler {
namespace {

namespace fs = std::filesystem;

std::pair<int, int> place(const SourceFile& file, std::size_t offset) {
  const Position position = file.position_of(offset);
  return {static_cast<int>(position.line), static_cast<int>(position.column)};
}

// If this fails, editors jump to the wrong place.
TEST(SourceFile, KnowsLinesAndColumns) {
  const SourceFile file("a.json", "ab\ncd\r\n\nx");
  EXPECT_EQ(place(file, 0), std::pair(1, 1));
  EXPECT_EQ(place(file, 2), std::pair(1, 3));  // the end of the line belongs to it
  EXPECT_EQ(place(file, 3), std::pair(2, 1));
  EXPECT_EQ(place(file, 7), std::pair(3, 1));
  EXPECT_EQ(place(file, 9), std::pair(4, 2));  // behind the last byte
  EXPECT_EQ(place(file, 99), std::pair(4, 2));
  EXPECT_EQ(file.line(1), "ab");
  EXPECT_EQ(file.line(2), "cd");
  EXPECT_EQ(file.line(3), "");
  EXPECT_EQ(file.line(4), "x");
}

// If this fails, columns of a file with a byte order mark are three too many.
TEST(SourceFile, DoesNotCountAByteOrderMark) {
  const SourceFile file("a.json", "\xEF\xBB\xBF{}");
  EXPECT_EQ(place(file, 3), std::pair(1, 1));
  EXPECT_EQ(place(file, 0), std::pair(1, 1));
  EXPECT_EQ(file.line(1), "{}");
}

// If this fails, an empty file brings the compiler down.
TEST(SourceFile, MayBeEmpty) {
  const SourceFile file("a.json", "");
  EXPECT_EQ(place(file, 0), std::pair(1, 1));
  EXPECT_EQ(file.line(1), "");
}

class SourceFiles : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  std::string said_about(const std::string& name) const {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_source(path(name), diagnostics));
    return render_text(diagnostics);
  }

  testing::TemporaryFolder folder_;
};

// If this fails, bytes are lost or changed between the disk and the parser.
TEST_F(SourceFiles, AreReadByteByByte) {
  const std::string bytes("a\r\n\0\xFF", 5);
  std::ofstream(path("bytes"), std::ios::binary) << bytes;
  Diagnostics diagnostics;
  const auto file = read_source(path("bytes"), diagnostics);
  ASSERT_TRUE(file);
  EXPECT_EQ(file->text(), bytes);
  EXPECT_EQ(file->path(), path("bytes"));
}

// If this fails, a file that is not there is taken for an empty one.
TEST_F(SourceFiles, ThatCannotBeReadAreRefused) {
  EXPECT_EQ(said_about("none"),
            "error: cannot read '" + path("none") + "': there is no such file [cannot-read-file]\n");
  fs::create_directories(path("sub"));
  EXPECT_EQ(said_about("sub"), "error: cannot read '" + path("sub") + "': it is a folder [cannot-read-file]\n");
}

// If this fails, a file of any size is drawn into memory.
TEST_F(SourceFiles, AreReadUpTo16MiB) {
  std::ofstream(path("largest")) << std::string(16u << 20, ' ');
  Diagnostics diagnostics;
  EXPECT_TRUE(read_source(path("largest"), diagnostics));
  std::ofstream(path("larger")) << std::string((16u << 20) + 1, ' ');
  EXPECT_EQ(said_about("larger"),
            "error: '" + path("larger") + "' is larger than 16 MiB, the most that is read [file-too-large]\n");
}

// If this fails, the digest in emitted code is not the one that other SHA-256 programs compute (FIPS 180-4, its
// examples).
TEST(Digest, IsSha256) {
  EXPECT_EQ(digest_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

// If this fails, malformed UTF-8 is taken for text, or text for malformed (boundaries of RFC 3629).
TEST(Utf8, CodePointsAreToldFromStrayBytes) {
  for (const std::string_view text : {"a", "\x7F", "\xC2\x80", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF",
                                      "\xEE\x80\x80", "\xEF\xBF\xBF", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"})
    EXPECT_EQ(code_point_length(text), text.size()) << text;
  for (const std::string_view text : {"", "\x80", "\xC1\xBF", "\xC2", "\xC2\x41", "\xE0\x9F\xBF", "\xED\xA0\x80",
                                      "\xEF\xBF", "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF"})
    EXPECT_EQ(code_point_length(text), 0u) << text;
}

}  // namespace
}  // namespace dashpot::compiler
