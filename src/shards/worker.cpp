// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "shards/worker.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/random.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <map>
#include <set>
#include <system_error>

#include "tofray/error.h"

namespace tofray::shards {

namespace {

namespace fs = std::filesystem;

std::string host() {
  std::array<char, 65> name{};
  ::gethostname(name.data(), name.size() - 1);
  std::string out(name.data());
  for (char& c : out)
    if (c == '/' || c == '-') c = '_';
  return out.empty() ? "host" : out;
}

/// Of this start of the process: no two have the same, on whatever machine.
std::string new_name() {
  std::uint64_t random = 0;
  if (::getrandom(&random, sizeof random, 0) != sizeof random) random = static_cast<std::uint64_t>(::getpid());
  return fmt::format("{}-{}-{:016x}", host(), ::getpid(), random);
}

[[noreturn]] void fail_to_make(const fs::path& path, const std::string& why) {
  throw Error(ErrorKind::io, fmt::format("{}: error: cannot make it: {}\n  expected a folder that you may write to", path.native(), why));
}

void make_folder(const fs::path& path) {
  std::error_code fault;
  fs::create_directories(path, fault);
  if (fault) fail_to_make(path, fault.message());
}

}  // namespace

void remove_dead_workers(const fs::path& set_folder) {
  const fs::path work = set_folder / "work";
  const std::string ours = host() + "-";
  std::error_code fault;
  for (const fs::directory_entry& entry : fs::directory_iterator(work, fault)) {
    const std::string name = entry.path().filename().native();
    pid_t process = 0;
    if (!name.starts_with(ours) || std::from_chars(name.data() + ours.size(), name.data() + name.size(), process).ec != std::errc())
      continue;
    if (process <= 0 || ::kill(process, 0) == 0 || errno != ESRCH) continue;
    const files::Descriptor lock(::open((entry.path() / "lock").c_str(), O_RDONLY | O_CLOEXEC));
    if (lock.number() >= 0 && ::flock(lock.number(), LOCK_EX | LOCK_NB) != 0) continue;
    std::error_code left;
    fs::remove_all(entry.path(), left);
  }
}

Worker::Worker(const fs::path& set_folder) {
  const std::string name = new_name();
  make_folder(set_folder / "work"), make_folder(set_folder / "log");
  remove_dead_workers(set_folder);
  folder_ = set_folder / "work" / name;
  make_folder(folder_);
  lock_.emplace(::open((folder_ / "lock").c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (lock_->number() < 0) fail_to_make(folder_ / "lock", std::generic_category().message(errno));
  (void)::flock(lock_->number(), LOCK_EX | LOCK_NB);
  const fs::path log = set_folder / "log" / (name + ".log");
  log_.emplace(::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (log_->number() < 0) fail_to_make(log, std::generic_category().message(errno));
}

Worker::~Worker() {
  log("end\n");
  std::error_code fault;
  fs::remove_all(folder_, fault);
}

void Worker::log(const std::string& line) const {
  // What cannot be logged is made all the same.
  (void)!::write(log_->number(), line.data(), line.size());
}

void Worker::begins(std::uint64_t sample) const { log(fmt::format("begin {}\n", sample)); }
void Worker::ends(std::uint64_t sample) const { log(fmt::format("done {}\n", sample)); }

std::vector<std::uint64_t> deadly_samples(const fs::path& set_folder, int deaths) {
  std::map<std::uint64_t, int> count;
  std::error_code fault;
  for (const fs::directory_entry& entry : fs::directory_iterator(set_folder / "log", fault)) {
    std::ifstream file(entry.path());
    std::set<std::uint64_t> under_way;
    bool ended = false;
    std::string word;
    std::uint64_t sample = 0;
    while (file >> word) {
      if (word == "end")
        ended = true;
      else if (file >> sample)
        word == "begin" ? (void)under_way.insert(sample) : (void)under_way.erase(sample);
    }
    if (!ended)
      for (const std::uint64_t one : under_way) ++count[one];
  }
  std::vector<std::uint64_t> out;
  for (const auto& [one, times] : count)
    if (times >= deaths) out.push_back(one);
  return out;
}

std::uint64_t workers_at(const fs::path& set_folder) {
  std::error_code fault;
  std::uint64_t out = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(set_folder / "work", fault)) out += entry.is_directory(fault) ? 1 : 0;
  return out;
}

}  // namespace tofray::shards
