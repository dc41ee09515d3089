// The tables of sample_volumes/README.md, read as they stand there.
#pragma once

#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "scantet/image/level_set.h"

namespace scantet {

struct Sample {
  std::string file;
  double level = 0;
  InsideSide inside = InsideSide::above;
  double volume_mm3 = 0;
  int components = 0;
  int cavities = 0;
  int euler = 0;
};

inline std::string sample_path(const std::string& file) {
  return std::string(SCANTET_SAMPLE_VOLUMES) + "/" + file;
}

/// Every row; throws if there is none or one cannot be read.
inline std::vector<Sample> read_sample_table() {
  std::ifstream in(sample_path("README.md"));
  std::vector<Sample> table;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("| segmentation", 0) == 0) break;
    if (line.rfind("| ", 0) != 0 || line.rfind("| file", 0) == 0 || line.rfind("| ---", 0) == 0) continue;
    for (char& c : line) c = c == '|' ? ' ' : c;
    std::istringstream row(line);
    Sample s;
    std::string side;
    if (!(row >> s.file >> s.level >> side >> s.volume_mm3 >> s.components >> s.cavities >> s.euler)) {
      throw std::runtime_error("cannot read the row: " + line);
    }
    s.inside = side == "below" ? InsideSide::below : InsideSide::above;
    table.push_back(s);
  }
  if (table.empty()) throw std::runtime_error("no table in sample_volumes/README.md");
  return table;
}

/// A label of a segmentation.
struct SampleLabel {
  std::string file;
  int label = 0;
  std::uint64_t voxels = 0;
  double volume_mm3 = 0;
  std::string what;
};

/// Every label of every segmentation; throws if there is none or one cannot be read.
inline std::vector<SampleLabel> read_label_table() {
  std::ifstream in(sample_path("README.md"));
  std::vector<SampleLabel> table;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("| labels_", 0) != 0) continue;
    for (char& c : line) c = c == '|' ? ' ' : c;
    std::istringstream row(line);
    SampleLabel s;
    if (!(row >> s.file >> s.label >> s.voxels >> s.volume_mm3 >> std::ws) || !std::getline(row, s.what)) {
      throw std::runtime_error("cannot read the row: " + line);
    }
    table.push_back(s);
  }
  if (table.empty()) throw std::runtime_error("no table of labels in sample_volumes/README.md");
  return table;
}

inline const std::vector<Sample>& sample_table() {
  static const std::vector<Sample> table = read_sample_table();
  return table;
}

inline const Sample& sample_named(const std::string& file) {
  for (const Sample& sample : sample_table()) {
    if (sample.file == file) return sample;
  }
  throw std::runtime_error("no sample " + file);
}

}  // namespace scantet
