#!/usr/bin/env python3
"""Make one shell script of a page's blocks: `toml` blocks that begin with `# NAME` become files, `sh` blocks
are run, `python` blocks are given to $GONIO_PYTHON. Called by tools/docs.sh."""

import re
import sys

page = open(sys.argv[1], encoding="utf-8").read()
print("set -euo pipefail")
for language, body in re.findall(r"^```(\w+)\n(.*?)^```$", page, re.S | re.M):
    if language == "toml" and (name := re.match(r"# ([\w.]+)\n", body)):
        print(f"cat > {name[1]} <<'END_OF_BLOCK'\n{body}END_OF_BLOCK")
    elif language == "sh":
        print(body)
    elif language == "python":
        print(f"\"$GONIO_PYTHON\" - <<'END_OF_BLOCK'\n{body}END_OF_BLOCK")
