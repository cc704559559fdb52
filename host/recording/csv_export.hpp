#pragma once

#include <filesystem>
#include <string>

#include "host/base/files.hpp"
#include "host/recording/run.hpp"

namespace astro::recording {

/// Writes `odometry.csv` and `truth.csv` into `folder` (created if needed) for PlotJuggler and spreadsheets:
/// decimal points, commas between cells, one row per sample. The first column is `__time`, seconds on the
/// robot's clock; the names of the others have their unit at the end and slashes as in a tree. Numbers are
/// shortest decimals that read back exactly; the pose of an invalid truth sample is empty. Each file appears
/// complete or not at all. Throws astro::Error naming the file.
void export_csv(const Run& run, const std::filesystem::path& folder);

/// The same two files, written while samples arrive. They get their names when they are closed.
class CsvWriter {
 public:
  explicit CsvWriter(const std::filesystem::path& folder);

  void add(const OdometrySample& sample);
  void add(const TruthSample& sample);
  void close();

 private:
  class Table {
   public:
    Table(const std::filesystem::path& path, std::string heading);
    void add(const std::string& row);
    void close();

   private:
    PartFile file_;
    std::string waiting_;
  };

  Table odometry_, truth_;
};

}  // namespace astro::recording
