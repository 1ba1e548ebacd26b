#!/usr/bin/env python3
"""Compute a batch of tables on many machines with Dask distributed.

    gonio batch plan sweep.toml -o plan.jsonl
    python tools/gonio_dask.py --plan plan.jsonl --dir shards            # this machine
    python tools/gonio_dask.py --plan plan.jsonl --dir shards --scheduler tcp://head:8786
    python tools/gonio_dask.py --plan plan.jsonl --dir shards --slurm 20 --queue normal
    gonio batch merge --plan plan.jsonl --dir shards -o table.h5

Needs `pip install "dask[distributed]"` (and dask-jobqueue for --slurm). Every task runs
`gonio batch shard` for one table with one thread; that program is idempotent, so a task that Dask
repeats because a worker died costs only a look at the file. Tasks return a few numbers, never data.
The folder of the tables must be one that all workers see.

Kubernetes: start a cluster with dask-kubernetes (KubeCluster) whose image holds gonio and whose pods
mount the folder, and give its address as --scheduler.
"""

import argparse
import collections
import json
import shutil
import subprocess
import sys
import time

RETRY = 75  # the exit code of gonio for "temporary, try again"


def compute(gonio, plan, folder, shard_id):
    """Run one shard; returns (id, status, seconds, exit code, message)."""
    start = time.perf_counter()
    command = [gonio, "batch", "shard", "--plan", plan, "--dir", folder, "--id", shard_id,
               "--threads", "1", "--json"]
    if sys.platform == "linux":
        command.append("--die-with-parent")
    done = subprocess.run(command, capture_output=True, text=True)
    seconds = time.perf_counter() - start
    if done.returncode == 0:
        status = json.loads(done.stdout.strip().splitlines()[-1])["status"]
        return shard_id, status, seconds, 0, ""
    return shard_id, "failed", seconds, done.returncode, done.stderr.strip()[-500:]


def start_client(args):
    from distributed import Client, LocalCluster

    if args.scheduler:
        return Client(args.scheduler)
    if args.slurm:
        from dask_jobqueue import SLURMCluster

        cluster = SLURMCluster(
            queue=args.queue, cores=1, processes=1, memory=args.memory, walltime=args.walltime,
            worker_extra_args=["--death-timeout", "60"],
        )
        cluster.scale(jobs=args.slurm)
        return Client(cluster)
    # Loopback only: the scheduler runs whatever it is sent.
    cluster = LocalCluster(
        n_workers=args.workers, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
    )
    return Client(cluster)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--plan", required=True)
    parser.add_argument("--dir", default=".")
    parser.add_argument("--gonio", default=shutil.which("gonio") or "target/release/gonio")
    parser.add_argument("--workers", type=int, default=None, help="of the local cluster")
    parser.add_argument("--scheduler", help="address of a running scheduler")
    parser.add_argument("--slurm", type=int, help="number of Slurm jobs")
    parser.add_argument("--queue")
    parser.add_argument("--memory", default="2GB")
    parser.add_argument("--walltime", default="04:00:00")
    parser.add_argument("--retries", type=int, default=3)
    parser.add_argument("--log", default="gonio_dask.jsonl", help="run log, appended to")
    args = parser.parse_args()

    with open(args.plan) as file:
        ids = list(dict.fromkeys(json.loads(line)["id"] for line in file))
    from distributed import as_completed

    client = start_client(args)
    start, counts = time.perf_counter(), collections.Counter()
    attempts = collections.Counter()
    waiting = collections.deque(ids)
    running = as_completed()

    def submit():
        shard_id = waiting.popleft()
        attempts[shard_id] += 1
        # Not pure: a repeated id must run again. Dask itself retries tasks of workers that died.
        future = client.submit(compute, args.gonio, args.plan, args.dir, shard_id, pure=False,
                               retries=args.retries)
        future.gonio_id = shard_id
        running.add(future)

    # Bounded in flight: enough to keep the workers busy, few enough for any number of tables.
    def fill():
        bound = 4 * max(1, sum(client.nthreads().values()))
        while waiting and running.count() < bound:
            submit()

    failed = []
    with open(args.log, "a") as log:
        fill()
        for future in running:
            try:
                shard_id, status, seconds, code, message = future.result()
            except Exception as error:  # the worker died more often than --retries
                shard_id, status, seconds, code, message = future.gonio_id, "failed", 0, RETRY, str(error)
            if code == RETRY and attempts[shard_id] <= args.retries:
                waiting.append(shard_id)
                status = "retried"
            elif code != 0:
                failed.append(shard_id)
            counts[status] += 1
            print(json.dumps({"id": shard_id, "status": status, "seconds": round(seconds, 4),
                              "code": code, "message": message, "time": time.time()}), file=log, flush=True)
            fill()
    wall = time.perf_counter() - start
    print(json.dumps({"tables": len(ids), **counts, "failed_ids": failed, "seconds": round(wall, 3)}))
    client.close()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
