// Folders that appear whole or not at all. Private to io/.
#pragma once

#include <memory>
#include <string>

#include "scantet/io/unfinished_file_impl.h"

namespace scantet {

class FileSet;

/// A folder being written under a temporary name beside its target, as an AtomicFile is; its files are AtomicFiles.
/// commit() puts it in its place in one step; a folder that was there before is removed then, and not earlier.
class AtomicFolder {
 public:
  /// Creates the empty temporary folder. content: which files it may hold; a folder that is there and holds others is
  /// refused, as they would be lost. set: as of AtomicFile. Throws Error (output.cannot_write, output.full).
  AtomicFolder(const std::string& path, FolderContent content, FileSet* set);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// The folder that will appear, as the caller named it.
  const std::string& path() const { return path_; }
  /// Where it is until then, absolute.
  const std::string& part_path() const { return part_path_; }

  /// Makes a folder in it.
  void make_folder(const std::string& name) const;
  /// Gives the folder its name, or hands it to the set. Once only. Throws Error as the constructor does.
  void commit();

 private:
  std::string path_;
  std::string part_path_;
  std::unique_ptr<UnfinishedFile> folder_;
  FileSet* set_;
};

}  // namespace scantet
