// The line number is only counted when an error is reported. Numbers go through std::from_chars: exact, and the same in
// every locale.
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "scantet/base/error.h"
#include "scantet/io/text_scanner_impl.h"

namespace scantet {

std::string read_whole_file(const std::string& path) {
  std::error_code failure;
  const auto status = std::filesystem::status(path, failure);
  if (!std::filesystem::is_regular_file(status)) {
    const std::string reason = std::filesystem::is_directory(status) ? "it is a folder"
                               : failure                             ? failure.message()
                                                                     : "no such file";
    throw Error(Fault::input, "input.cannot_open", "cannot open '" + path + "': " + reason, "check the path");
  }
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    const std::string reason = std::generic_category().message(errno);
    throw Error(Fault::input, "input.cannot_open", "cannot open '" + path + "': " + reason, "check its permissions");
  }
  std::string text(std::filesystem::file_size(path), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.empty()) throw_bad_mesh(path, "the file is empty");
  return text;
}

void throw_bad_mesh(const std::string& path, const std::string& what) {
  throw Error(Fault::input, "input.bad_mesh", "cannot read '" + path + "': " + what,
              "the file is damaged or of another format: write it again, or rename it to its true extension");
}

std::string in_quotes(std::string_view text) {
  if (text.empty()) return "the end of the file";
  constexpr std::size_t kMost = 40;
  std::string result("'");
  for (char c : text.substr(0, kMost)) result.push_back(c < ' ' || c > '~' ? '?' : c);
  result.push_back('\'');
  return result;
}

std::string named_text(const std::string& kind, std::string_view name) {
  return kind + (name.empty() ? " without a name" : " " + in_quotes(name));
}

void TextScanner::fail(const std::string& what) const {
  throw_bad_mesh(path_, "line " + std::to_string(line()) + ": " + what);
}

std::size_t TextScanner::line() const {
  return 1 + static_cast<std::size_t>(
                 std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(position_), '\n'));
}

void TextScanner::skip_space() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (c == comment_ && comment_ != 0) {
      position_ = std::min(text_.find('\n', position_), text_.size());
    } else if (c == ' ' || (c >= '\t' && c <= '\r')) {
      ++position_;
    } else {
      return;
    }
  }
}

std::string_view TextScanner::peek() {
  skip_space();
  std::size_t end = position_;
  while (end < text_.size() && text_[end] != ' ' && !(text_[end] >= '\t' && text_[end] <= '\r')) ++end;
  return text_.substr(position_, end - position_);
}

std::string_view TextScanner::token() {
  const std::string_view found = peek();
  position_ += found.size();
  return found;
}

std::string_view TextScanner::rest_of_line() {
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  std::string_view line = text_.substr(position_, end - position_);
  position_ = std::min(end + 1, text_.size());
  while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

namespace {

template <typename Number>
bool parse(std::string_view text, Number& value) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  return failure == std::errc() && end == text.data() + text.size();
}

}  // namespace

bool parse_number(std::string_view text, std::int64_t& value) {
  return parse(text, value);
}

bool parse_number(std::string_view text, double& value) {
  return parse(text, value);
}

std::string_view TextScanner::bytes(std::size_t size) {
  if (size > text_.size() - position_)
    fail(std::to_string(size) + " bytes of data are expected, the file ends earlier");
  const std::string_view found = text_.substr(position_, size);
  position_ += size;
  return found;
}

void TextScanner::skip_lines(std::uint64_t lines) {
  for (std::uint64_t i = 0; i < lines; ++i) {
    if (position_ >= text_.size()) fail("the file ends too early");
    rest_of_line();
  }
}

std::int64_t TextScanner::integer() {
  std::int64_t value = 0;
  const std::string_view text = peek();
  if (!parse(text, value)) fail("a whole number is expected, not " + in_quotes(text));
  position_ += text.size();
  return value;
}

std::int32_t TextScanner::int32() {
  const std::int64_t value = integer();
  if (value < INT32_MIN || value > INT32_MAX) fail(std::to_string(value) + " is out of the range of a tag");
  return static_cast<std::int32_t>(value);
}

double TextScanner::real() {
  double value = 0;
  const std::string_view text = peek();
  if (!parse(text, value)) fail("a number is expected, not " + in_quotes(text));
  position_ += text.size();
  return value;
}

Point TextScanner::point() {
  const double x = real();
  const double y = real();
  const double z = real();
  const Point p{x, y, z};
  if (!is_finite(p)) fail("a coordinate is not finite");
  return p;
}

std::uint64_t TextScanner::count(std::size_t least_bytes) {
  const std::int64_t value = integer();
  if (value < 0) fail("a count of " + std::to_string(value) + " is impossible");
  require_room(static_cast<std::uint64_t>(value), least_bytes);
  return static_cast<std::uint64_t>(value);
}

void TextScanner::require_room(std::uint64_t items, std::size_t least_bytes) const {
  const std::size_t rest = text_.size() - position_ + 1;  // the last item may lack its line end
  if (least_bytes == 0 || items <= rest / least_bytes) return;
  fail("a count of " + std::to_string(items) + " is impossible: only " + std::to_string(rest - 1) +
       " bytes of the file are left");
}

}  // namespace scantet
