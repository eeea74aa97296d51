#!/usr/bin/env bash
# A Slurm of one node for trying recipes: one-node-slurm.sh start FOLDER | stop FOLDER
# Needs root and the packages slurm-wlm and munge. Everything it writes is in FOLDER; `export SLURM_CONF=FOLDER/slurm.conf`
# afterwards. It touches no Slurm of the machine: ports, sockets and configuration are its own.
set -eu
action=$1
mkdir -p "$2"
here=$(cd "$2" && pwd)

start() {
  mkdir -p "$here/state" "$here/spool" "$here/munge"
  chmod 700 "$here/munge"
  chmod 755 "$here"
  chown -R munge: "$here/munge"
  [ -e "$here/munge/key" ] || { head -c 1024 /dev/urandom > "$here/munge/key"; chmod 400 "$here/munge/key"; chown munge: "$here/munge/key"; }
  cat > "$here/slurm.conf" <<CONF
ClusterName=trial
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=root
SlurmctldPort=26817
SlurmdPort=26818
AuthType=auth/munge
AuthInfo=socket=$here/munge/socket
StateSaveLocation=$here/state
SlurmdSpoolDir=$here/spool
SlurmctldPidFile=$here/slurmctld.pid
SlurmdPidFile=$here/slurmd.pid
SlurmctldLogFile=$here/slurmctld.log
SlurmdLogFile=$here/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
JobRequeue=1
SchedulerParameters=requeue_setup_env_fail,sched_interval=1,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
  chmod 755 "$here"
  runuser -u munge -- /usr/sbin/munged --key-file="$here/munge/key" --socket="$here/munge/socket" --pid-file="$here/munge/pid" \
    --log-file="$here/munge/log" --seed-file="$here/munge/seed" --force
  export SLURM_CONF=$here/slurm.conf
  /usr/sbin/slurmctld -c -f "$SLURM_CONF"
  /usr/sbin/slurmd -f "$SLURM_CONF"
  for _ in $(seq 100); do
    sinfo --noheader --format=%T 2>/dev/null | grep -q idle && return 0
    sleep 0.2
  done
  echo "one-node-slurm: no idle node after 20 s; see $here/*.log" >&2
  return 1
}

stop() {
  for name in slurmd slurmctld munge/pid; do
    file=$here/$name
    [ "$name" = munge/pid ] || file=$file.pid
    [ -e "$file" ] && kill "$(cat "$file")" 2>/dev/null || true
  done
}

case "$action" in
  start) start || { stop; exit 1; } ;;
  stop) stop ;;
  *) echo "one-node-slurm.sh start|stop FOLDER" >&2; exit 2 ;;
esac
