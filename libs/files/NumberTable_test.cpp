#include "files/NumberTable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "base/Errors.h"
#include "testing/ErrorOf.h"

namespace hybrid_slam::files {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct NumberTable : testing::Test {
  const std::string file = testing::TempDir() + "number_table_" + std::to_string(getpid()) + ".txt";
  ~NumberTable() override { std::remove(file.c_str()); }

  void write(const std::string& text) const { std::ofstream(file, std::ios::binary) << text; }
  void writeGzipped(const std::string& text) const {
    const gzFile out = gzopen(file.c_str(), "wb");
    gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
    gzclose(out);
  }
  std::string error() const {
    return test::errorOf([&] { readNumberTable(file, "a b c"); });
  }
};

TEST_F(NumberTable, KeepsFileOrderAndLineNumbers) {
  write("# a b c\n3 -2 1e-3\n\n  1\t2 3 \r\n# end\n1 2 4");
  const auto rows = readNumberTable(file, "a b c");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_THAT(rows[0].values, ElementsAre(3, -2, 1e-3));
  EXPECT_THAT(rows[1].values, ElementsAre(1, 2, 3));
  EXPECT_THAT(rows[2].values, ElementsAre(1, 2, 4));
  EXPECT_EQ(rows[0].line, 2u);
  EXPECT_EQ(rows[1].line, 4u);
  EXPECT_EQ(rows[2].line, 6u);
}

TEST_F(NumberTable, SkipsTheByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF";
  for (const char* end : {"\n", ""}) {
    write(mark + "1 2 3" + end);
    const auto rows = readNumberTable(file, "a b c");
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_THAT(rows[0].values, ElementsAre(1, 2, 3));
  }
  write(mark + "a,b\n1,2\n");
  EXPECT_EQ(readNumberTable(file, "a,b").size(), 1u);
}

TEST_F(NumberTable, ReadsGzippedFilesLikePlainOnes) {
  std::string text;  // more than one read buffer
  for (int i = 0; i < 20000; ++i) text += std::to_string(i) + " 0.5 -1\n";
  writeGzipped(text);
  const auto rows = readNumberTable(file, "a b c");
  ASSERT_EQ(rows.size(), 20000u);
  EXPECT_THAT(rows.back().values, ElementsAre(19999, 0.5, -1));
  EXPECT_EQ(rows.back().line, 20000u);
}

TEST_F(NumberTable, BrokenLinesAreNamed) {
  for (const char* line : {"1 2", "1 2 3 4", "1 2 x", "1 2 3x", "1 2 nan", "1 2 inf", "1,2,3", "1 2 0x10"}) {
    write(std::string("1 2 3\n") + line + "\n");
    EXPECT_EQ(error(), "broken line: file `" + file + "`, line 2; expected lines of 3 numbers, `a b c`")
        << line;
  }
}

TEST_F(NumberTable, CommaSeparatedUnderAHeader) {
  write("a,b\r\n1,-2\r\n\n3,4");
  const auto rows = readNumberTable(file, "a,b");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_THAT(rows[0].values, ElementsAre(1, -2));
  EXPECT_THAT(rows[1].values, ElementsAre(3, 4));
  EXPECT_EQ(rows[1].line, 4u);
  for (const char* text : {"1,2\n3,4\n", "b,a\n3,4\n", "a,b\n1\n", "a,b\n1,,2\n", "a,b\n1,2,3\n",
                           "a,b\n1,x\n", "a,b\n1 2\n", "a,b\n"}) {
    write(text);
    EXPECT_THROW(readNumberTable(file, "a,b"), InputError) << text;
  }
}

TEST_F(NumberTable, OverlongLinesAreNamed) {
  for (const char* begin : {"1 2 3\n# ", "1 2 3\n1 2 3 "}) {  // neither comments nor numbers may be so long
    writeGzipped(begin + std::string(1 << 20, ' ') + "\n4 5 6\n");
    EXPECT_EQ(error(), "line too long: file `" + file + "`, line 2; expected lines of 3 numbers, `a b c`");
  }
}

TEST_F(NumberTable, RowsAndLinesAreLimited) {
  std::string rows;
  for (int i = 0; i < 5'000'001; ++i) rows += "1 2 3\n";
  writeGzipped(rows);
  EXPECT_EQ(error(), "too many rows: file `" + file + "`, line 5000001; expected at most 5000000");
  writeGzipped(std::string(20'000'001, '\n'));
  EXPECT_EQ(error(), "too many lines: file `" + file + "`; expected at most 20000000");
}

TEST_F(NumberTable, EmptyMissingAndUnreadableFiles) {
  EXPECT_THAT(error(), HasSubstr("cannot open the file: file `" + file + "`"));
  write("# nothing\n\n");
  EXPECT_THAT(error(), HasSubstr("the file is empty: file `" + file + "`"));
  EXPECT_THROW(readNumberTable(testing::TempDir(), "a b c"), InputError);  // a folder
}

TEST_F(NumberTable, TruncatedGzipIsAnError) {
  std::string text;
  for (int i = 0; i < 20000; ++i) text += std::to_string(i * 7919 % 10007) + " 0.5 -1\n";
  writeGzipped(text);
  std::ifstream whole(file, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(whole), {});
  write(bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(error(), HasSubstr("cannot read the file"));
}

}  // namespace
}  // namespace hybrid_slam::files
