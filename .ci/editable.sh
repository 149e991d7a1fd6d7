#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
# editable.sh VENV CHECKOUT: `pip install -e` of this checkout into that environment is what it should be: module and command work from any
# folder, Python files are those of the checkout, so that a change of one is seen at once, and pip takes it all away again.
set -euo pipefail
venv=$1 checkout=$2
changed=$checkout/python/tofray/_html.py
before=$(mktemp)
cp "$changed" "$before"
trap 'cp "$before" "$changed"; rm -f "$before"' EXIT

cd /
"$venv/bin/python" -c 'import tofray; assert tofray.demo().depth.z_m.shape == (172, 224)'
"$venv/bin/python" -m tofray list scenes >/dev/null
echo 'added_by_editable_sh = True' >>"$changed"
"$venv/bin/python" -c 'from tofray import _html; assert _html.added_by_editable_sh, "the checkout is not what is imported"'
[[ $("$venv/bin/pip" show -f tofray) == *tofray.pth* ]]
"$venv/bin/pip" uninstall -q -y tofray
if "$venv/bin/python" -c 'import tofray' 2>/dev/null; then
  echo "pip uninstall left the package" >&2
  exit 1
fi
