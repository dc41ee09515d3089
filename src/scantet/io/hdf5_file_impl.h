// HDF5 files in the making. Private to io/.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace scantet {

class AtomicFile;

/// An HDF5 file that is written once, without time stamps, through the descriptor of an AtomicFile: the same calls give
/// the same bytes. What the disk refuses is remembered and thrown by close(); what the library refuses is thrown at
/// once, as Error (output.cannot_write). Paths are absolute within the file, and groups are made before what is in
/// them.
class Hdf5File {
 public:
  /// The file must outlive this.
  explicit Hdf5File(const AtomicFile& file);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  void make_group(const std::string& path);

  /// Arrays of these extents, row by row; their product is the number of values.
  using Extents = std::vector<std::uint64_t>;
  void write(const std::string& path, const Extents& extents, std::span<const double> values);
  void write(const std::string& path, const Extents& extents, std::span<const std::int32_t> values);
  /// As signed numbers of 64 bits in the file.
  void write_wide(const std::string& path, const Extents& extents, std::span<const std::uint32_t> values);

  /// Texts of a fixed length in bytes, each an array of characters with zeros after it; what is longer is cut.
  void write(const std::string& path, const std::vector<std::string>& texts, std::size_t length);

  /// Attributes of a group or an array.
  void set_attribute(const std::string& path, const std::string& name, std::int32_t value);
  void set_attribute(const std::string& path, const std::string& name, double value);
  void set_attribute(const std::string& path, const std::string& name, const std::string& text);
  /// As 32 bits, which HDF5 tells from numbers.
  void set_bits(const std::string& path, const std::string& name, std::uint32_t bits);

  /// Ends the file; nothing can be written afterwards. Throws Error (output.*) if anything of it is not in the
  /// AtomicFile. Without it the file is not whole.
  void close();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace scantet
