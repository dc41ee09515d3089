// Durations and amounts of memory, as people type and read them.
#pragma once

#include <string>

namespace scantet {

/// "90", "90s", "10m" or "1.5h" in seconds. place: opens the messages. Throws Error: usage.value.
double read_duration(const std::string& place, const std::string& text);

/// "500M", "8G" or a number of bytes; K, M, G and T are powers of 1024. Throws Error: usage.value.
double read_bytes(const std::string& place, const std::string& text);

/// A length, or a share of another one. One of them is 0.
struct LengthOrShare {
  double mm = 0;
  double share = 0;
};

/// "0.2" or "0.2mm" is a length, "5%" a share, "0" neither. Throws Error: usage.value.
LengthOrShare read_length_or_share(const std::string& place, const std::string& text);

/// "7.5G", for people.
std::string bytes_text(double bytes);

}  // namespace scantet
