// As pigz does it: each piece is deflated by itself and ends at a byte (Z_SYNC_FLUSH), so that the pieces can be put
// one behind the other, with zlib's header before them and the checksum of all, which follows from those of the pieces,
// behind.
#include "scantet/io/parallel_zlib_impl.h"

#define ZLIB_CONST  // zlib does not write to what it reads
#include <zlib.h>

#include <algorithm>
#include <new>

#include "scantet/base/parallel.h"

namespace scantet {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 18;

struct Piece {
  std::vector<unsigned char> stream;
  uLong checksum = 0;
};

Piece deflated(const unsigned char* bytes, std::size_t size, bool is_last) {
  constexpr int kRaw = -15;  // no header, the largest window
  constexpr int kMemory = 8;
  z_stream z{};
  if (deflateInit2(&z, Z_BEST_SPEED, Z_DEFLATED, kRaw, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
  constexpr std::size_t kFlush = 16;  // more than the bound, for the end of a piece
  Piece piece;
  piece.stream.resize(deflateBound(&z, static_cast<uLong>(size)) + kFlush);
  z.next_in = bytes;
  z.avail_in = static_cast<uInt>(size);
  z.next_out = piece.stream.data();
  z.avail_out = static_cast<uInt>(piece.stream.size());
  deflate(&z, is_last ? Z_FINISH : Z_SYNC_FLUSH);
  piece.stream.resize(z.total_out);
  deflateEnd(&z);
  piece.checksum = adler32(adler32(0, nullptr, 0), bytes, static_cast<uInt>(size));
  return piece;
}

}  // namespace

std::size_t most_compressed(std::size_t size) {
  constexpr std::size_t kOfPiece = 32;  // the end of a stream, and what a piece that cannot be compressed is wrapped in
  return size + size / 1024 + kOfPiece * (size / kPiece + 2);
}

std::vector<unsigned char> compress_in_pieces(const unsigned char* bytes, std::size_t size) {
  std::vector<Piece> pieces(std::max<std::size_t>((size + kPiece - 1) / kPiece, 1));
  parallel_for(pieces.size(), 1, [&](std::size_t i, std::size_t) {
    const std::size_t begin = i * kPiece;
    pieces[i] = deflated(bytes + begin, std::min(kPiece, size - begin), i + 1 == pieces.size());
  });
  std::vector<unsigned char> all{0x78, 0x01};  // deflate with a window of 32 KiB, made at the fastest level
  uLong checksum = adler32(0, nullptr, 0);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    all.insert(all.end(), pieces[i].stream.begin(), pieces[i].stream.end());
    const std::size_t length = std::min(kPiece, size - i * kPiece);
    checksum = adler32_combine(checksum, pieces[i].checksum, static_cast<z_off_t>(length));
  }
  for (int shift = 24; shift >= 0; shift -= 8) all.push_back(static_cast<unsigned char>(checksum >> shift & 0xFF));
  return all;
}

}  // namespace scantet
