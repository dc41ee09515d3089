// A segmentation object is a stack of frames, each a slice of one segment; those that are empty are mostly left out. So
// each frame's place in the stack follows from its position. Bits of BINARY frames follow each other without a gap,
// also from frame to frame. Source: DICOM PS3.3, A.51 and C.8.20; PS3.5, 8.1.1.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "scantet/reading/dicom_outline_impl.h"
#include "scantet/reading/image_source_impl.h"

namespace scantet {
namespace {

constexpr double kEven = 0.1;  // of a step, as for a series
constexpr double kMostSlices = 65'536;

/// sRGB of a colour in CIELab with the white point D50, as 16-bit numbers (PS3.3, C.10.7.1.1).
Color color_of_cielab(const std::vector<std::uint16_t>& lab) {
  constexpr double kMost = 65535;
  const double lightness = lab[0] / kMost * 100;
  const double a = lab[1] / kMost * 255 - 128;
  const double b = lab[2] / kMost * 255 - 128;
  const auto inverse = [](double t) {
    constexpr double kLinear = 6.0 / 29;
    return t > kLinear ? t * t * t : 3 * kLinear * kLinear * (t - 4.0 / 29);
  };
  const double middle = (lightness + 16) / 116;
  const double x = 0.96422 * inverse(middle + a / 500);
  const double y = inverse(middle);
  const double z = 0.82521 * inverse(middle - b / 200);
  const auto part = [](double linear) {
    const double share = std::clamp(linear, 0.0, 1.0);
    const double bent = share <= 0.0031308 ? 12.92 * share : 1.055 * std::pow(share, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * bent));
  };
  return {part(3.1338561 * x - 1.6168667 * y - 0.4906146 * z), part(-0.9787684 * x + 1.9161415 * y + 0.0334540 * z),
          part(0.0719453 * x - 0.2289914 * y + 1.4052427 * z)};
}

class DicomSegmentation final : public ImageSource {
 public:
  explicit DicomSegmentation(const std::string& path) : path_(path) {
    const DicomOutline outline = outline_of(path);
    if (!outline.problem.empty()) throw corrupt_file(path, outline.problem);
    positions_ = outline.frame_positions;
    object_ = outline.segmentation.value();
    check();
    set_frame();
    set_segments();
  }

  const ImageHeader& header() const override { return header_; }

  bool read(void* voxels, Progress& progress) override {
    if (progress.cancelled()) return false;
    if (is_fractional()) {
      read_shares(static_cast<float*>(voxels));
    } else if (is_label_map()) {
      read_labels(static_cast<std::uint16_t*>(voxels));
    } else {
      read_segments(static_cast<std::uint16_t*>(voxels));
    }
    return true;
  }
  std::uint64_t overlapping() const override { return overlapping_; }

 private:
  std::size_t volume() const { return area() * static_cast<std::size_t>(header_.size[2]); }
  bool is_fractional() const { return object_.kind == "FRACTIONAL"; }
  bool is_label_map() const { return object_.kind == "LABELMAP"; }
  std::size_t area() const {
    return static_cast<std::size_t>(object_.rows) * static_cast<std::size_t>(object_.columns);
  }
  [[noreturn]] void refuse(const char* code, const std::string& fault, const std::string& remedy) const {
    throw Error(Fault::input, code, "the segmentation '" + path_ + "' " + fault, remedy);
  }

  void check() const {
    const bool is_binary = object_.kind == "BINARY";
    if (!object_.pixel_bytes) {
      refuse("input.format", "is compressed", "decompress it, for example with 'gdcmconv --raw IN OUT'");
    }
    if (!is_binary && !is_fractional() && !is_label_map()) {
      throw corrupt_file(path_, "its Segmentation Type is '" + object_.kind + "'");
    }
    const bool fits = is_binary         ? object_.bits == 1
                      : is_fractional() ? object_.bits == 8 && object_.most >= 1
                                        : object_.bits == 8 || object_.bits == 16;
    if (!fits) throw corrupt_file(path_, "it is " + object_.kind + ", of " + std::to_string(object_.bits) + " bits");
    const auto frames = static_cast<std::size_t>(object_.frames);
    const auto check_count = [&](std::size_t count, const std::string& what) {
      if (count == frames) return;
      throw corrupt_file(path_, "it has " + std::to_string(frames) + " frames and " + std::to_string(count) + what);
    };
    check_count(positions_.size(), " positions of frames");
    if (!is_label_map()) check_count(object_.frame_segments.size(), " segments of frames");
    if (object_.segments.empty()) throw corrupt_file(path_, "it names no segments");
  }

