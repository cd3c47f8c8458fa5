#pragma once
// Outputs appear whole or not at all.
#include <functional>
#include <string>

namespace defray {

/// A folder for outputs, with those that it lies in. Throws Error(output) where it cannot be.
void create_folder(const std::string& path);

/// Throws Error(output) unless a file could be created where `path` is to go, without touching
/// what is there, which must not be write-protected. For finding out before the work rather than
/// after. Removes what killed processes of this machine left behind in that folder. `hint`: how a
/// missing folder is made.
void check_can_write(const std::string& path, const std::string& hint = "");

/// The same where missing folders will be made.
void check_can_make(const std::string& path);

/// Calls `write` with a temporary name in the folder of `path`, syncs what it wrote and renames it
/// to `path`, which it refuses to do with a write-protected file, a pipe or a device. When anything
/// fails, the temporary file is removed and an old `path` stays.
void write_safely(const std::string& path, const std::function<void(const std::string&)>& write);

/// write_safely for a text.
void write_text(const std::string& path, const std::string& text);

/// Removes the temporary file in hand, for a process that ends here; a signal handler may call it.
void remove_temporary();

/// Whether a file is there and not empty, as a full disk or a copy that broke off leaves it.
bool is_written(const std::string& path);

/// Whether two paths name one file, written yet or not, however they are spelt.
bool is_same_file(const std::string& a, const std::string& b);

}  // namespace defray
