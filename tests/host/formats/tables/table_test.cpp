#include "host/formats/tables/table.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "host/formats/tables/column_name.hpp"
#include "host/formats/tables/row_times.hpp"
#include "host/formats/tables/stated_columns.hpp"
#include "host/formats/tables/text_file.hpp"
#include "host/formats/tables/time_column.hpp"
#include "host/formats/tables/units.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

namespace astro::tables {
namespace {

using support::Tells;
using support::ThrowsTelling;
using support::told_by;
using testing::ElementsAre;

std::vector<std::vector<std::string>> rows_of(std::string_view text) {
  Table table(text, "t.csv");
  std::vector<std::vector<std::string>> rows;
  while (table.next()) rows.emplace_back(table.cells().begin(), table.cells().end());
  return rows;
}

std::vector<std::string> names_of(std::string_view text) { return Table(text, "t.csv").names(); }

TEST(Table, FindsTheSeparatorByWhatTheCellsAreThen) {
  const auto cells = ElementsAre(ElementsAre("0.5", "1", "2"), ElementsAre("0.6", "3", "4"));
  for (const char* text : {"t,l,r\n0.5,1,2\n0.6,3,4\n", "t;l;r\n0.5;1;2\n0.6;3;4\n",
                           "t\tl\tr\n0.5\t1\t2\n0.6\t3\t4\n", "t l r\n0.5 1  2\n  0.6 3 4 \n",
                           "t | l | r\n0.5 | 1 | 2\n0.6 | 3 | 4\n", "t, l, r\r\n0.5, 1, 2\r\n0.6, 3, 4\r\n",
                           "\"t\",\"l\",\"r\"\n\"0.5\",\"1\",\"2\"\n\"0.6\",\"3\",\"4\"\n"}) {
    EXPECT_THAT(names_of(text), ElementsAre("t", "l", "r")) << text;
    EXPECT_THAT(rows_of(text), cells) << text;
  }
  EXPECT_THAT(rows_of("t;l;r\n0,5;1,5;2\n0,6;3;4,25\n"),
              ElementsAre(ElementsAre("0,5", "1,5", "2"), ElementsAre("0,6", "3", "4,25")));
  EXPECT_THAT(rows_of("0,5 1,5 2\n0,6 3 4,25\n"),
              ElementsAre(ElementsAre("0,5", "1,5", "2"), ElementsAre("0,6", "3", "4,25")));
  EXPECT_THAT(rows_of("2024-05-01 10:00:00,1,2\n2024-05-01 10:00:01,1,2\n").front(),
              ElementsAre("2024-05-01 10:00:00", "1", "2"));
}

TEST(Table, FindsTheNamesAboveTheRows) {
  EXPECT_THAT(names_of("sep=;\nt;x\n1;2\n"), ElementsAre("t", "x"));
  EXPECT_THAT(names_of("sep=\t\nt\tx\n1\t2\n"), ElementsAre("t", "x"));
  EXPECT_EQ(Table("A title\n1,2\n3,4\n", "t.csv").line_of_names(), 0);
  EXPECT_THAT(rows_of("t,x,note\n1,2,\"a \"\"b\"\", c\"\n").front(), ElementsAre("1", "2", "a \"\"b\"\", c"));
  EXPECT_THAT(names_of("Log of robot 5\n\nfirmware 1.2\nt,x\n1,2\n3,4\n"), ElementsAre("t", "x"));
  EXPECT_THAT(names_of("# t x\n1 2\n3 4\n"), ElementsAre("t", "x"));
  EXPECT_THAT(names_of("# written by a script\n# t,x\n1,2\n3,4\n"), ElementsAre("t", "x"));
  EXPECT_THAT(names_of("t,x,note\n% a comment\ns,mm,-\n1,2,a\n"), ElementsAre("t [s]", "x [mm]", "note"));
  EXPECT_THAT(names_of("1,2\n3,4\n"), ElementsAre());
  EXPECT_THAT(names_of("A title\n1,2\n3,4\n"), ElementsAre());
  EXPECT_THAT(rows_of("t,x\n1,2\n# paused\n\n,,\n3,4\n"),
              ElementsAre(ElementsAre("1", "2"), ElementsAre("3", "4")));
}

TEST(Table, DecimalCommasBetweenCommasAreTold) {
  Table table("t,l,r\n0,05,1,5,2,5\n0,1,3,5,4,5\n", "t.csv");
  EXPECT_THAT([&] { table.require_names(); },
              ThrowsTelling(TableProblem::rows_of_other_length, "t.csv", "2", "6", "3"));
  EXPECT_NO_THROW(Table("t,x\n1,2,\n3,4,\n", "t.csv").require_names()) << "empty cells at the end";
}

TEST(Table, OnlyTextIsOne) {
  EXPECT_THAT([] { Table("", "t.csv"); }, ThrowsTelling(TextProblem::empty, "t.csv"));
  EXPECT_THAT([] { Table(std::string_view("a,b\n\0", 5), "t.csv"); },
              ThrowsTelling(TextProblem::not_plain_text, "t.csv", "5"));
}

TEST(Table, Utf16BecomesUtf8) {
  const std::string text = "t;\xC2\xB5s;\xF0\x9F\x98\x80\r\n1;2;3\r\n";
  const auto utf16 = [&](bool big, bool mark) {
    std::vector<std::uint16_t> units = {'t',  ';', 0xB5, 's', ';', 0xD83D, 0xDE00, '\r',
                                        '\n', '1', ';',  '2', ';', '3',    '\r',   '\n'};
    if (mark) units.insert(units.begin(), 0xFEFF);
    Bytes bytes;
    for (const std::uint16_t unit : units) {
      bytes.push_back(static_cast<std::uint8_t>(big ? unit >> 8U : unit));
      bytes.push_back(static_cast<std::uint8_t>(big ? unit : unit >> 8U));
    }
    return bytes;
  };
  for (const bool big : {false, true}) EXPECT_EQ(as_text(in_utf8(utf16(big, true))), text);
  const Bytes plain(text.begin(), text.end());
  EXPECT_EQ(in_utf8(plain), plain);
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "a.csv", std::ios::binary) << as_text(utf16(false, true));
  EXPECT_EQ(as_text(text_of_file(folder.path() / "a.csv")), text);
}

TEST(CellNumber, UnderstandsEveryDecimalMarkThatIsOnlyOneThing) {
  const auto number = [](std::string_view cell, char separator = ';') {
    return cell_number(cell, separator);
  };
  EXPECT_EQ(number("-1.5e3"), -1500);
  EXPECT_EQ(number("+2"), 2);
  EXPECT_EQ(number("0,05"), 0.05);
  EXPECT_EQ(number("1,250"), 1.25) << "a comma in a table of semicolons";
  EXPECT_EQ(number("1.234,5"), 1234.5);
  EXPECT_EQ(number("1,234,567.5"), 1234567.5);
  EXPECT_EQ(number("1,234,567"), 1234567);
  EXPECT_EQ(number("-12,5", ','), -12.5) << "in quotes";
  EXPECT_EQ(number("0,125", ','), 0.125) << "no group begins with a zero";
  EXPECT_EQ(number("1,250", ','), std::nullopt) << "1.25 or 1250";
  for (const char* bad : {"", "x", "1,2,3", "1.2.3", "12 3", "1,23,456.5", "nan", "inf", "0x10", "1e999", ",",
                          "1.234,56.7", "1 2345"})
    EXPECT_EQ(number(bad), std::nullopt) << bad;
}

/// The first number of the last column, and the mark that the table shows.
std::optional<double> last_number(std::string_view text) {
  Table table(text, "t.csv");
  EXPECT_TRUE(table.next());
  return cell_number(table.cell(table.columns() - 1), table.style());
}

TEST(CellNumber, TheTableShowsWhichMarkIsTheDecimalOne) {
  EXPECT_EQ(last_number("t;l\n3,120;1.005\n3,14;1.010\n"), 1005) << "a decimal comma in the times";
  EXPECT_EQ(last_number("t;l\n3,120;1.005\n3,140;1.010\n"), 1005)
      << "each may be either: the times have decimals";
  EXPECT_EQ(last_number("t\tl\n3.12\t1,005\n3.14\t1,010\n"), 1005);
  EXPECT_EQ(last_number("t,l\n3.12,\"1,005\"\n3.14,\"1,010\"\n"), 1005);
  EXPECT_EQ(last_number("t\tl\n3\t1.005\n4\t1.010\n5\t985\n"), 1005)
      << "no decimals end in zero or are left out";
  EXPECT_EQ(last_number("t\tl\n3\t1.005\n4\t1.01\n5\t1\n"), 1.005);
  EXPECT_EQ(last_number("t;l\n3,120;1\xC2\xA0"
                        "005,5\n3,14;1\n"),
            1005.5)
      << "a blank that does not break";
  EXPECT_EQ(last_number("t;l\n0.5;1'005\n0.6;1\n"), 1005);
}

TEST(Times, AreExact) {
  EXPECT_EQ(exact_ns("1700000000.123456789", 9, ','), 1'700'000'000'123'456'789);
  EXPECT_EQ(exact_ns("1.403715529112143517e+09", 9, ','), 1'403'715'529'112'143'517);
  EXPECT_EQ(exact_ns("-0.0000000015", 9, ','), -2);
  EXPECT_EQ(exact_ns("12,5", 6, ';'), 12'500'000);
  EXPECT_EQ(exact_ns("1e3", 0, ','), 1000);
  EXPECT_EQ(exact_ns("12.9", 0, ','), 13);
  EXPECT_EQ(exact_ns("1.0005", 3, ','), 1001);
  EXPECT_EQ(exact_ns("0.00000000000000000000000000001", 9, ','), 0);
  for (const char* bad : {"", ".", "e5", "1e", "1e99", "nan", "inf", "0x10", "1.2.3", "1-2", "12 3",
                          "99999999999", "1e-99999999999"})
    EXPECT_EQ(exact_ns(bad, 9, ','), std::nullopt) << bad;
}

TEST(Times, DatesAndTimesOfDayAreRead) {
  const TimeFormat date{TimeKind::date}, clock{TimeKind::clock};
  const std::int64_t second = 1'000'000'000;
  EXPECT_EQ(time_ns("1970-01-02T00:00:01.5Z", date, ','), 86'401 * second + second / 2);
  EXPECT_EQ(time_ns("2024-05-01 12:34:56.789012345", date, ','), 1'714'566'896'789'012'345);
  EXPECT_EQ(time_ns("2024-05-01T14:34:56+02:00", date, ','), 1'714'566'896 * second);
  EXPECT_EQ(time_ns("01.05.2024 12:34:56,5", date, ';'), 1'714'566'896 * second + second / 2);
  EXPECT_EQ(time_ns("14:05:09.25", clock, ','), 50'709 * second + second / 4);
  EXPECT_EQ(time_ns("14:05:09:250", clock, ','), 50'709 * second + second / 4);
  EXPECT_EQ(time_ns("2:05:09.25 PM", clock, ','), 50'709 * second + second / 4);
  EXPECT_EQ(time_ns("12:59 PM", clock, ','), 46'740 * second);
  EXPECT_EQ(time_ns("12:01 a.m.", clock, ','), 60 * second);
  EXPECT_EQ(time_ns("58:40.1", clock, ','), 3'520 * second + second / 10) << "minutes";
  EXPECT_EQ(time_ns("5/31/2024 2:34:56 PM", date, ','), time_ns("31.05.2024 14:34:56", date, ','));
  EXPECT_EQ(time_ns("31/05/2024 14:34:56", date, ','), time_ns("2024-05-31T14:34:56Z", date, ','));
  for (const char* bad :
       {"14:05:09:25", "13:00 PM", "05/03/2024 09:58:40", "2024-13-01 00:00:00", "2024-02-30T00:00:00",
        "25:00:00", "12:60:00", "2024-05-01", "12:34:56x", "12:34:56."})
    EXPECT_FALSE(written_time(bad)) << bad;
}

TEST(Times, TheUnitOfBareNumbersFollowsFromTheirSizeOrSpacing) {
  const auto power = [](double first, double step, double rows) {
    std::vector<double> times;
    for (int i = 0; i < 100; ++i) times.push_back(first + step * i);
    return power_found(times, step * rows);
  };
  EXPECT_EQ(power(0, 0.02, 3000), 9);
  EXPECT_EQ(power(5000, 20, 3000), 6);
  EXPECT_EQ(power(1e6, 20'000, 3000), 3);
  EXPECT_EQ(power(0, 2e7, 3000), 0);
  EXPECT_EQ(power(1.7e9, 0.02, 3000), 9) << "since 1970";
  EXPECT_EQ(power(1.7e12, 20, 3000), 6);
  EXPECT_EQ(power(1.7e15, 1000, 3000), 3);
  EXPECT_EQ(power(0, 1, 600), 9)
      << "a row a second for ten minutes, not a thousand rows a second for half a second";
  EXPECT_EQ(power(0, 1, 60'000), 6) << "a thousand rows a second for a minute";
  EXPECT_EQ(power(0, 0, 10), std::nullopt);
}

/// The times of all rows of a table, or those up to the first that is none.
std::vector<std::int64_t> times_in(std::string_view text) {
  Table table(text, "t.csv");
  TimeColumns columns;
  for (std::size_t i = 0; i < table.names().size(); ++i)
    if (const auto name = time_name(table.names()[i])) columns.take(i, *name);
  columns.settle(table);
  const auto format = time_format(table, columns);
  if (!format) return {};
  TimeReader reader(columns, *format, table.separator());
  std::vector<std::int64_t> times;
  while (table.next())
    if (const auto time = reader.read(table)) times.push_back(*time);
  return times;
}

TEST(Times, SecondsAndTheirFractionMayStandInTwoColumns) {
  for (const char* text :
       {"stamp.sec,stamp.nanosec,x\n5,250000000,1\n", "stamp_nsec,stamp_sec,x\n250000000,5,1\n",
        "header.stamp.secs,header.stamp.nsecs,x\n5,250000000,1\n", "sec,nanosec,x\n5,250000000,1\n",
        "sec,msec,x\n5,250,1\n", "tv_sec,tv_usec,x\n5,250000,1\n", "us,s_time,x\n250000,5,1\n",
        "time_s,ms,x\n5,250,1\n", "timestamp,usec,x\n5,250000,1\n"})
    EXPECT_THAT(times_in(text), ElementsAre(5'250'000'000)) << text;
  EXPECT_THAT(times_in("time;ms;x\n12:00:05;250;1\n"), ElementsAre(43'205'250'000'000));
}

TEST(Times, OfAMicrocontrollerGoOnWhereTheyStartAgain) {
  EXPECT_THAT(times_in("ms,x\n65500,1\n65520,2\n4,3\n24,4\n"),
              ElementsAre(65'500'000'000, 65'520'000'000, 65'540'000'000, 65'560'000'000));
  EXPECT_THAT(times_in("us,x\n4294950000,1\n4294960000,2\n2704,3\n"),
              ElementsAre(4'294'950'000'000, 4'294'960'000'000, 4'294'970'000'000));
  EXPECT_THAT(times_in("ms,x\n40500,1\n40520,2\n0,3\n"), ElementsAre(40'500'000'000, 40'520'000'000, 0))
      << "a controller that was reset";
}

TEST(Times, TwoWholeTimesAreNoSecondsAndTheirFraction) {
  EXPECT_THAT(times_in("time_s,time_ms,x\n5.25,5250,1\n6.25,6250,1\n"),
              ElementsAre(5'250'000'000, 6'250'000'000));
  EXPECT_THAT(times_in("sec,msec,x\n5,5250,1\n6,6250,1\n"), ElementsAre(5'250'000'000, 6'250'000'000))
      << "the finer one";
}

TEST(Times, OfSeveralRowsAreSpreadWhereTheyAreEven) {
  std::vector<std::int64_t> seconds, uneven;
  for (std::int64_t row = 7; row < 95; ++row) seconds.push_back(row / 10 * 1'000'000'000);
  for (std::int64_t row = 0; row < 95; ++row)
    uneven.push_back((row < 40 ? row / 20 : row / 5 - 6) * 1'000'000'000);
  const auto spread = spread_times(seconds);
  ASSERT_TRUE(spread);
  EXPECT_EQ(spread->step_s, 1);
  EXPECT_EQ(spread->rows_in_step, 10);
  for (std::int64_t row = 7; row < 95; ++row) {
    const std::int64_t at_ns = spread->times_ns[static_cast<std::size_t>(row - 7)];
    EXPECT_EQ(at_ns, 50'000'000 + row * 100'000'000) << row;
  }
  EXPECT_FALSE(spread_times(uneven)) << "twenty rows in one second, five in another";
  EXPECT_FALSE(spread_times({1, 1, 1, 2, 2, 2})) << "too few to tell";
}

TEST(Times, TimesOfDayGoOnAfterMidnight) {
  TimeReader reader({}, {TimeKind::clock}, ',');
  const auto before = reader.read("23:59:59.5"), after = reader.read("00:00:00.5"),
             later = reader.read("00:00:01");
  EXPECT_EQ(*after - *before, 1'000'000'000);
  EXPECT_EQ(*later - *after, 500'000'000);
}

std::string in_words(std::string_view text) {
  const ColumnName name = column_name(text);
  std::string out;
  for (const std::string& word : name.words) out += word + ' ';
  return out + '[' + name.unit_text + ']';
}

TEST(ColumnName, AnyStyleHasItsWordsAndItsUnit) {
  for (const char* text :
       {"encoderLeft [ticks]", "encoder_left_ticks", "Encoder Left (Ticks)", "encoder.left.ticks"})
    EXPECT_EQ(in_words(text), "encoder left [ticks]") << text;
  EXPECT_EQ(in_words("wl_rad_s"), "wl [rad_s]");
  EXPECT_EQ(column_name("x [ m ]").unit->quantity, Quantity::length);
  EXPECT_EQ(in_words("timeMs"), "time [ms]");
  EXPECT_EQ(in_words("FL"), "fl []");
  EXPECT_EQ(in_words("HTTPTime"), "http time []");
  EXPECT_EQ(in_words("speed (furlongs)"), "speed [furlongs]");
  EXPECT_FALSE(column_name("speed (furlongs)").unit);
}

TEST(Units, HaveTheirSpellings) {
  const auto same = [](std::string_view a, std::string_view b) {
    const auto one = unit_named(a), other = unit_named(b);
    return one && other && one->quantity == other->quantity && one->to_si == other->to_si;
  };
  for (const char* text : {"rad_s", "radps", "rad per s", "RAD/S", "rad/sec", "rad s^-1"})
    EXPECT_TRUE(same(text, "rad/s")) << text;
  for (const char* text : {"m_s", "mps", "m per second"}) EXPECT_TRUE(same(text, "m/s")) << text;
  EXPECT_DOUBLE_EQ(unit_named("rpm")->to_si * 60, unit_named("turns")->to_si);
  EXPECT_TRUE(same("km_h", "km/h"));
  EXPECT_TRUE(same("Millimetre", "mm") && same("decimetre", "dm"));
  EXPECT_FALSE(unit_named("furlong"));
}

TEST(StatedColumns, AreAListOrSayWhatSomeNamesMean) {
  const Table table("stamp,encA,encB,other\n1,2,3,4\n", "t.csv");
  EXPECT_THAT(names_with("", table), ElementsAre("stamp", "encA", "encB", "other"));
  EXPECT_THAT(names_with("time_ms, left_counts,right_counts", table),
              ElementsAre("time_ms", "left_counts", "right_counts"));
  EXPECT_THAT(names_with("stamp=time_ms,encB=left_counts", table),
              ElementsAre("time_ms", "", "left_counts", ""));
  EXPECT_THAT(told_by([&] { names_with("stamp=time_ms,enc=left_counts", table); }),
              Tells(StatedColumnsProblem::no_such_name, "t.csv", "enc", "stamp", "encA", "encB", "other"));
  EXPECT_THAT(names_with("STAMP=time_ms,enca=left_counts", table),
              ElementsAre("time_ms", "left_counts", "", ""));
  EXPECT_THAT(told_by([&] { names_with("stamp=time_ms,encA", table); }),
              Tells(StatedColumnsProblem::no_meaning, "t.csv", "encA"));
  EXPECT_THAT(told_by([&] { names_with("a,b,c,d,e", table); }),
              Tells(StatedColumnsProblem::too_many, "t.csv", "4"));
}

}  // namespace
}  // namespace astro::tables