  void set_frame() {
    const std::vector<double>& direction = object_.orientation;
    const std::vector<double>& spacing = object_.pixel_spacing_mm;
    if (direction.size() != 6 || spacing.size() != 2 || !(spacing[0] > 0) || !(spacing[1] > 0)) {
      throw corrupt_file(path_, "it does not say how its frames lie");
    }
    const Vec row{direction[0], direction[1], direction[2]};
    const Vec column{direction[3], direction[4], direction[5]};
    const Vec normal = cross(row, column);
    if (!(std::abs(length(normal) - 1) < kEven))
      throw corrupt_file(path_, "its rows and columns are not at right angles");
    std::vector<double> places;
    for (const Point& p : positions_) places.push_back(dot(p - positions_.front(), normal));
    const double low = *std::min_element(places.begin(), places.end());
    const double step = step_of(places);
    const double slices = std::round((*std::max_element(places.begin(), places.end()) - low) / step) + 1;
    if (!(slices <= kMostSlices)) refuse("input.slices", "has frames too far apart for their step", "export it again");
    const auto first = static_cast<std::size_t>(std::min_element(places.begin(), places.end()) - places.begin());
    header_.origin = positions_[first];
    header_.columns = {spacing[1] * row, spacing[0] * column, step * normal};
    for (std::size_t n = 0; n < places.size(); ++n) {
      const double slice = std::round((places[n] - low) / step);
      const Point expected = header_.origin + slice * header_.columns[2];
      if (!(distance(positions_[n], expected) <= kEven * std::max(step, spacing[0]))) {
        refuse("input.slices", "has frame " + std::to_string(n + 1) + " off the even stack of the others",
               "resample it to an even stack");
      }
      slices_.push_back(static_cast<std::size_t>(slice));
    }
    header_.format = "DICOM";
    header_.size = {object_.columns, object_.rows, static_cast<std::int64_t>(slices)};
  }

  /// Between slices: the least distance that there is, or, of frames in one slice, what the header says.
  double step_of(std::vector<double> places) const {
    std::sort(places.begin(), places.end());
    double least = 0;
    for (std::size_t n = 1; n < places.size(); ++n) {
      const double gap = places[n] - places[n - 1];
      constexpr double kSame = 1e-3;  // mm
      if (gap > kSame && (least == 0 || gap < least)) least = gap;
    }
    const double said = object_.slice_step_mm.value_or(object_.thickness_mm.value_or(0));
    // Where slices are left out, the least distance may be several steps.
    if (object_.slice_step_mm && *object_.slice_step_mm > 0 && least > (1 + kEven) * *object_.slice_step_mm)
      return said;
    if (least > 0) return least;
    return said > 0 ? said : object_.pixel_spacing_mm[0];
  }

  void set_segments() {
    for (const DicomSegment& segment : object_.segments) {
      HeaderSegment named{{segment.number, segment.label, std::nullopt}, 0};
      if (segment.cielab.size() == 3) named.segment.color = color_of_cielab(segment.cielab);
      header_.segments.push_back(named);
      place_of_[segment.number] = header_.segments.size();
    }
    header_.of_labels = "it is a DICOM segmentation of kind " + object_.kind;
    if (is_fractional()) {
      header_.type = VoxelType::float32;
      header_.of_labels.clear();
      if (header_.segments.size() > 1) header_.size.push_back(static_cast<std::int64_t>(header_.segments.size()));
    } else {
      header_.type = VoxelType::uint16;
    }
    header_.type_name = object_.kind;
  }

