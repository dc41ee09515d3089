// A run in a process of its own: its heap, threads and peak memory owe nothing to the runs before.
#pragma once

#include <functional>
#include <string>

namespace scantet::bench {

/// Runs `work` in a forked child and returns the text that it made. The caller must have no other threads.
/// Throws std::runtime_error: what `work` threw, or that the child died (of a signal, of too little memory).
std::string in_child(const std::function<std::string()>& work);

}  // namespace scantet::bench
