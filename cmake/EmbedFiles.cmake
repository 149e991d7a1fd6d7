# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# Writes OUTPUT, a source file that holds the texts of FILES (a list joined by "|"). Run by the build: cmake -DOUTPUT=… -DFILES=… -P
string(REPLACE "|" ";" files "${FILES}")
set(entries "")
set(count 0)
foreach(file ${files})
  file(READ "${file}" text)
  get_filename_component(stem "${file}" NAME_WE)
  get_filename_component(folder "${file}" DIRECTORY)
  get_filename_component(folder "${folder}" NAME)
  string(APPEND entries "    {\"${folder}\", \"${stem}\", R\"tofray(${text})tofray\"},\n")
  math(EXPR count "${count} + 1")
endforeach()
file(WRITE "${OUTPUT}.new" "// Written by the build from profiles/ and scenes/.
#include \"load/builtin.h\"

namespace tofray::load {

extern const EmbeddedFile embedded_files[] = {
${entries}};
extern const std::size_t embedded_count = ${count};

}  // namespace tofray::load
")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
