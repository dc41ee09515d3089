#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <random>

#include "scantet/base/parallel.h"
#include "scantet/io/parallel_zlib_impl.h"

namespace scantet {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes unpacked(const Bytes& stream, std::size_t size) {
  Bytes bytes(size + 1);  // zlib wants some room also for nothing
  uLongf length = bytes.size();
  EXPECT_EQ(uncompress(bytes.data(), &length, stream.data(), stream.size()), Z_OK);
  bytes.resize(length);
  return bytes;
}

TEST(ParallelZlib, AnyZlibReadsTheStream) {
  std::mt19937 random(2);
  for (const std::size_t size : {0UL, 1UL, 1000UL, (1UL << 18U) - 1, 1UL << 18U, (1UL << 18U) + 1, 1000003UL}) {
    for (const unsigned spread : {1U, 7U, 256U}) {  // the last cannot be compressed
      Bytes bytes(size);
      for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(random() % spread);
      const Bytes stream = compress_in_pieces(bytes.data(), bytes.size());
      EXPECT_LE(stream.size(), most_compressed(size)) << size << ", " << spread;
      EXPECT_EQ(unpacked(stream, size), bytes) << size << ", " << spread;
    }
  }
}

TEST(ParallelZlib, NumberOfThreadsDoesNotMatter) {
  Bytes bytes(3000000);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(i * i >> 7U);
  std::vector<Bytes> streams;
  for (const std::size_t threads : {1, 2, 5}) {
    with_threads(threads, [&] { streams.push_back(compress_in_pieces(bytes.data(), bytes.size())); });
  }
  EXPECT_EQ(streams[1], streams[0]);
  EXPECT_EQ(streams[2], streams[0]);
}

}  // namespace
}  // namespace scantet
