#!/usr/bin/env python3
"""Every test of ctest has a time limit, so that a hanging test ends. $1: ctest, $2: the build folder."""

import json
import subprocess
import sys

CTEST, BUILD = sys.argv[1:]
output = subprocess.run([CTEST, "--test-dir", BUILD, "--show-only=json-v1"], check=True, text=True, capture_output=True)
tests = [test for test in json.loads(output.stdout)["tests"] if not test["name"].endswith("_NOT_BUILT")]
without = [test["name"] for test in tests if not any(p["name"] == "TIMEOUT" for p in test.get("properties", []))]
sys.exit("\n".join(f"{name} has no TIMEOUT" for name in without) or (0 if tests else "no tests in " + BUILD))
