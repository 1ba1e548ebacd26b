"""All tables by a killed run, and the overhead of a task: a run that finds every table computed."""

import json
import sys

work = sys.argv[1]


def run(name):
    with open(f"{work}/{name}.json") as file:
        summary = json.loads(file.read().strip().splitlines()[-1])
    with open(f"{work}/{name}.jsonl") as file:
        return summary, [json.loads(line) for line in file]


killed, log = run("killed")
done = {entry["id"] for entry in log if entry["status"] in ("computed", "skipped")}
assert killed["tables"] == len(done) == 40 and not killed["failed_ids"], killed

again, log = run("again")
assert again["skipped"] == again["tables"] == 40, again
seconds = sorted(entry["seconds"] for entry in log)
whole = 2 * again["seconds"] / again["tables"]
print(f"a task whose table is there: gonio {1e3 * seconds[20]:.1f} ms (median), "
      f"{1e3 * whole:.1f} ms of a worker with Dask's share")
assert whole < 0.05, whole
