// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

// Each script only asks `tofray complete` (complete.cpp) what can stand at the cursor; `:files` in the answer means names of files, too.

constexpr const char* bash =
    R"(# tofray: completion for bash. To keep it: tofray completion bash > ~/.local/share/bash-completion/completions/tofray
_tofray() {
  local word="${COMP_WORDS[COMP_CWORD]}" line
  COMPREPLY=()
  while IFS= read -r line; do
    if [[ "$line" == :files ]]; then
      compopt -o filenames 2> /dev/null
      while IFS= read -r line; do COMPREPLY+=("$line"); done < <(compgen -f -- "$word")
    else
      line="${line%%$'\t'*}"
      if [[ "$line" == *= ]]; then compopt -o nospace 2> /dev/null; fi
      COMPREPLY+=("$line")
    fi
  done < <(tofray complete -- "${COMP_WORDS[@]:1:COMP_CWORD}" 2> /dev/null)
}
complete -F _tofray tofray
)";

constexpr const char* zsh = R"(#compdef tofray
# tofray: completion for zsh. To keep it: tofray completion zsh > _tofray in a folder of $fpath
_tofray() {
  local line text files=0
  local -a offers open
  while IFS= read -r line; do
    if [[ $line == :files ]]; then files=1; continue; fi
    text=${${line%%$'\t'*}//:/\\:}:${line#*$'\t'}
    if [[ ${line%%$'\t'*} == *= ]]; then open+=("$text"); else offers+=("$text"); fi
  done < <(tofray complete -- "${(@Q)words[2,CURRENT-1]}" "$PREFIX" 2> /dev/null)
  if ((files)); then _files; fi
  if (($#open)); then _describe tofray open -S ''; fi
  if (($#offers)); then _describe tofray offers; fi
}
if [[ ${funcstack[1]-} == _tofray ]]; then
  _tofray "$@"
else
  compdef _tofray tofray
fi
)";

constexpr const char* fish =
    R"(# tofray: completion for fish. To keep it: tofray completion fish > ~/.config/fish/completions/tofray.fish
function __tofray_complete
  set -l before (commandline -opc)
  set -l word (commandline -ct)
  for line in (tofray complete -- $before[2..-1] "$word" 2> /dev/null)
    if test "$line" = :files
      __fish_complete_path "$word"
    else
      printf '%s\n' $line
    end
  end
end
complete -c tofray -f -a '(__tofray_complete)'
)";

}  // namespace

int run_completion(const Options& options) {
  const std::string& shell = options.words[0];
  if (shell == "bash")
    print(bash);
  else if (shell == "zsh")
    print(zsh);
  else if (shell == "fish")
    print(fish);
  else
    throw Error(ErrorKind::bad_input, fmt::format("error: no completion for {}{}\n  expected bash, zsh or fish", base::in_quotes(shell),
                                                  base::did_you_mean(shell, {"bash", "zsh", "fish"})));
  return 0;
}

}  // namespace tofray::app
