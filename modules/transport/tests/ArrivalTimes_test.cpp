#include "lamp/transport/ArrivalTimes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TemporaryFolder.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"

namespace lamp {
namespace {

using testing::HasSubstr;

/** A file of the running test's own. */
std::string fileWith(const std::string& text) {
  const std::string path = test::freshFolder() + "/A.arrivals.csv";
  writeTextFile(path, text);
  return path;
}

/** What is said of a file, without its folder. */
std::string faultOf(const std::string& text) {
  try {
    readArrivals(fileWith(text));
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    EXPECT_THAT(what, HasSubstr("/A.arrivals.csv"));
    return what.substr(what.rfind("A.arrivals.csv"));
  }
  return "";
}

TEST(ArrivalTimes, ALinkThatNeverBreaksDeliversAtOnce) {
  EXPECT_EQ(ArrivalTimes().at(12.5), 12.5);
}

TEST(ArrivalTimes, DataArriveWithTheFirstRowAtOrAfterThem) {
  const ArrivalTimes times =
      readArrivals(fileWith("stamp,arrival\n1000.000000,1000.500000\n1010.000000,1200.000000\n"
                            "1020.000000,1200.000000\n"));
  EXPECT_EQ(times.at(0), 1000.5);
  EXPECT_EQ(times.at(1000), 1000.5);
  EXPECT_EQ(times.at(1000.1), 1200);
  EXPECT_EQ(times.at(1020), 1200);
  EXPECT_EQ(times.at(5000), 1200) << "beyond the end, with the last";
}

TEST(ArrivalTimes, SixDecimalsOfAStampFindTheirRow) {
  // Clocks tick in 100 ns; the file is written with microseconds, rounded down or up.
  for (int tick = 0; tick < 10; ++tick) {
    const double stamp = 1.7e9 + 0.123456 + 1e-7 * tick;
    const ArrivalTimes times = readArrivals(fileWith("stamp,arrival\n" + formatFixed(stamp, 6) +
                                                     ",1700000100\n1700000001,1700000200\n"));
    EXPECT_EQ(times.at(stamp), 1700000100) << tick;
  }
}

TEST(ArrivalTimes, ColumnsAreFoundByName) {
  const ArrivalTimes times =
      readArrivals(fileWith("via,arrival,stamp\r\nrelay,30,20\r\n\"a, b\",31,21\r\n"));
  EXPECT_EQ(times.at(20), 30);
  EXPECT_EQ(times.at(21), 31);
}

TEST(ArrivalTimes, FaultsAreNamedWithFileAndLine) {
  const std::string good = "stamp,arrival\n10,11\n";
  EXPECT_EQ(faultOf(good), "");
  EXPECT_THAT(faultOf(""), HasSubstr("csv:1: the header must name the columns stamp and arrival"));
  EXPECT_THAT(faultOf("stamp,arrived\n10,11\n"), HasSubstr("csv:1: the header"));
  EXPECT_THAT(faultOf("stamp,arrival\n"), HasSubstr("holds no arrival"));
  EXPECT_THAT(faultOf(good + "12\n"), HasSubstr("csv:3: has 1 cells"));
  EXPECT_THAT(faultOf(good + "12,13,14\n"), HasSubstr("csv:3: has 3 cells"));
  EXPECT_THAT(faultOf(good + "12,soon\n"),
              HasSubstr("csv:3: arrival 'soon' is not a finite number"));
  EXPECT_THAT(faultOf(good + "12 s,13\n"), HasSubstr("csv:3: stamp '12 s' is not a finite number"));
  EXPECT_THAT(faultOf(good + "nan,13\n"), HasSubstr("csv:3: stamp 'nan' is not a finite number"));
  EXPECT_THAT(faultOf(good + "12,inf\n"), HasSubstr("csv:3: arrival 'inf' is not a finite number"));
  EXPECT_THAT(faultOf(good + "12,11.5\n"), HasSubstr("csv:3: 11.500000 is an arrival before its "
                                                     "stamp 12.000000"));
  EXPECT_THAT(faultOf(good + "10,12\n"),
              HasSubstr("csv:3: 10.000000 is not later than the stamp above, 10.000000"));
  EXPECT_THAT(faultOf(good + "9,12\n"),
              HasSubstr("csv:3: 9.000000 is not later than the stamp above"));
  EXPECT_THAT(faultOf("stamp,arrival\n10,90\n12,80\n"),
              HasSubstr("csv:3: 80.000000 is an arrival before the one above, 90.000000"));
}

TEST(ArrivalTimes, AFileThatIsNotThereIsNamed) {
  try {
    readArrivals("/nowhere/A.arrivals.csv");
    FAIL() << "must not be accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/A.arrivals.csv"));
  }
}

}  // namespace
}  // namespace lamp
