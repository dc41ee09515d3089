// How a .vtu file stores arrays: as text, base64 or raw bytes, whole or in compressed blocks. Private to io/.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace scantet {

/// Decodes the binary arrays of one file. Every function throws Error (input.bad_mesh) if the data are cut short or
/// inconsistent, and allocates no more than a fixed multiple of the size of the data.
class VtuDecoder {
 public:
  /// The attributes of the VTKFile element. header_type: "UInt32" or "UInt64". compressor: VTK's class name, or empty.
  VtuDecoder(const std::string& path, bool big_endian, const std::string& header_type, const std::string& compressor);
  ~VtuDecoder();
  VtuDecoder(const VtuDecoder&) = delete;
  VtuDecoder& operator=(const VtuDecoder&) = delete;

  /// The bytes of the array whose encoded form begins where `data` does.
  std::string decode(std::string_view data, bool base64) const;

 private:
  struct Compressor;

  std::size_t header_word(std::string_view header, std::size_t index) const;
  std::string decode_plain(std::string_view data, bool base64) const;
  std::string decode_blocks(std::string_view data, bool base64) const;
  std::string unpack(std::string_view block, std::size_t size) const;
  std::string take(std::string_view data, bool base64, std::size_t begin, std::size_t size) const;
  [[noreturn]] void fail(const std::string& what) const;

  const std::string& path_;
  bool big_endian_;
  std::size_t word_;  // bytes of a number in a header
  std::unique_ptr<Compressor> compressor_;
};

}  // namespace scantet
