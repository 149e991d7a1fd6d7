# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Checks JSON documents against a JSON Schema; one line for each document: "accepted NAME" or "refused NAME: why"."""
import json
import pathlib
import sys

try:
    import jsonschema
except ImportError:
    sys.exit(77)

folder = pathlib.Path(sys.argv[1])
schema = json.loads((folder / "schema.json").read_text())
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
for line in (folder / "documents.jsonl").read_text().splitlines():
    name, document = json.loads(line)
    fault = next(validator.iter_errors(document), None)
    print(f"accepted {name}" if fault is None else f"refused {name}: {fault.json_path}: {fault.message[:200]}")
