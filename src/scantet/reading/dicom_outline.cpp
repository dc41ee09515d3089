// An element is a tag, in explicit syntaxes a two-letter value representation, a length and that many bytes. Sequences
// and compressed pixel data may have an undefined length; they consist of items and end with a delimiter.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "scantet/reading/dicom_outline_impl.h"
#include "scantet/reading/image_source_impl.h"

namespace scantet {
namespace {

constexpr std::uint32_t tag(std::uint32_t group, std::uint32_t element) {
  return group << 16 | element;
}

constexpr std::uint32_t kTransferSyntax = tag(0x0002, 0x0010);
constexpr std::uint32_t kSopClass = tag(0x0008, 0x0016);
constexpr std::uint32_t kThickness = tag(0x0018, 0x0050);
constexpr std::uint32_t kSliceStep = tag(0x0018, 0x0088);
constexpr std::uint32_t kImagePosition = tag(0x0020, 0x0032);
constexpr std::uint32_t kImageOrientation = tag(0x0020, 0x0037);
constexpr std::uint32_t kPlanePosition = tag(0x0020, 0x9113);
constexpr std::uint32_t kPlaneOrientation = tag(0x0020, 0x9116);
constexpr std::uint32_t kSamples = tag(0x0028, 0x0002);
constexpr std::uint32_t kFrames = tag(0x0028, 0x0008);
constexpr std::uint32_t kRows = tag(0x0028, 0x0010);
constexpr std::uint32_t kColumns = tag(0x0028, 0x0011);
constexpr std::uint32_t kPixelSpacing = tag(0x0028, 0x0030);
constexpr std::uint32_t kBitsAllocated = tag(0x0028, 0x0100);
constexpr std::uint32_t kPixelMeasures = tag(0x0028, 0x9110);
constexpr std::uint32_t kSegmentationType = tag(0x0062, 0x0001);
constexpr std::uint32_t kSegments = tag(0x0062, 0x0002);
constexpr std::uint32_t kSegmentNumber = tag(0x0062, 0x0004);
constexpr std::uint32_t kSegmentLabel = tag(0x0062, 0x0005);
constexpr std::uint32_t kFrameSegments = tag(0x0062, 0x000a);
constexpr std::uint32_t kFrameSegment = tag(0x0062, 0x000b);
constexpr std::uint32_t kDisplayCielab = tag(0x0062, 0x000d);
constexpr std::uint32_t kMostFractional = tag(0x0062, 0x000e);
constexpr std::uint32_t kSharedGroups = tag(0x5200, 0x9229);
constexpr std::uint32_t kPerFrameGroups = tag(0x5200, 0x9230);
constexpr std::uint32_t kPixelData = tag(0x7fe0, 0x0010);
constexpr std::uint32_t kItem = tag(0xfffe, 0xe000);
constexpr std::uint32_t kItemEnd = tag(0xfffe, 0xe00d);
constexpr std::uint32_t kSequenceEnd = tag(0xfffe, 0xe0dd);
constexpr std::uint32_t kUndefined = 0xffffffff;
constexpr int kDeepest = 32;

constexpr const char* kLongRepresentations = "OB OD OF OL OV OW SQ SV UC UN UR UT UV";
constexpr const char* kShortRepresentations = "AE AS AT CS DA DS DT FD FL IS LO LT PN SH SL SS ST TM UI UL US";

bool is_one_of(const std::string& word, const std::string& words) {
  const std::size_t position = words.find(word);
  return position != std::string::npos && position % 3 == 0;
}

/// Sequences that matter: in implicit syntaxes nothing else tells that they are some.
constexpr std::uint32_t kSequences[] = {kPlanePosition, kPlaneOrientation, kPixelMeasures, kSegments,
                                        kFrameSegments, kSharedGroups,     kPerFrameGroups};

struct Broken {
  std::string why;
};

struct Element {
  std::uint32_t tag = 0;
  std::string representation;  // "" in implicit syntaxes
  std::uint32_t length = 0;
};

class Walk {
 public:
  explicit Walk(const std::string& path)
      : file_(path, std::ios::binary), end_(static_cast<std::int64_t>(std::filesystem::file_size(path))) {}

