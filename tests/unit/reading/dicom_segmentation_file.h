// DICOM segmentation objects for tests, written byte by byte.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "scantet/base/geometry.h"

namespace scantet::test {

/// One slice of one segment; pixels of a LABELMAP are segments themselves.
struct SegmentFrame {
  int segment = 1;
  Point position;
  std::vector<std::uint8_t> pixels;  ///< 0 or 1, or shares of 255, or labels
};

struct SegmentationFile {
  std::string kind = "BINARY";
  int rows = 3;
  int columns = 5;
  std::string orientation = "1\\0\\0\\0\\1\\0";
  std::string spacing = "0.5\\0.75";  // between rows, between columns
  std::vector<std::string> names{"left", "right"};
  std::vector<SegmentFrame> frames;
  std::string syntax = "1.2.840.10008.1.2.1";  // explicit, little-endian
  bool implicit = false;

  /// The file's bytes.
  std::string bytes() const {
    const std::string meta = element(0x0002, 0x0010, "UI", padded(implicit ? "1.2.840.10008.1.2" : syntax, '\0'), true);
    std::string file = std::string(128, '\0') + "DICM" + meta;
    file += element(0x0008, 0x0016, "UI", padded("1.2.840.10008.5.1.4.1.1.66.4", '\0'));
    file += element(0x0028, 0x0002, "US", number(1));
    file += element(0x0028, 0x0008, "IS", padded(std::to_string(frames.size()), ' '));
    file += element(0x0028, 0x0010, "US", number(rows)) + element(0x0028, 0x0011, "US", number(columns));
    file += element(0x0028, 0x0100, "US", number(kind == "BINARY" ? 1 : 8));
    file += element(0x0062, 0x0001, "CS", padded(kind, ' '));
    std::vector<std::string> segments;
    for (std::size_t n = 0; n < names.size(); ++n) {
      segments.push_back(element(0x0062, 0x0004, "US", number(static_cast<int>(n) + 1)) +
                         element(0x0062, 0x0005, "LO", padded(names[n], ' ')) +
                         element(0x0062, 0x000d, "US", number(0xffff) + number(0x8080) + number(0x8080)));
    }
    file += sequence(0x0062, 0x0002, segments);
    file += element(0x0062, 0x000e, "US", number(255));
    file += sequence(
        0x5200, 0x9229,
        {sequence(0x0020, 0x9116, {element(0x0020, 0x0037, "DS", padded(orientation, ' '))}) +
         sequence(0x0028, 0x9110,
                  {element(0x0018, 0x0050, "DS", "2 ") + element(0x0028, 0x0030, "DS", padded(spacing, ' '))})});
    std::vector<std::string> places;
    for (const SegmentFrame& frame : frames) {
      const Point& p = frame.position;
      const std::string position = std::to_string(p.x) + "\\" + std::to_string(p.y) + "\\" + std::to_string(p.z);
      places.push_back(
          sequence(0x0020, 0x9113, {element(0x0020, 0x0032, "DS", padded(position, ' '))}) +
          (kind == "LABELMAP" ? "" : sequence(0x0062, 0x000a, {element(0x0062, 0x000b, "US", number(frame.segment))})));
    }
    return file + sequence(0x5200, 0x9230, places) + element(0x7fe0, 0x0010, "OB", pixels());
  }

 private:
  static std::string number(int value) { return {static_cast<char>(value & 255), static_cast<char>(value >> 8 & 255)}; }
  static std::string long_number(std::size_t value) {
    return number(static_cast<int>(value & 65535)) + number(static_cast<int>(value >> 16 & 65535));
  }
  static std::string padded(std::string text, char with) {
    if (text.size() % 2 == 1) text += with;
    return text;
  }
  std::string element(int group, int tag, const std::string& kind_of_value, const std::string& value,
                      bool is_meta = false) const {
    const std::string head = number(group) + number(tag);
    if (implicit && !is_meta) return head + long_number(value.size()) + value;
    const bool is_long = kind_of_value == "OB" || kind_of_value == "SQ";
    return head + kind_of_value +
           (is_long ? number(0) + long_number(value.size()) : number(static_cast<int>(value.size()))) + value;
  }
  std::string sequence(int group, int tag, const std::vector<std::string>& items) const {
    std::string value;
    for (const std::string& item : items) value += number(0xfffe) + number(0xe000) + long_number(item.size()) + item;
    return element(group, tag, "SQ", value);
  }
  std::string pixels() const {
    std::string bytes;
    std::size_t bit = 0;
    for (const SegmentFrame& frame : frames) {
      for (const std::uint8_t pixel : frame.pixels) {
        if (kind != "BINARY") {
          bytes += static_cast<char>(pixel);
          continue;
        }
        if (bit % 8 == 0) bytes += '\0';
        bytes.back() = static_cast<char>(bytes.back() | pixel << bit % 8);
        ++bit;
      }
    }
    return padded(bytes, '\0');
  }
};

}  // namespace scantet::test
