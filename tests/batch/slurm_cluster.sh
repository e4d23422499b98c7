#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The Heel authors
# SPDX-License-Identifier: BSD-3-Clause
#
# A Slurm cluster of some nodes on this one machine, as root, from Debian's slurm-wlm and munge:
#   slurm_cluster.sh start FOLDER [NODES]   then: export SLURM_CONF=FOLDER/slurm.conf
#   slurm_cluster.sh kill FOLDER NODE       the node dies, with the jobs that run on it
#   slurm_cluster.sh stop FOLDER            returns when nothing writes to the folder any more
# It keeps no accounts, and nothing outside of the folder.
set -euo pipefail

usage() { sed -n '5,9s/^# \{0,1\}//p' "$0" >&2; exit 2; }
[ $# -ge 2 ] || usage
action=$1
mkdir -p "$2"
folder=$(cd "$2" && pwd)
export SLURM_CONF=$folder/slurm.conf
PATH=$PATH:/usr/sbin

start() {
  local nodes=$1 node
  mkdir -p "$folder"/{state,log,munge}
  dd if=/dev/urandom of="$folder/munge/key" bs=128 count=1 status=none
  chmod 400 "$folder/munge/key"
  munged --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
    --pid-file="$folder/munge/pid" --log-file="$folder/log/munged" --seed-file="$folder/munge/seed"
  cat > "$SLURM_CONF" <<CONF
ClusterName=heel
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
SlurmctldPort=16817
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool.%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.%n.pid
SlurmctldLogFile=$folder/log/slurmctld
SlurmdLogFile=$folder/log/slurmd.%n
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout=10
SlurmctldTimeout=10
JobRequeue=1
NodeName=n[1-$nodes] NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=[17001-$((17000 + nodes))] CPUs=1 RealMemory=4000 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
  slurmctld
  for node in $(seq "$nodes"); do slurmd -N "n$node"; done
  for _ in $(seq 60); do
    [ "$(sinfo --noheader --Node --states=idle | wc -l)" = "$nodes" ] && return
    sleep 1
  done
  echo "slurm_cluster.sh: the nodes do not come up, see $folder/log" >&2
  exit 1
}

end() {  # the process whose number a file holds
  [ -f "$1" ] && kill "-${2:-TERM}" "$(cat "$1")" 2>/dev/null || true
}

case $action in
  start) start "${3:-2}" ;;
  kill)
    [ $# -eq 3 ] || usage
    jobs=$(squeue --noheader --nodelist "$3" --format %A)
    end "$folder/slurmd.$3.pid" KILL
    for job in $jobs; do  # all that ran for it, which a machine would take with it
      pkill -KILL -f "slurmstepd: \\[$job\\." || true
      for process in $(grep --files-with-matches --null-data --no-messages \
        "^SLURM_JOB_ID=$job$" /proc/[0-9]*/environ | cut -d/ -f3); do
        kill -KILL "$process" 2>/dev/null || true
      done
    done
    ;;
  stop)
    daemons=$(cat "$folder"/slurmd.*.pid "$folder/slurmctld.pid" "$folder/munge/pid" 2>/dev/null || true)
    kill $daemons 2>/dev/null || true
    for _ in $(seq 300); do  # they store their state as they end
      kill -0 $daemons 2>/dev/null || exit 0
      sleep 0.1
    done
    kill -KILL $daemons 2>/dev/null || true
    ;;
  *) usage ;;
esac