  void run(DicomOutline& outline) {
    outline_ = &outline;
    constexpr std::int64_t kAfterMagic = 132;
    move_to(kAfterMagic);
    while (position_ + 8 <= end_ && peek_group() == 0x0002) meta_element();
    if (syntax_ == "1.2.840.10008.1.2.1.99") {  // deflated
      outline.has_pixels = true;
      return;
    }
    explicit_ = syntax_ != "1.2.840.10008.1.2";
    big_endian_ = syntax_ == "1.2.840.10008.1.2.2";
    elements(end_, 0, false);
    check_pixels();
    finish_segmentation();
  }

 private:
  void move_to(std::int64_t position) {
    if (position > end_) throw Broken{"it ends within an element"};
    constexpr std::int64_t kNear = 4096;  // seeking throws away what the stream has read ahead
    const std::int64_t step = position - position_;
    position_ = position;
    if (step > 0 && step <= kNear) {
      file_.ignore(step);
    } else if (step != 0) {
      file_.seekg(position);
    }
  }

  std::string bytes(std::int64_t count) {
    if (position_ + count > end_) throw Broken{"it ends within an element"};
    std::string raw(static_cast<std::size_t>(count), '\0');
    if (!file_.read(raw.data(), count)) throw Broken{"it cannot be read to the end"};
    position_ += count;
    return raw;
  }

  std::uint32_t number(int count) {
    std::string raw = bytes(count);
    if (!big_endian_) std::reverse(raw.begin(), raw.end());
    std::uint32_t value = 0;
    for (const char c : raw) value = value << 8 | static_cast<unsigned char>(c);
    return value;
  }

  std::uint32_t peek_group() {
    const std::uint32_t group = number(2);
    move_to(position_ - 2);
    return group;
  }

  Element next() {
    Element element;
    const std::uint32_t group = number(2);
    element.tag = tag(group, number(2));
    if (!explicit_ || group == 0xfffe) {
      element.length = number(4);
      return element;
    }
    element.representation = bytes(2);
    if (is_one_of(element.representation, kLongRepresentations)) {
      bytes(2);
      element.length = number(4);
    } else if (is_one_of(element.representation, kShortRepresentations)) {
      element.length = number(2);
    } else {
      throw Broken{"it holds an element of unknown type"};
    }
    return element;
  }

  void meta_element() {
    const Element element = next();
    const std::int64_t after = position_ + element.length;
    if (element.tag == kTransferSyntax) {
      syntax_ = bytes(std::min<std::int64_t>(element.length, 64));
      syntax_.erase(std::min(syntax_.find_first_of(std::string("\0 ", 2)), syntax_.size()));
    }
    move_to(after);
  }

  // The elements up to `end`, or up to the delimiter of an item of undefined length.
  void elements(std::int64_t end, int depth, bool until_delimiter) {
    if (depth > kDeepest) throw Broken{"its sequences are nested too deep"};
    while (position_ < end) {
      const Element element = next();
      if (element.tag == kItemEnd && until_delimiter) return;
      const std::uint32_t outer = top_;
      if (depth == 0) top_ = element.tag;
      value(element, depth);
      top_ = outer;
    }
    if (until_delimiter) throw Broken{"it ends within a sequence"};
    if (position_ != end) throw Broken{"an element is longer than the item it is in"};
  }

