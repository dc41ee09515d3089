// Folders that files are replaced by, and taken away. Private to io/.
#pragma once

#include <string>

#include "scantet/io/unfinished_file_impl.h"

namespace scantet {

/// Refuses a target that is there and is no folder, may not be written, or holds what the format does not write: that
/// would be lost. path: for messages. Return: its permission bits, 0 if there is none. Throws Error.
unsigned check_target_folder(const std::string& path, const std::string& target, FolderContent content);

/// Puts a folder in the place of `target`, which may be a folder; that one is removed. Return: 0, or an errno value.
int replace_folder(const std::string& part, const std::string& target) noexcept;

/// Brings the names in a folder and in its subfolders to the disk. Throws Error naming `path`.
void sync_tree(const std::string& folder, const std::string& path);

/// Removes a folder of files and folders of files; what cannot be removed stays. Async-signal-safe.
void remove_tree(const char* path) noexcept;

}  // namespace scantet
