#!/usr/bin/env bash
# Forty tables by Dask with two workers, one of them killed in the middle: all forty are there and the
# merged file is that of an undisturbed run, byte for byte. Then what a task costs beside its table.
source "$(dirname "$0")/common.sh"
environment dask 'dask[distributed]'
"$gonio" batch plan tools/clients/scenes/sweep.toml -o "$work/plan.jsonl"
"$gonio" batch run --plan "$work/plan.jsonl" --dir "$work/calm"
"$gonio" batch merge --plan "$work/plan.jsonl" --dir "$work/calm" -o "$work/calm.h5"

dask=("$python" tools/gonio_dask.py --gonio "$gonio" --plan "$work/plan.jsonl" --dir "$work/rough"
  --workers 2)
"${dask[@]}" --log "$work/killed.jsonl" > "$work/killed.json" &
driver=$!
tables() { find "$work/rough" -name '*.h5' ! -name '.*' 2>/dev/null | wc -l; }
# A third of the tables, then kill -9 for one of the two workers.
until [ "$(tables)" -ge 13 ]; do
  kill -0 $driver  # fails where the driver has ended
  sleep 0.02
done
victim=$(pgrep -P $driver -f spawn_main | head -1)
kill -9 "$victim"
echo "killed worker $victim with $(tables) tables done"
wait $driver
cat "$work/killed.json"
"$gonio" batch merge --plan "$work/plan.jsonl" --dir "$work/rough" -o "$work/rough.h5"
cmp "$work/calm.h5" "$work/rough.h5"
echo "merged files are identical"

"${dask[@]}" --log "$work/again.jsonl" > "$work/again.json"
"$python" tools/clients/check_dask.py "$work"
