// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Equations as HTML: a line of JSON in, {tex, display}, a line out, {html} or {error}. node katex.js <katex's script>
const katex = require(process.argv[2]);
require('readline').createInterface({input: process.stdin}).on('line', line => {
  const {tex, display} = JSON.parse(line);
  let answer;
  try {
    answer = {html: katex.renderToString(tex, {displayMode: display, strict: 'ignore', throwOnError: true})};
  } catch (fault) {
    answer = {error: fault.message};
  }
  process.stdout.write(JSON.stringify(answer) + '\n');
});
