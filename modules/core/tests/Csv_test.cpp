#include "lamp/core/Csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <locale>
#include <streambuf>

#include "TestSupport.h"
#include "lamp/core/Files.h"

namespace lamp {
namespace {

using test::thrownBy;
using testing::HasSubstr;

TEST(Csv, QuotesWhatRfc4180Quotes) {
  const CsvTable table{{"plain", "hard"}, {{"1", "a,b"}, {"2", "say \"hi\""}, {"3", "two\nlines"}}};
  EXPECT_EQ(table.text(), "plain,hard\n1,\"a,b\"\n2,\"say \"\"hi\"\"\"\n3,\"two\nlines\"\n");
}

TEST(Csv, TextReadsBack) {
  const CsvTable table{{"a", "b,c", ""},
                       {{"", "\"", "x"}, {"\r\n", ",,", " spaced "}, {"", "", ""}}};
  const CsvTable back = CsvTable::fromText(table.text(), "t.csv");
  EXPECT_EQ(back.columns, table.columns);
  EXPECT_EQ(back.rows, table.rows);
}

TEST(Csv, ReadsDosLineEndsAndALastRowWithoutOne) {
  const CsvTable table = CsvTable::fromText("a,b\r\n1,2\r\n3,4", "t.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(table.rows, (std::vector<std::vector<std::string>>{{"1", "2"}, {"3", "4"}}));
}

TEST(Csv, RowOfWrongLengthIsNamedByFileAndLine) {
  // The quoted line break makes the wrong row the fourth line.
  EXPECT_THAT(thrownBy([] { CsvTable::fromText("a,b\n\"1\n\",2\n3\n", "dir/t.csv"); }),
              HasSubstr("dir/t.csv:4: has 1 cells, the header has 2"));
}

TEST(Csv, QuoteThatIsNeverClosedIsNamedByFileAndLine) {
  EXPECT_THAT(thrownBy([] { CsvTable::fromText("a,b\n1,\"2\n3,4\n", "dir/t.csv"); }),
              HasSubstr("dir/t.csv:2: a quote is opened"));
}

TEST(Csv, ByteOrderMarkIsNoPartOfTheFirstColumn) {
  const CsvTable table = CsvTable::fromText("\xEF\xBB\xBFid,x\n1,2\n", "t.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"id", "x"}));
}

/** A text that counts how many of its characters are taken, and allows no going back. */
class CountingText : public std::streambuf {
 public:
  explicit CountingText(std::string text) : text_(std::move(text)) {}
  size_t taken = 0;

 protected:
  int_type underflow() override {
    return taken < text_.size() ? traits_type::to_int_type(text_[taken]) : traits_type::eof();
  }
  int_type uflow() override {
    const int_type c = underflow();
    if (c != traits_type::eof()) ++taken;
    return c;
  }

 private:
  const std::string text_;
};

TEST(Csv, APartOfAByteOrderMarkIsText) {
  for (const char* cell : {"\xEF", "\xEF\xBB", "\xEF\xEF\xBB\xBF", "\xEF\xBB\xBB\xBF"})
    EXPECT_EQ(CsvTable::fromText(std::string(cell) + "\n", "t.csv").columns.at(0), cell);
}

TEST(Csv, AByteOrderMarkInTheFirstCellIsWrittenAsText) {
  const CsvTable table{{"\xEF\xBB\xBFid", "x"}, {{"\xEF\xBB\xBF", "1"}}};
  const CsvTable again = CsvTable::fromText(table.text(), "t.csv");
  EXPECT_EQ(again.columns, table.columns);
  EXPECT_EQ(again.rows, table.rows);
}

TEST(Csv, EachCharacterIsTakenOnceHoweverManyRowsThereAre) {
  CsvTable table{{"a", "b"}, {}};
  for (int i = 0; i < 2000; ++i) table.rows.push_back({std::to_string(i), "two\nlines"});
  const std::string text = table.text();
  CountingText counting(text);
  std::istream in(&counting);
  EXPECT_EQ(CsvTable::read(in, "t.csv").rows, table.rows);
  EXPECT_EQ(counting.taken, text.size());
}

TEST(Csv, ReadsFilesAndFindsColumnsByName) {
  const std::string path = test::freshFolder() + "/t.csv";
  writeTextFile(path, "from,to\na:1,b:2\n");
  const CsvTable table = CsvTable::fromFile(path);
  EXPECT_EQ(table.rows.at(0).at(table.column("to")), "b:2");
  EXPECT_TRUE(table.has("from"));
  EXPECT_FALSE(table.has("From"));
  EXPECT_THAT(thrownBy([&] { table.column("reason"); }), HasSubstr("'reason'"));
  EXPECT_THAT(thrownBy([&] { CsvTable::fromFile(path + "x"); }), HasSubstr(path + "x"));
}

const double kDoubles[] = {0.0,
                           1.0,
                           -1.5,
                           0.1,
                           1.0 / 3.0,
                           1e-300,
                           -1e300,
                           1234567890.123456,
                           std::nextafter(1.0, 2.0),
                           std::numeric_limits<double>::min(),
                           std::numeric_limits<double>::denorm_min(),
                           std::numeric_limits<double>::max(),
                           std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()};

void expectDoublesReadBack() {
  for (const double value : kDoubles) {
    double back = -7;
    ASSERT_TRUE(parseDouble(formatDouble(value), back)) << formatDouble(value);
    EXPECT_EQ(back, value);
  }
}

TEST(Numbers, ReadBackToTheSameDouble) {
  expectDoublesReadBack();
}

TEST(Numbers, AreShort) {
  EXPECT_EQ(formatDouble(0.1), "0.1");
  EXPECT_EQ(formatDouble(30), "30");
  EXPECT_EQ(formatDouble(-0.0), "0");
  EXPECT_EQ(formatDouble(std::nan("")), "nan");
  EXPECT_EQ(formatDouble(-std::nan("")), "nan");
  EXPECT_EQ(formatDouble(-INFINITY), "-inf");
  EXPECT_EQ(formatFixed(1.0 / 3.0, 3), "0.333");
  EXPECT_EQ(formatFixed(1136125839.5, 6), "1136125839.500000");
  EXPECT_EQ(formatFixed(-2.5e-9, 3), "-0.000");
  EXPECT_EQ(formatFixed(std::nan(""), 3), "nan");
  EXPECT_EQ(formatFixed(1e300, 3), formatDouble(1e300));
}

TEST(Numbers, OnlyAWholeTextIsANumber) {
  double value = 0;
  for (const char* text :
       {"", " ", "1 ", " 1", "1x", "abc", "1,5", "0x10", "--1", "+-1", "+", "1e", "1e999", "1 ; x"})
    EXPECT_FALSE(parseDouble(text, value)) << "'" << text << "'";
  EXPECT_EQ(value, 0);
  EXPECT_TRUE(parseDouble("+1.5e3", value));
  EXPECT_EQ(value, 1500);
  EXPECT_TRUE(parseDouble("nan", value));
  EXPECT_TRUE(std::isnan(value));
}

/** A C locale with a decimal comma, where the machine has one. */
std::string commaLocale() {
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "es_ES.UTF-8", "fr_FR.UTF-8", "de_DE"})
    if (std::setlocale(LC_ALL, name)) {
      std::setlocale(LC_ALL, "C");
      return name;
    }
  return "";
}

class CommaNumbers : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Numbers, DoNotFollowTheStreamLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaNumbers));
  expectDoublesReadBack();
  EXPECT_EQ(formatDouble(1234567.5), "1234567.5");
  EXPECT_EQ(formatFixed(1234567.5, 2), "1234567.50");
  std::locale::global(before);
}

TEST(Numbers, DoNotFollowTheCLocale) {
  const std::string name = commaLocale();
  if (name.empty()) GTEST_SKIP() << "this machine has no locale with a decimal comma";
  std::setlocale(LC_ALL, name.c_str());
  expectDoublesReadBack();
  EXPECT_EQ(formatFixed(1.5, 2), "1.50");
  std::setlocale(LC_ALL, "C");
}

}  // namespace
}  // namespace lamp
