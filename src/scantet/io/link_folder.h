// Names for files that do not have theirs yet.
#pragma once

#include <memory>
#include <string>

namespace scantet {

class AtomicFolder;

/// A folder among the machine's temporary ones (TMPDIR) with links to unfinished files, for readers that go by a file's
/// ending, or look for files beside it. It is gone with this object, or at the next one of a user if the process was
/// killed.
class LinkFolder {
 public:
  /// Throws Error (output.cannot_write, output.full): no folder can be made there.
  LinkFolder();
  ~LinkFolder();
  LinkFolder(const LinkFolder&) = delete;
  LinkFolder& operator=(const LinkFolder&) = delete;

  /// A link to part_path, with the last part of `path` as its name. Return: where it is. Throws Error as above.
  std::string add(const std::string& path, const std::string& part_path) const;

 private:
  std::unique_ptr<AtomicFolder> folder_;
};

}  // namespace scantet
