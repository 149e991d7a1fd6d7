// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/text_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/text.h"
#include "files/descriptor.h"

namespace tofray::files {

namespace {

namespace fs = std::filesystem;
using base::in_quotes;
using base::Place;

[[noreturn]] void too_long(const Place& place, const std::string& path, std::size_t most) {
  base::fail(place, in_quotes(path, 200) + " is too long", "at most " + std::to_string(most) + " bytes (`tofray --limits`)",
             ErrorKind::limit);
}

std::string read_all(int descriptor, const Place& place, const std::string& path, const base::Limit& limit) {
  const auto most = static_cast<std::size_t>(limit.value);
  std::string text;
  for (;;) {
    char buffer[65536];
    const ssize_t got = ::read(descriptor, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) base::fail(place, "cannot read " + in_quotes(path, 200) + ": " + std::strerror(errno), {}, ErrorKind::io);
    if (got == 0) return text;
    text.append(buffer, static_cast<std::size_t>(got));
    if (text.size() > most) too_long(place, path, most);
  }
}

bool leads_out(const fs::path& path) {
  if (path.is_absolute()) return true;
  for (const auto& part : path)
    if (part == "..") return true;
  return false;
}

// Opens a path in or below a folder; the kernel checks that no link leads out. −1 and errno where it cannot.
int open_beneath(const std::string& folder, const std::string& relative) {
  const Descriptor base(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (base.number() < 0) return -1;
  open_how how{};
  how.flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  const long opened = ::syscall(SYS_openat2, base.number(), relative.c_str(), &how, sizeof how);
  if (opened >= 0 || (errno != ENOSYS && errno != EPERM)) return static_cast<int>(opened);
  // An old kernel, or a sandbox that does not know the call: no links at all.
  std::error_code ignored;
  const fs::path real = fs::canonical(fs::path(folder) / relative, ignored);
  const fs::path expected = fs::canonical(folder, ignored) / fs::path(relative).lexically_normal();
  if (ignored || real != expected) {
    errno = ignored ? ENOENT : EXDEV;
    return -1;
  }
  return ::open(real.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY | O_NOFOLLOW);
}

/// What stands before both.
fs::path common_folder(const fs::path& a, const fs::path& b) {
  fs::path out;
  for (auto in_a = a.begin(), in_b = b.begin(); in_a != a.end() && in_b != b.end() && *in_a == *in_b; ++in_a, ++in_b) out /= *in_a;
  return out;
}

/// As it is typed here: from the working directory on where that is shorter, in quotes where it has to be.
std::string as_typed(const fs::path& folder) {
  std::error_code ignored;
  const std::string far = folder.string(), near = folder.lexically_relative(fs::current_path(ignored)).string();
  const std::string shown = base::printable(near.empty() || near.size() > far.size() ? far : near);
  return shown.find_first_of(" \t'$`*?&;|<>()[]{}#~!\\") == std::string::npos ? shown : '"' + shown + '"';
}

/// The folder that --root has to name for this file: its own, or the one that holds it and what --root names already.
/// @return as it is typed; empty where that would be all there is
std::string wanted_root(const std::string& folder, const std::string& reference, const std::string& root) {
  std::error_code ignored;
  fs::path wanted = fs::weakly_canonical(fs::path(folder) / reference, ignored).parent_path();
  if (!root.empty()) wanted = common_folder(fs::weakly_canonical(root, ignored), wanted);
  return wanted.empty() || wanted == wanted.root_path() ? "" : as_typed(wanted);
}

[[noreturn]] void refuse(const Place& place, const std::string& reference, const std::string& folder, const std::string& root) {
  const std::string wanted = wanted_root(folder, reference, root);
  const std::string what = in_quotes(reference) + " leads out of the folder of this file" + (root.empty() ? "" : " and of that of --root") +
                           ", and a stranger's scene shall not read your files";
  base::fail(place, what + (wanted.empty() ? "" : ": if this one is yours, add --root " + wanted),
             "expected a path in or below that folder, without \"..\"; with --root DIR in or below DIR, too");
}

/// A link is followed within the folder alone, whatever --root says: what it is cannot be seen in the scene.
[[noreturn]] void refuse_link(const Place& place, const std::string& reference, const std::string& found) {
  std::error_code ignored;
  const fs::path target = fs::weakly_canonical(found, ignored);
  base::fail(place, in_quotes(reference) + " leads out of the folder by a link, and a stranger's scene shall not read your files",
             "expected a plain file; where this is yours, name what the link leads to, " + in_quotes(target.string(), 200) +
                 ", and add --root " + as_typed(target.parent_path()));
}

}  // namespace

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

std::string read_text(const std::string& path) {
  const Place place = base::whole(path);
  if (path.find('\0') != std::string::npos) base::fail(place, "a file's name holds no NUL", {}, ErrorKind::io);
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY));
  if (file.number() < 0) base::fail(place, std::string("cannot open the file: ") + std::strerror(errno), {}, ErrorKind::io);
  return read_all(file.number(), place, path, base::limit::file_bytes);
}

std::string read_standard_input() { return read_all(STDIN_FILENO, base::whole("<stdin>"), "<stdin>", base::limit::file_bytes); }

std::string read_reference(const std::string& reference, const std::string& folder, const std::string& root, const Place& place,
                           std::string& found, const base::Limit& most) {
  if (reference.find('\0') != std::string::npos) base::fail(place, "a file's name holds no NUL", "got " + in_quotes(reference));
  std::string from = folder.empty() ? "." : folder;
  fs::path relative(reference);
  if (leads_out(relative)) {
    if (root.empty()) refuse(place, reference, from, root);
    std::error_code ignored;
    relative = fs::weakly_canonical(fs::path(from) / reference, ignored).lexically_relative(fs::weakly_canonical(root, ignored));
    if (relative.empty() || leads_out(relative)) refuse(place, reference, from, root);
    from = root;
  }
  const Descriptor file(open_beneath(from, relative.string()));
  found = (fs::path(from) / relative).lexically_normal().string();
  if (file.number() < 0) {
    if (errno == EXDEV || errno == ELOOP) refuse_link(place, reference, found);
    base::fail(place, "cannot open " + in_quotes(found, 200) + ": " + std::strerror(errno), {}, ErrorKind::io);
  }
  struct stat status {};
  if (::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode))
    base::fail(place, in_quotes(found, 200) + " is not a plain file", {}, ErrorKind::io);
  if (status.st_size > most.value) too_long(place, found, static_cast<std::size_t>(most.value));  // before any of it is read
  return read_all(file.number(), place, found, most);
}

}  // namespace tofray::files
