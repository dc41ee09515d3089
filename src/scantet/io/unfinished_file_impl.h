// A temporary file or folder that takes the name of its target, or vanishes.
#pragma once

#include <string>
#include <string_view>

namespace scantet {

/// Whether a folder's file of this name, with the subfolder it is in ("sets/a.vtu"), is one that its format writes.
using FolderContent = bool (*)(std::string_view name);

/// The file is in the folder of its target, named ".scantet-<hash of the target's name>.<pid>.part", and locked (flock)
/// as long as this object lives. A file of such a name that can be locked is nobody's, and is removed when a file for
/// the same target is made. The same of folders, which hold files and folders of files.
class UnfinishedFile {
 public:
  /// Creates the empty file, or the empty folder if there is `content`. path: the target as the caller named it, for
  /// messages. target: where it is; links are followed. content: what a folder that is there may hold: this one takes
  /// its place. Throws Error as AtomicFile and AtomicFolder.
  UnfinishedFile(const std::string& path, const std::string& target, const std::string& part_ending,
                 FolderContent content = nullptr);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  const std::string& path() const { return path_; }
  const std::string& part_path() const { return part_path_; }
  int descriptor() const { return descriptor_; }
  bool is_folder() const { return content_ != nullptr; }

  /// Brings the content to the disk; of a folder, the names of its files, which are there already. Throws Error.
  void flush() const;
  /// Gives the file the name of its target; returns 0, or the errno value of what prevented it. Once only.
  int appear() noexcept;
  /// Makes the new name survive a power cut. A failure is passed over, for the file is there.
  void sync_folder() const noexcept;

 private:
  void create(const std::string& part_ending);
  void remove_part() noexcept;
  void close_part() noexcept;

  std::string path_;         // for messages
  std::string target_path_;  // absolute, links followed
  std::string folder_path_;
  std::string part_path_;  // absolute
  FolderContent content_;
  int descriptor_ = -1;
  int slot_ = -1;  // in the table of unfinished files
};

}  // namespace scantet
