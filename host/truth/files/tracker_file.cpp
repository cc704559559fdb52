#include "host/truth/files/tracker_file.hpp"

#include "host/base/error.hpp"
#include "host/formats/tables/rows.hpp"
#include "host/truth/files/motive_csv.hpp"
#include "host/truth/files/plain_csv.hpp"
#include "host/truth/files/qualisys_tsv.hpp"
#include "host/truth/files/track_problem.hpp"
#include "host/truth/files/tum.hpp"
#include "host/truth/files/vicon_csv.hpp"
#include "host/truth/files/vicon_header.hpp"

namespace astro::truth {
namespace {

std::string_view first_cell(std::string_view line) {
  std::optional<std::string_view> rest = line;
  std::string_view cell;
  const char separator = tables::separator_of(line);
  tables::take_cell(rest, separator == ' ' ? '\t' : separator, cell);
  return cell;
}

bool is_vicon_start(tables::Rows rows) {
  if (!is_vicon_title(first_cell(rows.text())) || !rows.next()) return false;
  return tables::cell_number(first_cell(rows.text()), ',').has_value();
}

[[noreturn]] void refuse_kind(FileKind kind, std::string_view text, std::string_view file) {
  if (text.empty())
    throw Error("'" + std::string(file) + "' is empty", tables::TextProblem::empty, {std::string(file)});
  const std::string name = "'" + std::string(file) + "'";
  if (kind == FileKind::motive_rows)
    throw Error(name +
                    " is an export of Motive before version 1.7, whose form is not read: open the take in a "
                    "newer version of Motive and export it again",
                TrackProblem::older_motive, {std::string(file)});
  bodies_in_plain({text, file});  // says what a table lacks
  throw Error(name + " is none of the recordings that can be read", TrackProblem::unknown_form,
              {std::string(file)});
}

}  // namespace

FileKind recognise(std::string_view text) {
  if (text.find('\0') != text.npos) return FileKind::unknown;
  tables::Rows rows(text, "");
  if (!rows.next_filled()) return FileKind::unknown;
  const std::string_view first = first_cell(rows.text());
  if (first == "Format Version") return FileKind::motive;
  if (first == "comment" || first == "info") return FileKind::motive_rows;
  if (is_vicon_start(rows)) return FileKind::vicon;
  if (is_qualisys(text)) return FileKind::qualisys;
  bool filled = true;
  while (filled && rows.text().substr(0, 1) == "#") filled = rows.next_filled();
  if (!filled) return FileKind::unknown;
  const FileKind kind = tum_kind_of(rows.text());
  if (kind != FileKind::unknown) return kind;
  return is_plain(text) ? FileKind::plain : FileKind::unknown;
}

std::vector<BodyName> bodies_in(std::string_view text, std::string_view file, std::string_view columns) {
  if (!columns.empty()) return bodies_in_plain({text, file, columns});
  const FileKind kind = recognise(text);
  switch (kind) {
    case FileKind::motive:
      return bodies_in_motive(text, file);
    case FileKind::vicon:
      return bodies_in_vicon(text, file);
    case FileKind::qualisys:
      return bodies_in_qualisys(text, file);
    case FileKind::plain:
      return bodies_in_plain({text, file});
    case FileKind::tum:
    case FileKind::euroc:
      return {BodyName{}};
    case FileKind::motive_rows:
    case FileKind::unknown:
      break;
  }
  refuse_kind(kind, text, file);
}

BodyTrack read_track(std::string_view text, std::string_view file, std::string_view body,
                     std::string_view columns) {
  if (!columns.empty()) return read_plain({text, file, columns}, body);
  const FileKind kind = recognise(text);
  if (kind == FileKind::motive) return read_motive(text, file, body);
  if (kind == FileKind::vicon) return read_vicon(text, file, body);
  if (kind == FileKind::qualisys) return read_qualisys(text, file, body);
  if (kind == FileKind::plain) return read_plain({text, file}, body);
  if (kind == FileKind::motive_rows || kind == FileKind::unknown) refuse_kind(kind, text, file);
  if (!body.empty()) choose_body({BodyName{}}, body, file);
  return read_tum(text, file);
}

}  // namespace astro::truth