  void value(const Element& element, int depth) {
    if (depth == 0 && element.tag == kPixelData) {
      outline_->has_pixels = true;
      pixels_at_ = position_;
      if (element.length != kUndefined) pixel_bytes_ = element.length;
    }
    const bool known_sequence =
        std::find(std::begin(kSequences), std::end(kSequences), element.tag) != std::end(kSequences);
    if (element.length == kUndefined || element.representation == "SQ" || (!explicit_ && known_sequence)) {
      // Unknown elements of undefined length hold implicit items.
      const bool outer = explicit_;
      if (element.representation == "UN") explicit_ = false;
      items(element, depth);
      explicit_ = outer;
      return;
    }
    const std::int64_t after = position_ + element.length;
    if (after > end_) throw Broken{"it ends within an element"};
    const bool decimal =
        element.tag == kImagePosition || element.tag == kImageOrientation || element.tag == kPixelSpacing;
    if (decimal && explicit_ && element.representation != "DS") throw Broken{"its position or spacing is no number"};
    keep(element, depth);
    move_to(after);
  }

  void items(const Element& sequence, int depth) {
    const bool delimited = sequence.length == kUndefined;
    const std::int64_t end = delimited ? end_ : position_ + sequence.length;
    if (end > end_) throw Broken{"it ends within a sequence"};
    while (position_ < end) {
      const Element item = next();
      if (item.tag == kSequenceEnd && delimited) return;
      if (item.tag != kItem) throw Broken{"a sequence holds something other than items"};
      if (sequence.tag == kPixelData && depth == 0) {
        move_to(position_ + item.length);  // a compressed fragment
      } else if (item.length == kUndefined) {
        elements(end, depth + 1, true);
      } else {
        const std::int64_t item_end = position_ + item.length;
        if (item_end > end) throw Broken{"an item is longer than its sequence"};
        elements(item_end, depth + 1, false);
      }
    }
    if (delimited) throw Broken{"it ends within a sequence"};
  }

  std::string text_of(const Element& element) {
    std::string text = bytes(element.length);
    text.erase(text.find_last_not_of(std::string("\0 ", 2)) + 1);
    return text;
  }

  /// "1\-0.5\0".
  std::vector<double> numbers_of(const Element& element) {
    std::string text = text_of(element);
    std::replace(text.begin(), text.end(), '\\', ' ');
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    std::vector<double> numbers;
    for (double value = 0; stream >> value;) numbers.push_back(value);
    return numbers;
  }

  /// What a segmentation says of its segments and frames. True if the element was taken.
  bool keep_of_segmentation(const Element& element, int depth) {
    SegmentationOutline& found = segmentation_;
    const bool of_frames = top_ == kSharedGroups || top_ == kPerFrameGroups;
    const bool short_number = element.length == 2;
    if (depth == 0 && element.tag == kSopClass) {
      const std::string kind = text_of(element);
      is_segmentation_ = kind == "1.2.840.10008.5.1.4.1.1.66.4" || kind == "1.2.840.10008.5.1.4.1.1.66.7";
    } else if (depth == 0 && element.tag == kSegmentationType) {
      found.kind = text_of(element);
    } else if (depth == 0 && element.tag == kMostFractional && short_number) {
      found.most = static_cast<int>(number(2));
    } else if (top_ == kSegments && depth == 1 && element.tag == kSegmentNumber && short_number) {
      found.segments.push_back({static_cast<int>(number(2)), {}, {}});
    } else if (top_ == kSegments && depth == 1 && element.tag == kSegmentLabel && !found.segments.empty()) {
      found.segments.back().label = text_of(element);
    } else if (top_ == kSegments && depth == 1 && element.tag == kDisplayCielab && element.length == 6 &&
               !found.segments.empty()) {
      for (int n = 0; n < 3; ++n) {
        found.segments.back().cielab.push_back(static_cast<std::uint16_t>(number(2)));
      }
    } else if (top_ == kPerFrameGroups && element.tag == kFrameSegment && short_number) {
      found.frame_segments.push_back(static_cast<int>(number(2)));
    } else if (of_frames && element.tag == kImageOrientation && found.orientation.empty()) {
      found.orientation = numbers_of(element);
    } else if (of_frames && element.tag == kPixelSpacing && found.pixel_spacing_mm.empty()) {
      found.pixel_spacing_mm = numbers_of(element);
    } else if (of_frames && (element.tag == kSliceStep || element.tag == kThickness)) {
      const std::vector<double> length = numbers_of(element);
      std::optional<double>& place = element.tag == kSliceStep ? found.slice_step_mm : found.thickness_mm;
      if (!place && length.size() == 1) place = length.front();
    } else {
      return false;
    }
    return true;
  }

