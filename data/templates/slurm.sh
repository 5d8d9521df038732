#!/bin/bash
#SBATCH --job-name=dustbench-{{name}}
#SBATCH --array=1-{{shards}}
#SBATCH --nodes=1
#SBATCH --exclusive
#SBATCH --time={{time}}
#SBATCH --output=dustbench-{{name}}-%A_%a.log
#
# {{runs}} runs in {{shards}} shards, {{most}} in the largest. The time limit is the maximum duration of a shard: {{timeout}} s a run and
# {{around}} s around it (--timeout), {{extra}} s a shard.
#
#     bash THIS_FILE      submits this array, and after it a job that merges the shards into the results folder
#     sbatch THIS_FILE    submits only the array
#
# To resume shards that were stopped, submit again. After the merge, `dustbench suite` with the same options and
# --out prints the tables without measuring anything. All nodes must see these paths:
dustbench={{program}}
folder={{folder}}
out={{out}}

set -euo pipefail
if [[ -n ${SLURM_ARRAY_TASK_ID:-} ]]; then
    cd "$folder"
    exec "$dustbench"{{arguments}} \
        --shard "$SLURM_ARRAY_TASK_ID/{{shards}}" --out "$out/shards/$SLURM_ARRAY_TASK_ID-of-{{shards}}"
fi

array="$(sbatch --parsable "$0")"
array="${array%%;*}" # a cluster's name may follow
merge=("$dustbench" merge --out "$out")
for ((shard = 1; shard <= {{shards}}; ++shard)); do
    merge+=("$out/shards/$shard-of-{{shards}}")
done
merging="$({ echo '#!/bin/bash' && printf 'exec' && printf ' %q' "${merge[@]}" && echo; } |
    sbatch --parsable --dependency="afterany:$array" --job-name=dustbench-{{name}}-merge --nodes=1 --ntasks=1 \
        --output=dustbench-{{name}}-%j-merge.log)"
echo "$array ${merging%%;*}"
