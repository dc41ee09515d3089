// Output files of one run that appear together.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scantet/base/api.h"

namespace SCANTET_PROGRAM_API scantet {

class UnfinishedFile;

/// Files and folders that are written under temporary names (AtomicFile, write_file) and then all take their own, one
/// right after the other in the order in which they were added. Without commit() none appears.
class FileSet {
 public:
  FileSet();
  ~FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  /// Takes a file whose content is on the disk.
  void add(std::unique_ptr<UnfinishedFile> file);

  struct Entry {
    std::string path;    ///< as the caller named it
    std::string sha256;  ///< of its content, 64 digits
  };
  struct Part {
    std::string path;       ///< as the caller named it
    std::string part_path;  ///< where its content is until commit()
  };
  /// The files added so far.
  std::vector<Part> parts() const;
  /// The files added so far, of folders all files in them, by name. Throws Error (input.cannot_open) if one cannot be
  /// read.
  std::vector<Entry> entries() const;

  /// Gives all files their names. Throws Error: output.* if none was renamed; output.partial, naming those that were,
  /// if a later one cannot be. The system cannot rename several files in one step: if the process is killed in between,
  /// the first of them are new and the others are not.
  void commit();

 private:
  std::vector<std::unique_ptr<UnfinishedFile>> files_;
};

}  // namespace scantet
