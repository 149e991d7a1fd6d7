// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/commands.h"
#include "tofray/error.h"

#if defined(TOFRAY_HAS_VIEW)
#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "cli/console.h"
#include "cli/progress.h"
#include "cli/remarks.h"
#include "files/atomic_file.h"
#include "files/json.h"
#include "files/sha256.h"
#include "run/input_kind.h"
#include "view/assets.h"
#include "view/export.h"
#include "view/server.h"
#include "view/session.h"
#endif

namespace tofray::app {

#if !defined(TOFRAY_HAS_VIEW)

int run_view(const Options&) {
  throw Error(ErrorKind::device,
              "error: this tofray was built without its viewer: Boost 1.74 or newer was not there\n"
              "  ./dev view installs libboost-dev, nodejs and npm, builds again and opens it");
}

#else

namespace {

/// A page that leads to the viewer, in a file that nobody else can read, for a moment: an address with a token on a command line is seen by all users.
class Door {
 public:
  explicit Door(const std::string& url) {
    const char* folder = std::getenv("XDG_RUNTIME_DIR");
    std::string pattern = std::string(folder != nullptr && *folder == '/' ? folder : std::filesystem::temp_directory_path().native()) +
                          "/tofray-view-XXXXXX.html";
    const int file = ::mkostemps(pattern.data(), 5, O_CLOEXEC);  // readable by its owner alone
    if (file < 0) return;
    path_ = pattern;
    const std::string page =
        fmt::format("<!doctype html><meta charset=utf-8><title>tofray</title><meta http-equiv=refresh content=\"0;url={}\">\n", url);
    const bool whole = ::write(file, page.data(), page.size()) == static_cast<ssize_t>(page.size());
    ::close(file);
    if (!whole) return;
    char open[] = "xdg-open";
    char* const words[] = {open, path_.data(), nullptr};
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    for (const int one : {1, 2}) ::posix_spawn_file_actions_addopen(&actions, one, "/dev/null", O_WRONLY, 0);
    opened_ = ::posix_spawnp(&child_, open, &actions, nullptr, words, environ) == 0;
    ::posix_spawn_file_actions_destroy(&actions);
    if (opened_)
      remover_ = std::jthread([path = path_](const std::stop_token& end) {
        for (int tenth = 0; tenth < 100 && !end.stop_requested(); ++tenth) std::this_thread::sleep_for(std::chrono::milliseconds(100));
        ::unlink(path.c_str());
      });
    else
      ::unlink(path_.c_str());
  }
  [[nodiscard]] bool opened() const { return opened_; }

 private:
  std::string path_;
  pid_t child_ = 0;
  bool opened_ = false;
  std::jthread remover_;
};

void say_address(const Options& options, const view::Address& at, std::optional<Door>& door) {
  if (options.json) {
    files::Json json = files::Json::object();
    json.set("url", at.url).set("port", at.port).set("pid", static_cast<std::int64_t>(::getpid()));
    print(files::json_text(json) + "\n");
  } else {
    print(at.url + "\n");
    const Talk talk(options.quiet);
    talk("  Ctrl-C ends it. The address is a key: all who have it see and change this view.\n");
    if (const char* ssh = std::getenv("SSH_CONNECTION"); ssh != nullptr && *ssh != '\0')
      talk(fmt::format("  From your own machine: ssh -L {0}:127.0.0.1:{0} THIS-MACHINE, then the address above.\n", at.port));
  }
  if (at.on_all) say("warning: other machines reach the viewer, and what they send and see is not encrypted\n");
  if (!options.view.open) return;
  door.emplace(at.url);
  if (!door->opened()) say("warning: --open found no xdg-open here; open the address by hand\n");
}

/// The page as a file.
int export_page(const Options& options) {
  const view::State state = view::first_state(options);
  say(texts(state.in.remarks));
  const std::uint64_t all = state.recorded ? state.recorded->count() - std::min(options.first_frame, state.recorded->count() - 1) : 1;
  view::ExportRequest request{options.first_frame, options.frames.value_or(all), options.arrays};
  FrameProgress now;
  const StopRequest stop(&now.stop);
  request.progress = &now;
  std::string page;
  try {
    Progress progress(request.frames, "frames", options.quiet, &now);
    request.done = [&progress](std::uint64_t) { progress.step(); };
    page = view::exported_page(state, request);
  } catch (const Error&) {
    if (stop.signal() == 0) throw;
    say("interrupted: nothing is written\n");
    return 128 + stop.signal();
  }
  const std::string& file = options.view.export_file;
  files::write_file_atomically(file, page);
  if (options.json) {
    files::Json json = files::Json::object();
    json.set("file", file).set("bytes", page.size()).set("sha256", files::sha256_hex(page)).set("frames", request.frames);
    print(files::json_text(json) + "\n");
  } else {
    Talk(options.quiet)(fmt::format("{}: {} frame{} in a page of {:.1f} MB; it needs no server and no network\n", file, request.frames,
                                    request.frames == 1 ? "" : "s", 1e-6 * static_cast<double>(page.size())));
  }
  return 0;
}

/// Options that only --export has.
void refuse_frames(const Options& options) {
  if (options.frames || options.first_frame != 0 || !options.arrays.empty())
    throw Error(ErrorKind::bad_input,
                "error: --frames, --first-frame and --arrays are of --export\n  without it the viewer shows every frame, from 0 on");
}

}  // namespace

int run_view(const Options& typed) {
  if (view::assets().empty() && !typed.view.test_hooks)
    throw Error(ErrorKind::device,
                "error: this tofray was built without the viewer's page: npm was not there\n"
                "  ./dev view installs nodejs and npm, builds again and opens it");
  Options options = typed;
  if (!options.words.empty() && !view::names_recorded(options.words[0])) {
    const NameChoice chosen = choose_scene(options.words[0]);
    say(run::note_of(chosen));
    options.words[0] = chosen.name;
  }
  if (!options.view.export_file.empty() && !options.view.beside.empty())
    throw Error(ErrorKind::bad_input, "error: --export makes a page of one side, and --beside opens two\n  expected one of them");
  if (!options.view.export_file.empty()) return export_page(options);
  if (!options.view.beside.empty() && !view::names_recorded(options.view.beside)) {
    const NameChoice chosen = choose_scene(options.view.beside);
    say(run::note_of(chosen));
    options.view.beside = chosen.name;
  }
  refuse_frames(options);
  view::ServerOptions wanted;
  wanted.port = options.view.port, wanted.host = options.view.host, wanted.allowed_hosts = options.view.allowed_hosts;
  wanted.embed = options.view.embed, wanted.end_with_input = options.view.end_with_input;
  wanted.rate = view::parse_rate(options.view.rate).value_or(view::Rate());
  view::Session session(options, options.view.test_hooks, view::assets_sha256());
  say(session.warnings());
  std::optional<Door> door;
  view::serve(wanted, session, [&](const view::Address& at) { say_address(options, at, door); });
  return 0;
}

#endif

}  // namespace tofray::app
