#!/bin/bash
# A suite on a temporary single-node Slurm gives, after merging, the same rows as on one machine.
#
#   suite_on_slurm.sh PROGRAM WORK      77: skipped, with the reason
#
# Everything is in the folder WORK and runs as the current user: key, sockets, configuration, logs. All processes are stopped at
# the end. Existing Slurm services are not touched.
set -euo pipefail
program="$(realpath "$1")"
work="$2"

PATH="$PATH:/usr/sbin:/sbin"
for tool in munged mungekey slurmctld slurmd sbatch sinfo scontrol; do
    if ! command -v "$tool" > /dev/null; then
        echo "skipped: $tool is not installed (.ci/install slurm)"
        # In CI, Slurm is installed: not finding it is an error.
        [[ ${CI:-} != true ]] || exit 1
        exit 77
    fi
done
rm -rf "$work"
mkdir -p "$work"
work="$(realpath "$work")"
# Socket paths must be short, so they are not below the build folder.
sockets="$(mktemp -d)"
chmod 755 "$sockets"
mkdir -p "$work"/{state,spool,logs}
daemons=()

finish() {
    local -r status=$?
    trap - EXIT
    if ((status != 0)); then
        for log in "$work"/logs/* "$work"/jobs/*.log; do
            [[ ! -s $log ]] || { echo "== $log"; tail -n 40 "$log"; }
        done
    fi
    # Jobs outlive slurmd, so they are stopped first.
    if [[ -n ${array:-} ]] && scancel "$array" "$merging" 2> /dev/null; then
        for ((i = 0; i < 100; ++i)); do
            [[ -n $(squeue --noheader 2> /dev/null) ]] || break
            sleep 0.1
        done
    fi
    if ((${#daemons[@]} > 0)); then
        kill "${daemons[@]}" 2> /dev/null || true
        for ((i = 0; i < 50; ++i)); do
            kill -0 "${daemons[@]}" 2> /dev/null || break
            sleep 0.1
        done
        kill -KILL "${daemons[@]}" 2> /dev/null || true
        wait "${daemons[@]}" 2> /dev/null || true
    fi
    rm -rf "$sockets"
    exit "$status"
}
trap finish EXIT

fail() {
    echo "FAILED: $*"
    exit 1
}
# within SECONDS what command…: until the command succeeds
within() {
    local -r end=$((SECONDS + $1)) what="$2"
    shift 2
    until "$@"; do
        ((SECONDS < end)) || fail "$what"
        sleep 0.2
    done
}
freePort() {
    local port
    for port in $(shuf -i 20000-60000 -n 50); do
        if ! (exec 3<> "/dev/tcp/127.0.0.1/$port") 2> /dev/null; then
            echo "$port"
            return
        fi
    done
    fail "no free port"
}

# --- Slurm ---------------------------------------------------------------------------------------------------------
mungekey --create --keyfile "$work/munge.key" 2> /dev/null
# Each ends with this script, even if it is killed.
setpriv --pdeathsig KILL munged --foreground --key-file "$work/munge.key" --socket "$sockets/munge" --pid-file "$sockets/munge.pid" \
    --seed-file "$work/munge.seed" --num-threads 2 \
    > "$work/logs/munged.out" 2>&1 &
daemons+=($!)
within 10 "munged does not answer" test -S "$sockets/munge"

node="$(hostname -s)"
cat > "$work/slurm.conf" << END
ClusterName=single
SlurmctldHost=$node(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$sockets/munge
CredType=cred/munge
SlurmctldPort=$(freePort)
SlurmdPort=$(freePort)
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$sockets/slurmctld.pid
SlurmdPidFile=$sockets/slurmd.pid
SlurmctldLogFile=$work/logs/slurmctld
SlurmdLogFile=$work/logs/slurmd
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SelectType=select/linear
ReturnToService=2
InactiveLimit=0
KillWait=5
MinJobAge=300
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE OverSubscribe=NO State=UP
END
export SLURM_CONF="$work/slurm.conf"
setpriv --pdeathsig KILL slurmctld -D -c 2> "$work/logs/slurmctld.err" &
daemons+=($!)
setpriv --pdeathsig KILL slurmd -D 2> "$work/logs/slurmd.err" &
daemons+=($!)
isIdle() { [[ $(sinfo --noheader --format %T 2> /dev/null) == idle ]]; }
within 30 "the node does not come up" isIdle
echo "Slurm is up after $SECONDS s"

# --- the suite -----------------------------------------------------------------------------------------------------
# Names with blanks and quotes, to test the script's quoting.
mkdir -p "$work/jobs" "$work/it's here"
cat > "$work/it's here/two worlds.toml" << END
title = "Two methods in three worlds"
methods = ["billboard", "octree_search"]
sizes = ["64x48"]
frames = 3
warmup = 0
repetitions = 4
[parameters]
preroll = 0.1
particles = [50, 100, 150]
END
suite=("$program" suite "it's here/two worlds.toml" --repetitions 1 --timeout=60)
out="it's here/results of all"
cd "$work"
"${suite[@]}" --out "$out" --slurm 2 > jobs/job.sh
cd "$work/jobs"
jobs="$(bash job.sh)"
read -r array merging <<< "$jobs"
echo "submitted $jobs after $SECONDS s"
isDone() { scontrol show job "$merging" 2> /dev/null | grep -qE 'JobState=(COMPLETED|FAILED|CANCELLED|TIMEOUT)'; }
within 240 "the jobs do not end" isDone
for task in 1 2; do
    state="$(scontrol --oneliner show job "${array}_$task" | grep -oE 'JobState=[A-Z]+')"
    [[ $state == JobState=COMPLETED ]] || fail "shard $task ended as $state"
done
[[ $(scontrol --oneliner show job "$merging" | grep -oE 'JobState=[A-Z]+') == JobState=COMPLETED ]] ||
    fail "the merge failed"
echo "merged after $SECONDS s"

# --- results -------------------------------------------------------------------------------------------------------
cd "$work"
ids() { cut -d, -f1 "$1" | tail -n +2 | sort; }
"${suite[@]}" --out "$out" --dry-run | awk '{ print $1 }' | sort > expected
(($(wc -l < expected) == 9)) || fail "the plan has $(wc -l < expected) runs, expected 9"
ids "$out/summary.csv" | diff expected - || fail "the rows differ from those of the plan"
for shard in 1 2; do
    (($(ids "$out/shards/$shard-of-2/summary.csv" | wc -l) > 0)) || fail "shard $shard has no runs"
done
"${suite[@]}" --out "$out" > table 2> again
grep -q "9 existing" again || fail "the merged folder is not complete: $(cat again)"
grep -q "Two methods in three worlds" table || fail "no table of the merged folder"
echo "passed after $SECONDS s"
