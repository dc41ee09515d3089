// Numbers as people read them.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>

namespace scantet {

/// 1243680 -> "1,243,680"
std::string grouped(std::uint64_t value);

/// "1 tet", "1,243,680 tets"
std::string counted(std::uint64_t count, const char* one, const char* many);

std::string printed(double value, std::chars_format format, int precision);

/// Four digits, or all before the decimal point; "none" for NaN, "infinite".
std::string number(double value);

/// "99.98 %"; "0.00 %" of nothing.
std::string percent_text(std::uint64_t part, std::uint64_t whole);

}  // namespace scantet
