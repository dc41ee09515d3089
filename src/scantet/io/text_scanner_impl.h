// Reads text files of numbers: a file in memory, a position, and errors that name file and line. Private to io/.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "scantet/base/geometry.h"

namespace scantet {

/// The whole file. Throws Error (input.cannot_open, input.bad_mesh if it is empty).
std::string read_whole_file(const std::string& path);

/// Throws Error (input.bad_mesh) about a mesh file: "cannot read '<path>': <what>".
[[noreturn]] void throw_bad_mesh(const std::string& path, const std::string& what);

/// A word of a file for a message: in quotes, cut to 40 characters, nothing unprintable. "the end of the file" if
/// empty.
std::string in_quotes(std::string_view text);

/// "point array 'heat'", for what a file has under a name, if it has one.
std::string named_text(const std::string& kind, std::string_view name);

/// Whether the whole text is a number of the type, a plus sign in front allowed; `value` is set if so.
bool parse_number(std::string_view text, std::int64_t& value);
bool parse_number(std::string_view text, double& value);

/// Tokens are separated by white space. Every read throws Error (input.bad_mesh), with the line, where the text ends
/// too early or is not what was asked for.
class TextScanner {
 public:
  /// `text` must outlive the scanner. comment: a character that starts a comment up to the end of the line, or 0.
  TextScanner(const std::string& path, std::string_view text, char comment = 0)
      : path_(path), text_(text), comment_(comment) {}

  /// The next token, empty at the end of the file.
  std::string_view token();
  /// The next token without taking it.
  std::string_view peek();
  /// The rest of the current line, without its end; the position moves to the next line.
  std::string_view rest_of_line();
  /// The next `size` bytes as they are.
  std::string_view bytes(std::size_t size);
  /// Leaves out whole lines, beginning with the rest of the current one.
  void skip_lines(std::uint64_t lines);
  std::int64_t integer();
  std::int32_t int32();
  double real();
  /// Three finite numbers.
  Point point();
  /// Reads a number of items, each of which takes at least `least_bytes` of text. It is an error if the rest of the
  /// file cannot hold so many, so that nothing is allocated for counts that lie. least_bytes 0: only negative numbers
  /// are refused.
  std::uint64_t count(std::size_t least_bytes);
  /// The same check for a number that is known already.
  void require_room(std::uint64_t items, std::size_t least_bytes) const;
  bool at_end() const { return position_ >= text_.size(); }
  /// True if the text ends with the end of a line.
  bool ends_with_newline() const { return !text_.empty() && text_.back() == '\n'; }
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void skip_space();
  std::size_t line() const;

  const std::string& path_;
  std::string_view text_;
  std::size_t position_ = 0;
  char comment_;
};

}  // namespace scantet
