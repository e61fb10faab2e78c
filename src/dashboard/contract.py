#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""contract.py OPENAPI.yaml OPENAPI.json: the contract as JSON, without what only helps to write it by hand."""
import json
import sys

import yaml

with open(sys.argv[1], encoding="utf-8") as source:
    contract = yaml.safe_load(source)
with open(sys.argv[2], "w", encoding="utf-8") as target:
    json.dump(contract, target, ensure_ascii=False, separators=(",", ":"))
