#include "scantet/report/report_scan.h"

#include <algorithm>
#include <cmath>

#include "scantet/base/options.h"
#include "scantet/base/parallel.h"

namespace scantet {
namespace {

/// Voxels first, first + step … of each axis.
struct Part {
  std::array<int, 3> first{};
  std::array<int, 3> last{};
  int step = 1;

  int count(std::size_t axis) const { return (last[axis] - first[axis]) / step + 1; }
  std::int64_t voxels() const { return std::int64_t{count(0)} * count(1) * count(2); }
};

/// The part of the scan that has the box in it, and two voxels around it.
Part part_around(const Scan& scan, const Box& box) {
  const Box index = scan.frame.index_box(box);
  Part part;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    const int end = scan.size[axis] - 1;
    part.first[axis] = static_cast<int>(std::clamp(std::floor(index.min[a]) - 2, 0.0, double(end - 1)));
    part.last[axis] =
        static_cast<int>(std::clamp(std::ceil(index.max[a]) + 2, double(part.first[axis] + 1), double(end)));
  }
  return part;
}

std::string sizes_text(const std::array<int, 3>& size) {
  return std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]);
}

double value_at(const Scan& scan, std::int64_t at) {
  return std::visit([at](const auto* voxels) { return static_cast<double>(voxels[at]); }, scan.voxels);
}

void add_note(ReportScan& shown, const std::string& note) {
  shown.note += (shown.note.empty() ? "" : ", and ") + note;
}

/// The frame, and each voxel's value as `shade` gives it.
template <class Shade>
ReportScan shown_part(const Scan& scan, const Box& around, std::int64_t most, Part& part, const Shade& shade) {
  part = {{0, 0, 0}, {scan.size[0] - 1, scan.size[1] - 1, scan.size[2] - 1}, 1};
  ReportScan shown;
  if (part.voxels() > most && !around.empty()) {
    part = part_around(scan, around);
    shown.note = "of " + sizes_text(scan.size) + " voxels those around the mesh are shown";
  }
  while (part.voxels() > std::max<std::int64_t>(most, 1)) ++part.step;
  if (part.step > 1) {
    shown.note += (shown.note.empty() ? "" : ", and of these ") + std::string("one in ") + std::to_string(part.step) +
                  " along each axis";
  }
  for (std::size_t axis = 0; axis < 3; ++axis) shown.size[axis] = part.count(axis);
  const double step = part.step;
  shown.frame = Frame({step * scan.frame.column(0), step * scan.frame.column(1), step * scan.frame.column(2)},
                      scan.frame.to_world({double(part.first[0]), double(part.first[1]), double(part.first[2])}));
  shown.values.resize(static_cast<std::size_t>(part.voxels()));
  parallel_for(static_cast<std::size_t>(shown.size[2]), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      std::size_t to = k * static_cast<std::size_t>(shown.size[0]) * static_cast<std::size_t>(shown.size[1]);
      const std::int64_t stride = part.step;
      const std::int64_t layer = part.first[2] + stride * static_cast<std::int64_t>(k);
      for (int j = 0; j < shown.size[1]; ++j) {
        const std::int64_t row = layer * scan.size[1] + part.first[1] + stride * j;
        for (int i = 0; i < shown.size[0]; ++i) {
          shown.values[to++] = shade(value_at(scan, row * scan.size[0] + part.first[0] + stride * i));
        }
      }
    }
  });
  return shown;
}

/// Of a part that has all of its voxels.
std::vector<ReportFieldValue> field_values(const Part& part, const std::vector<Region>& regions,
                                           const FieldValuesAt& field) {
  struct Value {
    std::uint32_t voxel;
    std::uint16_t region;
    double value;
  };
  const auto row = static_cast<std::size_t>(part.count(0));
  const std::size_t layer = row * static_cast<std::size_t>(part.count(1));
  const auto all = parallel_collect<Value>(
      static_cast<std::size_t>(part.voxels()), 4096, [&](std::size_t begin, std::size_t end, auto& out) {
        for (std::size_t n = begin; n < end; ++n) {
          const auto values =
              field(part.first[0] + static_cast<int>(n % row), part.first[1] + static_cast<int>(n % layer / row),
                    part.first[2] + static_cast<int>(n / layer));
          for (const auto& [region, value] : values) {
            const auto at = std::lower_bound(regions.begin(), regions.end(), region);
            if (at == regions.end() || *at != region) continue;  // beyond the image, where no voxel says so
            out.push_back({static_cast<std::uint32_t>(n), static_cast<std::uint16_t>(at - regions.begin()), value});
          }
        }
      });
  if (all.empty()) return {};
  const auto [least, most] =
      std::minmax_element(all.begin(), all.end(), [](const Value& a, const Value& b) { return a.value < b.value; });
  const double scale = most->value > least->value ? 65535 / (most->value - least->value) : 0;
  std::vector<ReportFieldValue> out;
  out.reserve(all.size());
  for (const Value& v : all) {
    out.push_back({v.voxel, v.region, static_cast<std::uint16_t>(std::lround(scale * (v.value - least->value)))});
  }
  return out;
}

}  // namespace

ReportScan report_scan(const Scan& scan, const Box& around, std::vector<double> levels, std::int64_t most) {
  const double scale = scan.max_value > scan.min_value ? 65535 / (scan.max_value - scan.min_value) : 0;
  Part part;
  ReportScan shown = shown_part(scan, around, most, part, [&](double value) {
    return static_cast<std::uint16_t>(std::lround(scale * (value - scan.min_value)));
  });
  shown.low = scan.min_value;
  shown.high = scan.max_value;
  shown.levels = std::move(levels);
  return shown;
}

ReportScan report_labels(const Scan& scan, const std::map<std::int64_t, Region>& region_of, const FieldValuesAt& field,
                         const Box& around, std::size_t most_values, std::int64_t most) {
  std::vector<Region> regions;
  regions.reserve(region_of.size());
  for (const auto& [label, region] : region_of) regions.push_back(region);
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  std::map<std::int64_t, std::uint16_t> place_of;
  for (const auto& [label, region] : region_of) {
    place_of[label] =
        static_cast<std::uint16_t>(std::lower_bound(regions.begin(), regions.end(), region) - regions.begin());
  }
  Part part;
  ReportScan shown =
      shown_part(scan, around, most, part, [&](double value) { return place_of.at(static_cast<std::int64_t>(value)); });
  shown.regions = std::move(regions);
  if (!field) return shown;
  if (part.step == 1) shown.field = field_values(part, shown.regions, field);
  if (part.step > 1 || shown.field.size() > most_values) {
    shown.field = {};
    add_note(shown, "the smooth fields' outline is not shown, but that of fields of 0 and 1");
  }
  return shown;
}

}  // namespace scantet
