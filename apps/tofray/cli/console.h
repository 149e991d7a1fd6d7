// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <string_view>

/// Data goes to stdout, talk to stderr.
namespace tofray::app {

/// Opens what the caller left closed, so that no file of ours becomes stdout or stderr by accident. A closed stdout stays unwritable.
void secure_standard_files();

/// Writes data to stdout, at once and completely. Names of files and texts out of them steer no terminal: base::printable_lines().
/// @throws Error (io) where that fails
void print(std::string_view text);
/// Writes a picture to stdout, whose colours are control characters.
void print_picture(std::string_view text);

/// Writes talk to stderr, printable too; a failure there cannot be told.
void say(std::string_view text);
/// Writes a line to stderr that is drawn anew.
void redraw(std::string_view line);

/// Writes talk to stderr, unless --quiet was given.
class Talk {
 public:
  explicit Talk(bool quiet) : quiet_(quiet) {}
  void operator()(std::string_view text) const {
    if (!quiet_) say(text);
  }

 private:
  bool quiet_;
};

bool stdout_is_terminal();
bool stderr_is_terminal();
/// Whether stdout is a terminal with colours, and NO_COLOR is not set (no-color.org).
bool stdout_has_colors();
/// Width of the terminal, COLUMNS or 80.
int terminal_columns();

/// Where a signal is just ending the process in another thread, waits for that end: what fails because of it is no error to tell.
void yield_to_signal();

/// Ctrl-C, a hang-up, a polite end and a reader that went away: unfinished files are removed, then the process ends with 128 + signal.
void end_cleanly_on_signals();

/// While one lives, the first Ctrl-C, hang-up or polite end is only noted: a run of many frames stops where its files are whole and says
/// what it did. The next signal ends the process at once, but for the same one within half a second.
class StopRequest {
 public:
  /// @param stop  set by the signal: gives up what takes long
  explicit StopRequest(std::atomic<bool>* stop);
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;
  /// The signal that was noted, or 0.
  [[nodiscard]] int signal() const;
};

}  // namespace tofray::app
