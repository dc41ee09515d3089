// How deep JSON from outside may be nested.
#pragma once

namespace scantet {

/// The JSON library calls itself for each level when it copies a value or writes it down: a file of brackets alone
/// would fill the stack. What scantet reads has fewer than ten levels. For the callback of a parse.
inline constexpr int kMostJsonDepth = 64;

}  // namespace scantet
