// Fast text output: numbers by std::to_chars into one large buffer. Private to io/.
#pragma once

#include <charconv>
#include <concepts>
#include <cstring>
#include <memory>
#include <ostream>
#include <string_view>

namespace scantet {

/// Appends numbers and text to a stream. Doubles get the fewest digits that read back to the same value; nothing
/// depends on the locale. Flushes when destroyed. The stream's owner checks it for failure (write_file does).
class TextWriter {
 public:
  explicit TextWriter(std::ostream& out) : out_(out) {}
  ~TextWriter() { flush(); }
  TextWriter(const TextWriter&) = delete;
  TextWriter& operator=(const TextWriter&) = delete;

  TextWriter& operator<<(std::string_view text) {
    if (text.size() > kMargin) {
      flush();
      out_.write(text.data(), static_cast<std::streamsize>(text.size()));
      return *this;
    }
    make_room();
    std::memcpy(buffer_.get() + used_, text.data(), text.size());
    used_ += text.size();
    return *this;
  }
  TextWriter& operator<<(char c) {
    make_room();
    buffer_[used_++] = c;
    return *this;
  }
  template <typename Number>
  requires(std::integral<Number> || std::floating_point<Number>) TextWriter& operator<<(Number value) {
    make_room();
    used_ = static_cast<std::size_t>(std::to_chars(buffer_.get() + used_, buffer_.get() + kSize, value).ptr -
                                     buffer_.get());
    return *this;
  }

 private:
  static constexpr std::size_t kSize = std::size_t{1} << 18;
  static constexpr std::size_t kMargin = 64;  // longer than any number

  void make_room() {
    if (used_ + kMargin > kSize) flush();
  }
  void flush() {
    out_.write(buffer_.get(), static_cast<std::streamsize>(used_));
    used_ = 0;
  }

  std::ostream& out_;
  std::unique_ptr<char[]> buffer_ = std::make_unique<char[]>(kSize);
  std::size_t used_ = 0;
};

}  // namespace scantet
