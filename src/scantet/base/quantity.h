// Durations and amounts of memory, as people type and read them.
#pragma once

#include <string>

namespace scantet {

/// "90", "90s", "10m" or "1.5h" in seconds. place: opens the messages. Throws Error: usage.value.
double read_duration(const std::string& place, const std::string& text);

/// "500M", "8G" or a number of bytes; K, M, G and T are powers of 1024. Throws Error: usage.value.
double read_bytes(const std::string& place, const std::string& text);

/// "7.5G", for people.
std::string bytes_text(double bytes);

}  // namespace scantet
