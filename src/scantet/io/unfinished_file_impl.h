// A temporary file that takes the name of its target, or vanishes.
#pragma once

#include <string>

namespace scantet {

/// The file is in the folder of its target, named ".scantet-<hash of the target's name>.<pid>.part", and locked (flock)
/// as long as this object lives. A file of such a name that can be locked is nobody's, and is removed when a file for
/// the same target is made.
class UnfinishedFile {
 public:
  /// Creates the empty file. path: the target as the caller named it; links are followed. Throws Error as AtomicFile.
  UnfinishedFile(const std::string& path, const std::string& part_ending);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  const std::string& path() const { return path_; }
  const std::string& part_path() const { return part_path_; }
  int descriptor() const { return descriptor_; }

  /// Brings the content to the disk. Throws Error.
  void flush() const;
  /// Gives the file the name of its target; returns 0, or the errno value of what prevented it. Once only.
  int appear() noexcept;
  /// Makes the new name survive a power cut. A failure is passed over, for the file is there.
  void sync_folder() const noexcept;

 private:
  void create(const std::string& part_ending);
  void close_part() noexcept;

  std::string path_;         // for messages
  std::string target_path_;  // absolute, links followed
  std::string folder_path_;
  std::string part_path_;  // absolute
  int descriptor_ = -1;
  int slot_ = -1;  // in the table of unfinished files
};

}  // namespace scantet
