// Output files that appear whole or not at all.
#pragma once

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

class AtomicFolder;
class FileSet;
class UnfinishedFile;

/// A file being written under a short temporary name in the folder of its target, ".scantet-<hash>.<pid>.part".
/// commit() gives it its name in one step; without it the destructor removes it. A target that was there before stays
/// untouched until then, and its permissions are kept. If a killed process has left a temporary file for the same
/// target, the next file for that target removes it: a temporary file is locked (flock) while somebody writes it. A
/// program that wants an Error at a file-size limit must ignore SIGXFSZ, which ends it otherwise. One object is not for
/// use by two threads at once; different objects are independent, but a process has at most 64 unfinished files and
/// folders at a time. FileSet and AtomicFolder are scantet's own, so that for others `set` is null.
class AtomicFile {
 public:
  /// Creates the empty temporary file. path: the file to appear; symbolic links are followed, also to where nothing is
  /// yet. part_ending: the end of the temporary name, for writers that insist on an extension. set: where commit() puts
  /// the file, to appear with others; it must outlive this. Null: commit() makes it appear. Throws Error:
  /// output.cannot_write (the folder is missing or not writable, the target is a folder, a device or write-protected,
  /// or too many files are unfinished), output.full; both name the path, the system's reason and a remedy.
  explicit AtomicFile(const std::string& path, const std::string& part_ending = ".part", FileSet* set = nullptr);
  /// A file of a folder in the making, where commit() puts it. name: with the subfolder it is in, which is there.
  /// part_ending, errors: as above.
  AtomicFile(const AtomicFolder& folder, const std::string& name, const std::string& part_ending = ".part");
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write the content, absolute.
  const std::string& part_path() const { return part_path_; }
  /// The same file, open for reading and writing until commit(), for those who do not open it by name; then -1.
  int descriptor() const;
  /// Why nothing more can be written: appends up to 1 MiB and returns the errno value that stopped it, 0 if nothing
  /// did. It is for use after a writer has failed that does not tell why, before commit(); the content is spoilt.
  int append_error() const;
  /// The file that will appear, as the caller named it.
  const std::string& path() const { return path_; }

  /// Flushes the content to the disk and renames it to its target, or hands it to the set. Once only. Throws Error:
  /// output.cannot_write, output.full, and then the target is as it was; output.committed (Fault::internal: it was
  /// committed before).
  void commit();

 private:
  std::string path_;       // for messages
  std::string part_path_;  // absolute
  std::unique_ptr<UnfinishedFile> file_;
  FileSet* set_;
};

/// Writes a file through a buffered binary stream: it appears when `content` has returned and everything is on the
/// disk. content: is called once, and need not check the stream. path, set: as in AtomicFile.
/// Throws Error: as AtomicFile; output.stream (Fault::internal: `content` left the stream in a failed state, and not
/// for a failed write); and what `content` throws. The target is then as it was.
void write_file(const std::string& path, const std::function<void(std::ostream&)>& content, FileSet* set = nullptr);
/// The same of a file in a folder in the making. name: as in AtomicFile.
void write_file(const AtomicFolder& folder, const std::string& name, const std::function<void(std::ostream&)>& content);

/// Throws the Error for a failed write to `path`: output.full if the system's reason is lack of space (disk, quota or
/// file-size limit), output.cannot_write otherwise. system_error: an errno value.
[[noreturn]] void throw_output_error(const std::string& path, int system_error);

/// Removes every temporary file and folder that is not committed yet. For a signal handler that is about to end the
/// process: async-signal-safe. The objects stay valid; their commit() then fails.
void remove_unfinished_files() noexcept;

}  // namespace scantet
