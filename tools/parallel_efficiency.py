#!/usr/bin/env python3
"""How well a command of gonio uses its threads, on a machine that others use as well.

    tools/parallel_efficiency.py target/release/gonio table scene.toml -o t.h5 --overwrite

The command is run with --threads 1 and with --threads N (all cores). Wall time says little where
other programs take the cores; two figures do not depend on them:

  busy   the share of the time in which at least N threads of the process run or wait for a core
         (fewer than N count in part), sampled from /proc every 2 ms;
  work   CPU seconds with one thread over CPU seconds with N: what parallelism costs in extra work.

Efficiency = busy * work. Linux only.
"""

import argparse
import json
import os
import resource
import subprocess
import time


def runnable(pid):
    """Threads of the process that run or wait for a core."""
    count = 0
    for task in os.listdir(f"/proc/{pid}/task"):
        try:
            with open(f"/proc/{pid}/task/{task}/stat") as file:
                count += file.read().rpartition(")")[2].split()[0] == "R"
        except OSError:
            pass  # the thread has ended
    return count


def measure(command, threads):
    """Wall seconds, CPU seconds, busy share."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    child = subprocess.Popen([*command, "--threads", str(threads)], stdout=subprocess.DEVNULL)
    total = weight = 0.0
    last = start
    while child.poll() is None:
        try:
            busy = min(runnable(child.pid), threads) / threads
        except OSError:
            break
        now = time.perf_counter()
        total += busy * (now - last)
        weight += now - last
        last = now
        time.sleep(0.002)
    if child.wait() != 0:
        raise SystemExit(f"{command} ended with {child.returncode}")
    wall = time.perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return wall, cpu, total / weight if weight else 0.0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--before", help="shell command before each run, such as removing the results")
    parser.add_argument("command", nargs=argparse.REMAINDER)
    args = parser.parse_args()
    runs = {}
    for threads in (1, args.threads):
        if args.before:
            subprocess.run(args.before, shell=True, check=True)
        runs[threads] = measure(args.command, threads)
    (wall_one, cpu_one, _), (wall, cpu, busy) = runs[1], runs[args.threads]
    work = cpu_one / cpu
    print(json.dumps({
        "threads": args.threads,
        "wall_s": [round(wall_one, 2), round(wall, 2)],
        "cpu_s": [round(cpu_one, 2), round(cpu, 2)],
        "busy": round(busy, 3),
        "work": round(work, 3),
        "efficiency": round(busy * work, 3),
        "efficiency_by_wall": round(wall_one / wall / args.threads, 3),
        "load": os.getloadavg()[0],
    }))


if __name__ == "__main__":
    main()
