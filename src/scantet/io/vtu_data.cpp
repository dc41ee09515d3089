// An array is a header of 4- or 8-byte numbers, followed by its bytes. If it is plain, the header is the number of
// bytes. If it is compressed, the header has the number of blocks, the size of a block, the size of the last block if
// it is smaller (else 0), and the compressed size of each block. In base64, the header and the blocks are encoded
// apart, but a plain array is encoded in one with its header.
#include <vtkDataCompressor.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <cstdint>

#include "scantet/io/text_scanner_impl.h"
#include "scantet/io/vtu_data_impl.h"

namespace scantet {
namespace {

/// The value of a base64 digit, -1 for any other character.
int digit_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Characters that encode so many bytes.
std::size_t base64_length(std::size_t bytes) {
  return (bytes + 2) / 3 * 4;
}

/// The first `size` bytes of encoded text; fewer if it is too short or not base64.
std::string decode_base64(std::string_view text, std::size_t size) {
  std::string bytes;
  bytes.reserve(std::min(size, text.size()));
  std::uint32_t group = 0;
  int bits = 0;
  for (char c : text) {
    const int value = digit_value(c);
    if (bytes.size() == size || value < 0) break;
    group = group << 6 | static_cast<std::uint32_t>(value);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<char>(group >> bits & 0xFF));
  }
  return bytes;
}

}  // namespace

struct VtuDecoder::Compressor {
  vtkSmartPointer<vtkDataCompressor> vtk;
  std::size_t largest_ratio;  // that the method can reach: data that claim more are damaged
};

VtuDecoder::VtuDecoder(const std::string& path, std::size_t file_bytes, bool big_endian, const std::string& header_type,
                       const std::string& compressor)
    : path_(path),
      big_endian_(big_endian),
      word_(header_type == "UInt64" ? 8 : 4),
      left_((std::size_t{64} << 20) + 100 * file_bytes) {
  if (compressor.empty()) return;
  compressor_ = std::make_unique<Compressor>();
  if (compressor == "vtkZLibDataCompressor") {
    *compressor_ = {vtkSmartPointer<vtkZLibDataCompressor>::New(), 1100};
  } else if (compressor == "vtkLZ4DataCompressor") {
    *compressor_ = {vtkSmartPointer<vtkLZ4DataCompressor>::New(), 300};
  } else if (compressor == "vtkLZMADataCompressor") {
    *compressor_ = {vtkSmartPointer<vtkLZMADataCompressor>::New(), 8000};
  } else {
    fail("it is compressed with the unknown method " + in_quotes(compressor));
  }
}

VtuDecoder::~VtuDecoder() = default;

void VtuDecoder::fail(const std::string& what) const {
  throw_bad_mesh(path_, what);
}

void VtuDecoder::count(std::size_t bytes) {
  if (bytes > left_) fail("its arrays are far larger than the file can hold");
  left_ -= bytes;
}

std::string VtuDecoder::decode(std::string_view data, bool base64) {
  return compressor_ ? decode_blocks(data, base64) : decode_plain(data, base64);
}

std::size_t VtuDecoder::header_word(std::string_view header, std::size_t index) const {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < word_; ++i) {
    const std::size_t at = index * word_ + (big_endian_ ? i : word_ - 1 - i);
    word = word << 8 | static_cast<unsigned char>(header[at]);
  }
  return word;
}

/// `size` bytes of an encoded stream; `begin` counts encoded characters.
std::string VtuDecoder::take(std::string_view data, bool base64, std::size_t begin, std::size_t size) {
  const bool possible = begin <= data.size() && size <= data.size();
  if (possible) count(size);
  std::string bytes = !possible ? std::string()
                      : base64  ? decode_base64(data.substr(begin), size)
                                : std::string(data.substr(begin, size));
  if (!possible || bytes.size() != size) fail("an array is cut short");
  return bytes;
}

std::string VtuDecoder::decode_plain(std::string_view data, bool base64) {
  const std::size_t size = header_word(take(data, base64, 0, word_), 0);
  if (size > data.size()) fail("an array of " + std::to_string(size) + " bytes is cut short");
  return take(data, base64, 0, word_ + size).substr(word_);
}

std::string VtuDecoder::decode_blocks(std::string_view data, bool base64) {
  constexpr std::size_t kFixedWords = 3;
  std::string header = take(data, base64, 0, kFixedWords * word_);
  const std::size_t blocks = header_word(header, 0);
  const std::size_t block_size = header_word(header, 1);
  const std::size_t last_size = header_word(header, 2);
  if (blocks > data.size()) fail("an array of " + std::to_string(blocks) + " blocks is cut short");
  const std::size_t header_bytes = (kFixedWords + blocks) * word_;
  header = take(data, base64, 0, header_bytes);
  std::size_t packed = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::size_t size = header_word(header, kFixedWords + i);
    if (size > data.size() - packed) fail("a compressed block is cut short");
    packed += size;
  }
  const std::string content = take(data, base64, base64 ? base64_length(header_bytes) : header_bytes, packed);
  std::string bytes;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::size_t size = header_word(header, kFixedWords + i);
    const bool partial = i + 1 == blocks && last_size != 0;
    bytes += unpack(std::string_view(content).substr(begin, size), partial ? last_size : block_size);
    begin += size;
  }
  return bytes;
}

std::string VtuDecoder::unpack(std::string_view block, std::size_t size) {
  constexpr std::size_t kSmall = 4096;  // tiny blocks may shrink by more than the limit of the method
  if (size > compressor_->largest_ratio * block.size() + kSmall) fail("a compressed block claims an impossible size");
  count(size);
  std::string bytes(size, '\0');
  const auto* const packed = reinterpret_cast<const unsigned char*>(block.data());
  auto* const unpacked = reinterpret_cast<unsigned char*>(bytes.data());
  if (compressor_->vtk->Uncompress(packed, block.size(), unpacked, size) != size) fail("a compressed block is damaged");
  return bytes;
}

}  // namespace scantet
