#include "host/base/text/csv_table.hpp"

#include "host/base/error.hpp"
#include "host/base/text/trimmed.hpp"

namespace astro {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Takes the first line off `rest`; ends at LF, CRLF or CR.
std::string_view take_line(std::string_view& rest) {
  const std::size_t end = rest.find_first_of("\r\n");
  const std::string_view line = rest.substr(0, end);
  if (end == std::string_view::npos) {
    rest = {};
  } else {
    rest.remove_prefix(end + (rest.substr(end, 2) == "\r\n" ? 2 : 1));
  }
  return line;
}

/// The cell without its quotes; a doubled quote inside quotes stands for one.
std::string unquoted(std::string_view cell) {
  std::string out;
  bool inside = false;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const bool doubled = inside && cell.substr(i, 2) == "\"\"";
    if (cell[i] != '"' || doubled) {
      out += cell[i];
      i += doubled ? 1 : 0;
    } else {
      inside = !inside;
    }
  }
  return std::string(trimmed(out));
}

/// More columns than any tracker writes.
constexpr std::size_t kMostColumns = 1000;

/// Memory limit of a table: this much plus twice the size of its text. Short cells take many times the memory
/// of their text, so a file of nothing but commas must not be held as a whole.
constexpr std::size_t kFreeTableBytes = std::size_t{48} << 20;

std::size_t memory_of(const CsvRow& row) {
  return 2 * sizeof(CsvRow) + row.cells.capacity() * sizeof(std::string);
}

CsvRow split_line(std::string_view text, int line, std::string_view name) {
  CsvRow out{line, {}};
  bool inside = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') inside = !inside;
    if (text[i] != ',' || inside) continue;
    out.cells.push_back(unquoted(trimmed(text.substr(begin, i - begin))));
    if (out.cells.size() >= kMostColumns)
      refuse(name, line, "the line has more than 1000 cells: this is no table of runs or poses",
             CsvProblem::too_many_columns);
    begin = i + 1;
  }
  if (inside) refuse(name, line, "a quote is opened and not closed on its line", CsvProblem::open_quote);
  out.cells.push_back(unquoted(trimmed(text.substr(begin))));
  return out;
}

bool is_blank(const CsvRow& row) {
  for (const std::string& cell : row.cells) {
    if (!cell.empty()) return false;
  }
  return true;
}

void require_width(const CsvTable& table, const CsvRow& row, std::string_view name) {
  const std::size_t expected = table.header.cells.size();
  if (row.cells.size() == expected) return;
  refuse(name, row.line,
         "the row has " + std::to_string(row.cells.size()) + " cells and the header " +
             std::to_string(expected) + ": give every column a cell, and write numbers with a decimal point",
         CsvProblem::row_of_other_length, {std::to_string(row.cells.size()), std::to_string(expected)});
}

void require_commas(const CsvRow& header, std::string_view name) {
  if (header.cells.size() > 1 || header.cells[0].find(';') == std::string::npos) return;
  refuse(name, header.line,
         "the cells are separated by semicolons: use commas, and decimal points in the numbers",
         CsvProblem::semicolons);
}

}  // namespace

void refuse(std::string_view name, int line, const std::string& what, Kind kind,
            const std::vector<std::string>& more) {
  std::vector<std::string> values{std::string(name), std::to_string(line)};
  values.insert(values.end(), more.begin(), more.end());
  throw Error(values[0] + ", line " + values[1] + ": " + what, kind, values);
}

CsvTable split_csv(std::string_view text, std::string_view name) {
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) text.remove_prefix(kByteOrderMark.size());
  if (const std::size_t at = text.find('\0'); at != std::string_view::npos)
    throw Error(std::string(name) + " is not plain text: byte " + std::to_string(at + 1) +
                    " is zero: save the table as comma separated UTF-8",
                CsvProblem::not_plain_text, {std::string(name), std::to_string(at + 1)});
  CsvTable out;
  std::size_t memory = 0;
  const std::size_t most = kFreeTableBytes + 2 * text.size();
  for (int line = 1; !text.empty(); ++line) {
    CsvRow row = split_line(take_line(text), line, name);
    if (is_blank(row)) continue;
    if (out.header.line == 0) {
      out.header = std::move(row);
      require_commas(out.header, name);
    } else {
      require_width(out, row, name);
      if ((memory += memory_of(row)) > most)
        refuse(name, line, "the table has more cells than can be held: split it into one file for each run",
               CsvProblem::too_many_cells);
      out.rows.push_back(std::move(row));
    }
  }
  if (out.header.line == 0) {
    throw Error(
        std::string(name) + " is empty: it needs a header such as ex_mm,ey_mm,etheta_rad and a row per run",
        CsvProblem::empty, {std::string(name)});
  }
  return out;
}

}  // namespace astro
