// How a .vtu file stores arrays: as text, base64 or raw bytes, whole or in compressed blocks. Private to io/.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace scantet {

/// Decodes the binary arrays of one file. Every function throws Error (input.bad_mesh) if the data are cut short or
/// inconsistent, or if all that is decoded takes more than 64 MiB and a hundred times the size of the file.
class VtuDecoder {
 public:
  /// The attributes of the VTKFile element. header_type: "UInt32" or "UInt64". compressor: VTK's class name, or empty.
  VtuDecoder(const std::string& path, std::size_t file_bytes, bool big_endian, const std::string& header_type,
             const std::string& compressor);
  ~VtuDecoder();
  VtuDecoder(const VtuDecoder&) = delete;
  VtuDecoder& operator=(const VtuDecoder&) = delete;

  /// The bytes of the array whose encoded form begins where `data` does.
  std::string decode(std::string_view data, bool base64);
  /// Counts bytes that are about to be made of the file's data.
  void count(std::size_t bytes);

 private:
  struct Compressor;

  std::size_t header_word(std::string_view header, std::size_t index) const;
  std::string decode_plain(std::string_view data, bool base64);
  std::string decode_blocks(std::string_view data, bool base64);
  std::string unpack(std::string_view block, std::size_t size);
  std::string take(std::string_view data, bool base64, std::size_t begin, std::size_t size);
  [[noreturn]] void fail(const std::string& what) const;

  const std::string& path_;
  bool big_endian_;
  std::size_t word_;  // bytes of a number in a header
  std::size_t left_;  // bytes that may still be made of the data
  std::unique_ptr<Compressor> compressor_;
};

}  // namespace scantet