  /// Which of the segments, from 1 on, has this number.
  std::size_t place_of(int number) const {
    const auto found = place_of_.find(number);
    if (found != place_of_.end()) return found->second;
    refuse("input.labels", "has voxels of segment " + std::to_string(number) + ", which it does not name",
           "export it again");
  }

  std::vector<unsigned char> pixels_of_frames() const {
    std::ifstream file(path_, std::ios::binary);
    std::vector<unsigned char> bytes(static_cast<std::size_t>(*object_.pixel_bytes));
    file.seekg(object_.pixels_at);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file) throw corrupt_file(path_, "its pixels cannot be read");
    return bytes;
  }

  /// Frames with their segments' places, a segment after another: so each covers those before it, and no voxel is
  /// counted twice where two frames of a segment lie in one slice.
  std::vector<std::pair<std::size_t, std::size_t>> frames_by_segment() const {
    std::vector<std::pair<std::size_t, std::size_t>> frames;
    for (std::size_t frame = 0; frame < slices_.size(); ++frame) {
      frames.emplace_back(place_of(object_.frame_segments[frame]), frame);
    }
    std::sort(frames.begin(), frames.end());
    return frames;
  }

  void read_segments(std::uint16_t* labels) {
    const std::vector<unsigned char> bytes = pixels_of_frames();
    std::fill_n(labels, volume(), 0);
    std::vector<bool> is_shared(volume());
    for (const auto& [place, frame] : frames_by_segment()) {
      for (std::size_t n = 0; n < area(); ++n) {
        const std::size_t bit = frame * area() + n;
        if ((bytes[bit / 8] >> bit % 8 & 1) == 0) continue;
        const std::size_t voxel = slices_[frame] * area() + n;
        const std::size_t before = labels[voxel];
        if (before == place) continue;
        ++header_.segments[place - 1].segment.voxels;
        labels[voxel] = static_cast<std::uint16_t>(place);
        if (before == 0) continue;
        ++header_.segments[before - 1].segment.covered;
        if (!is_shared[voxel]) ++overlapping_;
        is_shared[voxel] = true;
      }
    }
    for (std::size_t n = 0; n < volume(); ++n) {
      if (labels[n] > 0) labels[n] = static_cast<std::uint16_t>(object_.segments[labels[n] - 1U].number);
    }
  }

  void read_labels(std::uint16_t* labels) const {
    const std::vector<unsigned char> bytes = pixels_of_frames();
    const std::size_t width = object_.bits == 16 ? 2 : 1;
    std::fill_n(labels, volume(), 0);
    for (std::size_t frame = 0; frame < slices_.size(); ++frame) {
      for (std::size_t n = 0; n < area(); ++n) {
        const std::size_t at = (frame * area() + n) * width;
        const int number = bytes[at] | (width == 2 ? bytes[at + 1] << 8 : 0);
        if (number != 0) place_of(number);
        labels[slices_[frame] * area() + n] = static_cast<std::uint16_t>(number);
      }
    }
  }

  void read_shares(float* shares) const {
    const std::vector<unsigned char> bytes = pixels_of_frames();
    std::fill_n(shares, volume() * header_.segments.size(), 0.0F);
    for (std::size_t frame = 0; frame < slices_.size(); ++frame) {
      float* const slice = shares + (place_of(object_.frame_segments[frame]) - 1) * volume() + slices_[frame] * area();
      for (std::size_t n = 0; n < area(); ++n) {
        slice[n] = static_cast<float>(bytes[frame * area() + n]) / static_cast<float>(object_.most);
      }
    }
  }

  std::string path_;
  std::vector<Point> positions_;  // of frames
  SegmentationOutline object_;
  std::vector<std::size_t> slices_;  // of frames
  std::map<int, std::size_t> place_of_;
  std::uint64_t overlapping_ = 0;
  ImageHeader header_;
};

}  // namespace

bool is_dicom_segmentation(const std::string& path) {
  return is_dicom_file(path) && outline_of(path).segmentation.has_value();
}

std::unique_ptr<ImageSource> open_dicom_segmentation(const std::string& path) {
  return std::make_unique<DicomSegmentation>(path);
}

}  // namespace scantet