  void finish_segmentation() {
    if (!is_segmentation_) return;
    segmentation_.rows = rows_;
    segmentation_.columns = columns_;
    segmentation_.frames = frames_;
    segmentation_.bits = bits_;
    segmentation_.pixels_at = pixels_at_;
    const bool is_native = syntax_ == "1.2.840.10008.1.2" || syntax_ == "1.2.840.10008.1.2.1";
    if (pixel_bytes_ && is_native) segmentation_.pixel_bytes = *pixel_bytes_;
    outline_->segmentation = std::move(segmentation_);
  }

  void keep(const Element& element, int depth) {
    constexpr std::uint32_t kLongestText = 256;
    const bool frame_position = element.tag == kImagePosition && top_ == kPerFrameGroups;
    if (element.length > kLongestText || keep_of_segmentation(element, depth)) return;
    if (!frame_position && depth > 0) return;
    if (frame_position) {
      std::string text = bytes(element.length);
      std::replace(text.begin(), text.end(), '\\', ' ');
      std::istringstream numbers(text);
      numbers.imbue(std::locale::classic());
      Point p;
      if (!(numbers >> p.x >> p.y >> p.z)) throw Broken{"a frame has no position"};
      outline_->frame_positions.push_back(p);
    } else if (element.tag == kFrames) {
      std::istringstream(bytes(element.length)) >> frames_;
    } else if (element.length == 2) {
      const auto keep_as = [&](std::uint32_t name, std::int64_t& place) {
        if (element.tag == name) place = number(2);
      };
      keep_as(kSamples, samples_);
      keep_as(kRows, rows_);
      keep_as(kColumns, columns_);
      keep_as(kBitsAllocated, bits_);
    }
  }

  void check_pixels() const {
    if (!outline_->has_pixels) return;
    const bool known_layout = (samples_ == 1 || samples_ == 3 || samples_ == 4) && rows_ > 0 && columns_ > 0 &&
                              frames_ > 0 && bits_ > 0 && bits_ <= 64;
    if (!known_layout) throw Broken{"it states an impossible size or number of samples"};
    if (!pixel_bytes_) return;
    const double bits = double(rows_) * double(columns_) * double(samples_) * double(bits_) * double(frames_);
    if (static_cast<double>(*pixel_bytes_) * 8 >= bits) return;
    throw Broken{"it has " + std::to_string(*pixel_bytes_) + " bytes of pixels for " + std::to_string(columns_) +
                 " x " + std::to_string(rows_) + " pixels of " + std::to_string(bits_) + " bits, " +
                 std::to_string(frames_) + " frames"};
  }

  std::ifstream file_;
  std::int64_t end_;
  std::int64_t position_ = 0;
  std::string syntax_;
  bool explicit_ = true;
  bool big_endian_ = false;
  std::uint32_t top_ = 0;
  DicomOutline* outline_ = nullptr;
  std::optional<std::uint32_t> pixel_bytes_;
  std::int64_t pixels_at_ = 0;
  bool is_segmentation_ = false;
  SegmentationOutline segmentation_;
  std::int64_t rows_ = 0;
  std::int64_t columns_ = 0;
  std::int64_t samples_ = 1;
  std::int64_t bits_ = 0;
  std::int64_t frames_ = 1;
};

}  // namespace

DicomOutline outline_of(const std::string& path) {
  DicomOutline outline;
  try {
    Walk(path).run(outline);
  } catch (const Broken& broken) {
    outline.problem = broken.why;
  }
  return outline;
}

bool is_dicom_file(const std::string& path) {
  constexpr std::size_t kPreamble = 128;
  const std::string start = first_bytes(path, kPreamble + 4);
  return start.size() == kPreamble + 4 && start.compare(kPreamble, 4, "DICM") == 0;
}

}  // namespace scantet
