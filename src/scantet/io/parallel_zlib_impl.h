// zlib streams made by several threads.
#pragma once

#include <cstddef>
#include <vector>

namespace scantet {

/// One zlib stream (RFC 1950) of the bytes, which any zlib reads. Pieces are compressed side by side, with zlib's
/// fastest level: on the arrays of a mesh its streams are no larger than those of the level in the middle. Guarantees:
/// does not depend on the number of threads. Throws std::bad_alloc.
std::vector<unsigned char> compress_in_pieces(const unsigned char* bytes, std::size_t size);

/// At least what compress_in_pieces() makes of so many bytes.
std::size_t most_compressed(std::size_t size);

}  // namespace scantet
